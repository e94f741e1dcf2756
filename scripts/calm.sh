#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Reports files of more than 400 lines and functions of more than 40: aims, not gates.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

scripts/sources.sh '*.h' '*.cpp' | xargs -0 -r awk '
  # A function opens on an unindented line, or inside a class on one indented by two, and closes
  # with a brace at the same indent.
  function closed() {
    if (FNR - first + 1 > 40) printf "%s:%d: function of %d lines\n", FILENAME, first, FNR - first + 1
    ++functions
    first = 0
  }
  FNR == 1 { if (previous && count > 400) printf "%s: file of %d lines\n", previous, count
             previous = FILENAME; first = 0; ++files }
  { count = FNR }
  !first && /^( ?  ?)?[A-Za-z~].*[(].*[{]$/ && !/^ *(namespace|struct|class|enum|union|if|for|while|switch|do|else|return|using)\>/ {
    match($0, /^ */); indent = RLENGTH; first = start ? start : FNR; start = 0; next }
  !first && /^( ?  ?)?[A-Za-z~].*[(][^;{}]*$/ && !/^ *(namespace|struct|class|enum|union|if|for|while|switch|do|else|return|using|static_assert)\>/ { match($0, /^ */); indent = RLENGTH; start = FNR; next }
  !first && start && /[{]$/ { first = start; start = 0; next }
  !first && /[;}]$/ { start = 0 }
  first && /^ *}/ { match($0, /^ */); if (RLENGTH == indent) closed() }
  END { if (count > 400) printf "%s: file of %d lines\n", previous, count
        printf "%d files, %d functions\n", files, functions }'
