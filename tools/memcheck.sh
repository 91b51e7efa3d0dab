#!/usr/bin/env bash
# memcheck.sh PROGRAM: a short run of a small scene under valgrind's memcheck, with liquid, a solid, tension, frames and
# checkpoints. Fails on reads and writes of memory that nobody owns, where undefined values decide something, and on
# memory that is lost. The program's baseline instruction set: valgrind 3.19 knows no AVX-512.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
program=${1:?usage: tools/memcheck.sh PROGRAM}
results=$(mktemp -d)
trap 'rm -rf "$results"' EXIT
export SESSILE_ISA=x86-64 OMP_NUM_THREADS=2 OMP_WAIT_POLICY=passive
valgrind --quiet --error-exitcode=9 --leak-check=full --show-leak-kinds=definite,indirect \
  --errors-for-leak-kinds=definite,indirect --suppressions=tools/memcheck.supp \
  "$program" run tools/memcheck.json -o "$results/run" --progress none
