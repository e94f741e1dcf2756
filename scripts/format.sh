#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Formats every .h and .cpp of the project; with --check, only says which are not formatted.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

case ${1:-} in
  "") mode=(-i) ;;
  --check) mode=(--dry-run -Werror) ;;
  *) echo "usage: scripts/format.sh [--check]" >&2; exit 2 ;;
esac
scripts/sources.sh '*.h' '*.cpp' |
  xargs -0 -r -n 32 -P "$(nproc)" clang-format "${mode[@]}"
