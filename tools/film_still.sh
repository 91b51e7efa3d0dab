#!/usr/bin/env bash
# The picture at the head of the README: a moment of scenes/pour.json, rendered.
#
#   tools/film_still.sh [DIR]      results go to DIR (build/pour), the picture to docs/film.jpg
#
# SESSILE names another program than build/release/bin/sessile, SAMPLES other than 80 rays for each pixel.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/steps.sh"

work=${1:-build/pour}
sessile=${SESSILE:-build/release/bin/sessile}
[ -x "$sessile" ] || fail "there is no program $sessile: build it first (./demo.sh), or name it in SESSILE"
tools/setup.sh build render

step "Run" film-run.log "$sessile" run scenes/pour.json -o "$work" --until 2.9 --set output.frame_interval=0.2
step "Mesh" film-mesh.log "$sessile" mesh "$work" --frames 14
step "Render" film-render.log \
  "$sessile" render "$work" --no-video --size 1280x720 --set shutter=0.2 --samples "${SAMPLES:-80}" ${THREADS:+--threads "$THREADS"}
step "Convert" film-convert.log convert "$work/render/frame_000014.png" -quality 92 docs/film.jpg
say "The picture is docs/film.jpg"
