#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Times kiln's split-sum table against Filament's cmgen (Debian package libfilament-tools): whole
# processes, in turn on this machine, medians. Then both tables' errors, found by `kiln verify`.
#
#   bench/lut_against_cmgen.sh [KILN] [RUNS]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

kiln=$(realpath "${1:-build/release/bin/kiln}")
runs=${2:-5}
if ! command -v cmgen > /dev/null; then
  echo "cmgen is not here: apt-get install libfilament-tools" >&2
  exit 3
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

source bench/timing.sh

compare() {
  local size=$1 count=$2 ours theirs
  : > "$work/ours"
  : > "$work/theirs"
  for ((i = 0; i < count; i++)); do
    timed cmgen --size="$size" --ibl-dfg="$work/theirs.exr" >> "$work/theirs"
    timed "$kiln" lut split-sum --preset filament --size "$size" -o "$work/ours.exr" \
      >> "$work/ours"
  done
  ours=$(median "$work/ours")
  theirs=$(median "$work/theirs")
  awk -v n="$size" -v a="$theirs" -v b="$ours" -v c="$count" 'BEGIN {
    printf "%5d x %-5d cmgen %8.1f ms   kiln %7.1f ms   ratio %6.1f   (medians of %d)\n",
           n, n, a / 1000, b / 1000, a / b, c }'
}

errors_of() { "$kiln" verify "$1" 2>&1 | grep -E "^  errors" | sed 's/^  errors *//'; }

compare 256 "$runs"
compare 1024 "$(((runs + 1) / 2))"
cmgen --size=128 --ibl-dfg="$work/theirs.exr" > "$work/log" 2>&1
"$kiln" lut split-sum --preset filament --type float --size 128 -o "$work/ours.exr" > "$work/log"
echo "errors of entries at 128, where each file's rows really lie:"
echo "  cmgen  $(errors_of "$work/theirs.exr" || true)"
echo "  kiln   $(errors_of "$work/ours.exr" || true)"
