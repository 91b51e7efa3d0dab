#!/usr/bin/env bash
# Fuzzes every reader of files: fuzz.sh [SECONDS [TARGET...]], 30 s each unless given, two at a time.
# Builds the harnesses with the preset `asan`, starts them from tests/fuzz/corpus, tests/fuzz/regressions and scenes/, and
# prints a line for each: executions, edges and features covered, inputs that are new. Ends with 1 after a crash, a leak,
# an input that took over 10 s, or one that took over 2 GiB; the inputs are then below build/asan/fuzz/TARGET/findings.
# Variables: FUZZ_JOBS at a time (2), FUZZ_BUILD the build folder, FUZZ_KEEP=1 goes on with inputs found earlier,
# FUZZ_SEED=N begins with the same inputs each time (without it, with others).
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
seconds=${1:-30}
shift || true
targets=("$@")
build=${FUZZ_BUILD:-build/asan}
if [ ${#targets[@]} = 0 ]; then
  targets=(scene overrides method mesh_obj mesh_stl mesh_ply frame_ply frame_vtp results checkpoint checkpoint_file
           session surface_index usda usda_parts verdict)
fi

if [ "$build" = build/asan ]; then
  cmake --preset asan -DSESSILE_FUZZERS=ON >"/dev/null"
else
  cmake -B "$build" -DSESSILE_FUZZERS=ON >"/dev/null"
fi
cmake --build "$build" --parallel "$(nproc)" --target fuzzers >"$build/fuzzers.log" 2>&1 ||
  { cat "$build/fuzzers.log" >&2; echo "fuzz: the harnesses do not build" >&2; exit 1; }

export OMP_NUM_THREADS=1 OMP_WAIT_POLICY=passive
export ASAN_OPTIONS=detect_leaks=1:allocator_may_return_null=0 UBSAN_OPTIONS=print_stacktrace=1:halt_on_error=1

# fuzz NAME: one harness; its log and its findings stay in its folder.
fuzz() {
  local name=$1 place=$build/fuzz/$1 seeds=()
  [ "${FUZZ_KEEP:-}" ] || rm -rf "$place/found"
  rm -rf "$place/findings"
  mkdir -p "$place/found" "$place/findings"
  for folder in "tests/fuzz/corpus/$name" "tests/fuzz/regressions/$name"; do
    [ ! -d "$folder" ] || seeds+=("$folder")
  done
  case $name in
    scene | results) seeds+=(scenes) ;;
    method) seeds+=(scenes/methods) ;;
  esac
  local words=(-max_len=16384 "-seed=${FUZZ_SEED:-0}")
  [ ! -f "tests/fuzz/words/$name.txt" ] || words+=(-dict="tests/fuzz/words/$name.txt")
  "$build/tests/fuzz/fuzz_$name" -max_total_time="$seconds" -timeout=10 -rss_limit_mb=2048 -malloc_limit_mb=2048 \
    -print_final_stats=1 -artifact_prefix="$place/findings/" "${words[@]}" "$place/found" "${seeds[@]}" \
    >"$place/log" 2>&1
}

report() {
  local name=$1 log=$build/fuzz/$1/log
  awk -v name="$name" '
    match($0, /cov: [0-9]+/) { edges = substr($0, RSTART + 5, RLENGTH - 5) }
    match($0, /ft: [0-9]+/) { features = substr($0, RSTART + 4, RLENGTH - 4) }
    /stat::number_of_executed_units/ { runs = $2 }
    /stat::new_units_added/ { fresh = $2 }
    /stat::peak_rss_mb/ { memory = $2 }
    END { printf "fuzz %-16s %10d executions %7d edges %7d features %6d new inputs %5d MiB\n",
                 name, runs, edges, features, fresh, memory }' "$log"
}

failed=0
running=() names=()
reap() { # waits for the oldest
  if ! wait "${running[0]}"; then
    failed=1
    echo "fuzz: ${names[0]} FAILED, see $build/fuzz/${names[0]}/log and its findings/:" >&2
    grep -aE -m 3 'ERROR|SUMMARY|broken promise|runtime error' "$build/fuzz/${names[0]}/log" >&2 || true
  fi
  report "${names[0]}"
  running=("${running[@]:1}") names=("${names[@]:1}")
}
for name in "${targets[@]}"; do
  fuzz "$name" &
  running+=($!) names+=("$name")
  [ ${#running[@]} -lt "${FUZZ_JOBS:-2}" ] || reap
done
while [ ${#running[@]} -gt 0 ]; do reap; done
exit "$failed"
