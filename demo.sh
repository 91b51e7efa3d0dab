#!/usr/bin/env bash
# From nothing to a liquid on a tablet: installs what is missing, builds a release, runs scenes/tablet.json, draws it.
# Run it again at any time: it does only what is not done yet. --again runs the scene anew.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
. tools/steps.sh

case ${1-} in
  "") again= ;;
  --again) again=yes ;;
  *) say "usage: ./demo.sh [--again]"; exit 2 ;;
esac

tools/setup.sh build
lock_build
if [ ! -e build/release/build.ninja ]; then
  step "Configuring" configure.log cmake --preset release -DSESSILE_TESTS=OFF
fi
step "Building" build.log cmake --build --preset release --parallel "$(jobs_at_once)" --target sessile_cli

program=build/release/bin/sessile
scene=scenes/tablet.json
results=results/tablet
finished=$results/.finished
if [ -z "$again" ] && [ "$finished" -nt "$program" ] && [ "$finished" -nt "$scene" ]; then
  say "The results in $results are up to date; ./demo.sh --again runs the scene anew."
else
  rm -f "$finished"
  say "Running $scene"
  start=$SECONDS status=0
  "$program" run "$scene" -o "$results" || status=$?
  [ $status -ne 130 ] || { say "interrupted; what was written so far is in $results"; exit 130; }
  [ $status -eq 0 ] || fail "the simulation failed (exit code $status): $program run $scene -o $results"
  touch "$finished"
  say "Simulated in $((SECONDS - start)) s."
fi
pvd=$(find "$results" -maxdepth 2 -name '*.pvd' -print -quit)
say "Results: $PWD/$results"
[ -z "$pvd" ] || say "  ${pvd#"$results"/}: the frames, to open in ParaView"
say "  stats.csv: energies, errors, spread over time    summary.json: the run in figures"
picture=$results/picture.png
if [ "$picture" -nt "$finished" ] || "$program" picture "$results" --look liquid -o "$picture" 2>"$logs/picture.log"; then
  say "  ${picture#"$results"/}: the liquid at rest"
else
  say "  no picture: $(tail -n 1 "$logs/picture.log")"
fi
say "Next: $program run scenes/spill.json -o results/spill; $program --help; README.md"
