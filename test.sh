#!/usr/bin/env bash
# Installs what is missing, builds a release with its tests, runs them.
#
#   ./test.sh [--all] [CTEST ARGUMENT...]
#
# --all adds the slow physics. Other arguments go to ctest: ./test.sh -R Kernel, ./test.sh -L unit, ./test.sh -N
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
. tools/steps.sh

selection=(--label-exclude slow)
if [ "${1-}" = --all ]; then
  selection=()
  shift
fi

tools/setup.sh build test
lock_build
step "Configuring" configure.log cmake --preset release -DSESSILE_TESTS=ON
step "Building" build.log cmake --build --preset release --parallel "$(jobs_at_once)"
exec ctest --preset release --parallel "$(nproc)" "${selection[@]}" "$@"
