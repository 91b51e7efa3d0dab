#!/usr/bin/env bash
# The paper's Figs. 3 and 4 as rendered pictures: the same moments of the same scenes with three methods, side by side.
#
#   tools/paper_figures.sh [DIR]      results go to DIR (build/paper), pictures to docs/paper/fig3.png and fig4.png
#
# SESSILE names another program than build/release/bin/sessile, SAMPLES other than 40 rays for each pixel. What is computed
# and rendered already is not done again.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/steps.sh"

work=${1:-build/paper}
sessile=${SESSILE:-build/release/bin/sessile}
[ -x "$sessile" ] || fail "there is no program $sessile: build it first (./demo.sh), or name it in SESSILE"
tools/setup.sh build render
mkdir -p "$work"

methods=(none akinci2013 paper)
titles=("none" "Akinci et al. 2013" "improved (the paper's)")
size=420x300

# figure NAME INTERVAL PLACES CAMERA...: runs, meshes and renders frames at those places, and joins the pictures.
figure() {
  local name=$1 interval=$2 places=$3 method
  shift 3
  step "Run $name" "paper-$name-run.log" "$sessile" compare "scenes/paper/$name.json" \
    --methods "$(IFS=,; echo "${methods[*]}")" --set "output.frame_interval=$interval" -o "$work/$name"
  for method in "${methods[@]}"; do
    local results=$work/$name/$method
    step "Mesh $name, $method" "paper-$name-$method-mesh.log" "$sessile" mesh "$results" --frames "$places"
    step "Render $name, $method" "paper-$name-$method-render.log" \
      "$sessile" render "$results" --no-video --size "$size" --samples "${SAMPLES:-40}" ${THREADS:+--threads "$THREADS"} "$@"
  done
  step "Join $name" "paper-$name-join.log" join "$name"
}

# A line of titles, then a line of pictures for each moment.
join() {
  local name=$1 method column=0 width=${size%x*}
  local columns=() picture
  for method in "${methods[@]}"; do
    local cells=()
    for picture in "$work/$name/$method/render"/frame_*.png; do
      cells+=("$picture")
    done
    convert "${cells[@]}" -bordercolor white -border 2 -append "$work/$name/column.png"
    convert -background white -fill black -font DejaVu-Sans -pointsize 17 -gravity center \
      -size "$((width + 4))x34" "label:${titles[$column]}" "$work/$name/column.png" -append "$work/$name/column$column.png"
    columns+=("$work/$name/column$column.png")
    column=$((column + 1))
  done
  convert "${columns[@]}" +append -colors 255 -define png:compression-level=9 "docs/paper/$name.png"
}

# The middle of the tablet and of the board seen from a fixed place, so that all columns share it.
figure fig3 0.5 1,3,12 --camera 'position=[6.2,4.4,6.4]' --camera 'target=[0.15,0.1,-0.1]' --camera field_of_view=32
figure fig4 0.5 4,9,16 --camera 'position=[7.4,4.6,3.2]' --camera 'target=[0,0,-0.7]' --camera field_of_view=36
say "The pictures are docs/paper/fig3.png and docs/paper/fig4.png"
