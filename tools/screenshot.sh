#!/usr/bin/env bash
# Makes docs/view.png: the window of `sessile view` on a display in memory.
#
#   tools/screenshot.sh [SCENE] [PICTURE] [KEY...]    keys as xdotool names them, pressed one after the other
#
# Takes scenes/spill.json at 2 s unless told otherwise. Needs Xvfb, xdotool, ImageMagick, and build/release/bin/sessile.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
scene=${1:-scenes/spill.json} picture=${2:-docs/view.png} keys=("${@:3}")

fail() { echo "screenshot.sh: $*" >&2 && exit 1; }
for program in Xvfb xdotool import; do
  command -v "$program" >/dev/null || fail "$program is missing. On Debian: apt-get install xvfb xdotool imagemagick"
done
[ -x build/release/bin/sessile ] || fail "there is no build/release/bin/sessile: run ./demo.sh first"

work=$(mktemp -d)
end() {
  for process in "${viewer-}" "${server-}"; do
    [ -z "$process" ] || { kill "$process" && wait "$process"; } 2>/dev/null || true
  done
  rm -rf "$work"
}
trap end EXIT

Xvfb -displayfd 3 -screen 0 1280x800x24 -nolisten tcp -noreset 3>"$work/display" 2>/dev/null &
server=$!
until [ -s "$work/display" ]; do sleep 0.1; done
export DISPLAY=:$(cat "$work/display") LIBGL_ALWAYS_SOFTWARE=1

until=${SESSILE_SCREENSHOT_AT:-2} # simulated seconds
build/release/bin/sessile view "$scene" --set "time.end=$until" -o "$work" &
viewer=$!
window=$(xdotool search --sync --name Sessile | head -1)
xdotool windowfocus --sync "$window"
# A saved picture's name tells the time that is shown: it ends at time.end.
reached() {
  xdotool key --window "$window" p
  sleep 1
  last=$(ls -t "$work" | sed -n 's/^view_.*_\([0-9.]*\)s\(_[0-9]*\)\?\.png$/\1/p' | head -1)
  awk -v now="${last:-0}" -v end="$until" 'BEGIN {exit !(now >= end - 1e-4)}'
}
until reached; do kill -0 "$viewer" 2>/dev/null || fail "the window closed"; done
for key in "${keys[@]}"; do xdotool key --window "$window" "$key" && sleep 1; done
sleep 8 # until the last notice has gone
import -window "$window" "$picture"
xdotool key --window "$window" q
wait "$viewer"
viewer=
echo "$picture"
