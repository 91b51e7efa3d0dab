# Sourced by the scripts: saying what happens, running steps, one clear line when one fails.

cd "$(dirname "${BASH_SOURCE[0]}")/.."
logs=build/log

say() { printf '%s\n' "$*"; }

# fail SENTENCE: ends the script with one line.
fail() {
  printf '%s: error: %s\n' "$0" "$*" >&2
  exit 1
}

# Shows the last line of what comes in, on one line of a terminal.
show_last_line() {
  local line width
  width=$(tput cols 2>/dev/null || echo 80)
  while IFS= read -r line; do printf '\r\033[K  %.*s' $((width - 3)) "$line"; done
  printf '\r\033[K'
}

# run_step TITLE LOG COMMAND...: runs the command with its output in build/log/LOG; returns its exit code.
run_step() {
  local title=$1 log=$logs/$2 start=$SECONDS status=0
  shift 2
  mkdir -p "$logs"
  if [ -t 1 ]; then
    say "$title"
    "$@" </dev/null 2>&1 | tee "$log" | show_last_line || status=$?
  else
    printf '%s ... ' "$title"
    "$@" </dev/null >"$log" 2>&1 || status=$?
    if [ $status -eq 0 ]; then say "done, $((SECONDS - start)) s"; else say "failed"; fi
  fi
  return $status
}

# step TITLE LOG COMMAND...: the same; when the command fails, shows the end of the log and ends the script.
step() {
  local status=0
  run_step "$@" || status=$?
  if [ $status -ne 0 ]; then
    tail -n 25 "$logs/$2" | sed 's/^/  | /'
    fail "$1: failed (exit code $status); the whole log is $PWD/$logs/$2"
  fi
}

# Compilations at a time: one a core, and no more than 1.8 GB of free memory each allows.
jobs_at_once() {
  awk -v cores="$(nproc)" '/^MemAvailable/ {n = int($2 / 1800000)} END {print n < 1 ? 1 : n < cores ? n : cores}' \
    /proc/meminfo
}

# Keeps two scripts from building in one folder at the same time.
lock_build() {
  mkdir -p build
  exec 9>build/.lock
  flock -n 9 || { say "waiting for another script that builds in $PWD/build"; flock 9; }
}
