#!/usr/bin/env bash
# cppcheck over the library and the program; any finding fails. What it gets wrong is named here, or at its place by
# `// cppcheck-suppress`.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
options=(--quiet --error-exitcode=1 --std=c++20 --language=c++ --enable=warning,performance,portability -j "$(nproc)"
  --inline-suppr -I src -I apps/sessile
  # It reads no headers of libraries: what it does not know is no fault.
  --suppress=missingIncludeSystem --suppress=missingInclude
  # cppcheck 2.10 cannot read a lambda with a template's parameters; Clang's own checks do.
  --suppress=internalAstError:src/sessile/scene/traits.h --suppress=internalAstError:src/sessile/surface/carry.cpp
  # A gather of two floats as one double never looks at it as a number.
  --suppress=invalidPointerCast:src/sessile/core/lanes.h
  # Four numbers, copied for a widget.
  --suppress=passedByValue:apps/sessile/view/field_widgets.cpp
  # Takes the text over from its reader, which has no more use for it.
  --suppress=passedByValue:src/sessile/results/read_vtp.cpp)
exec cppcheck "${options[@]}" src apps
