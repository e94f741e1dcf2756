#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Runs clang-tidy over src; fails on any finding. Files may be named: scripts/lint.sh src/io/a.cpp
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

scripts/setup.sh
[[ -f build/release/compile_commands.json ]] || cmake --preset release --log-level=WARNING
if [[ $# -gt 0 ]]; then
  printf '%s\0' "$@"
else
  scripts/sources.sh 'src/*.cpp'
fi | xargs -0 -r -n 1 -P "$(nproc)" clang-tidy --quiet -p build/release 2>&1 |
  sed "/^[0-9]* warnings* generated\.$/d"
