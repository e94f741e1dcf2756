#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Prints the project's files that match the given patterns, each ended by a zero byte; new ones that
# git does not know yet are among them, deleted ones are not.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

git ls-files -z --cached --others --exclude-standard -- "$@" |
  while IFS= read -r -d '' file; do
    [[ ! -f $file ]] || printf '%s\0' "$file"
  done
