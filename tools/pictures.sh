#!/usr/bin/env bash
# Draws the pictures of the documentation anew: runs their scenes and puts the pictures into docs/.
#
#   tools/pictures.sh        needs build/release/bin/sessile, which ./demo.sh builds; takes some minutes
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/steps.sh"

program=build/release/bin/sessile
[ -x "$program" ] || fail "there is no $program: run ./demo.sh first"
results=build/pictures

# run_scene NAME [ARGUMENT...]: results go to build/pictures/NAME, which stays, so that another view takes a moment.
run_scene() {
  [ -e "$results/$1/summary.json" ] || step "Running scenes/$1.json" "pictures-$1.log" \
    "$program" run "scenes/$1.json" -o "$results/$1" --progress none "${@:2}"
}

# draw FILE ARGUMENT...: a picture in docs/.
draw() {
  step "Drawing docs/$1" "pictures-draw.log" "$program" picture "${@:2}" -o "docs/$1" --progress none
}

run_scene tablet
draw tablet.png "$results/tablet" --look liquid --time 0.2,0.56,6 --size 1280x400 --view 20,32
run_scene spill
draw spill.png "$results/spill" --look liquid --time 2.4,6,12 --size 1280x560
draw particles.png "$results/tablet" --time 0.2,0.56,6 --range 0,4 --size 1280x480 --view 20,32
say "The pictures are in docs/; git diff shows whether they changed."
