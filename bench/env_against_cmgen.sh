#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Times kiln's environment chains against Filament's cmgen (Debian package libfilament-tools): whole
# processes, in turn on this machine, medians, from an OpenEXR file; and kiln's computing alone.
# Then both tools' errors against brute force.
#
#   bench/env_against_cmgen.sh [IMAGE] [KILN] [RUNS]
#
# IMAGE is a lat-long image; without one, textures/env/studio.exr made 1024 x 512.
set -euo pipefail
here=$PWD
cd "$(dirname "${BASH_SOURCE[0]}")/.."

image=$(cd "$here" && realpath "${1:-$OLDPWD/textures/env/studio.exr}")
kiln=$(realpath "${2:-build/release/bin/kiln}")
bench=$(dirname "$kiln")/bench_environment
runs=${3:-5}
for tool in cmgen oiiotool; do
  command -v "$tool" > /dev/null || {
    echo "$tool is not here: apt-get install libfilament-tools openimageio-tools" >&2
    exit 3
  }
done
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

source bench/timing.sh

compare() {
  local width=$1 size=$2 count=$3 source ours theirs alone
  source="$work/source_$width.exr"
  oiiotool "$image" --ch R,G,B --resize "${width}x$((width / 2))" -d half --compression zip \
    -o "$source"
  : > "$work/ours"
  : > "$work/theirs"
  for ((i = 0; i < count; i++)); do
    timed cmgen --quiet --type=cubemap --format=exr --size="$size" --ibl-samples=1024 \
      --ibl-ld="$work/theirs_$size" "$source" >> "$work/theirs"
    timed "$kiln" env "$source" --size "$size" --format ktx2 -o "$work/ours_$size" >> "$work/ours"
  done
  ours=$(median "$work/ours")
  theirs=$(median "$work/theirs")
  alone=$("$bench" "$source" "$size" "$work/theirs_$size/source_$width" | tee "$work/errors" |
    sed -n 's/^computing //p')
  awk -v w="$width" -v n="$size" -v a="$theirs" -v b="$ours" -v o="$alone" -v c="$count" 'BEGIN {
    printf "%d x %d to a chain of %d   cmgen %8.1f ms   (medians of %d)\n", w, w / 2, n, a / 1000, c
    printf "  kiln, whole process %8.1f ms   ratio %6.1f\n", b / 1000, a / b
    printf "  kiln, computing     %8.1f ms   ratio %6.1f\n", o, a / 1000 / o }'
  sed '/^computing/d; s/^/  /' "$work/errors"
}

# Nanoseconds of computing per texel of the source, and of the chain.
growth() {
  local width=$1 size=$2 source="$work/growth_$1.exr" alone
  oiiotool "$image" --ch R,G,B --resize "${width}x$((width / 2))" -d half -o "$source"
  alone=$("$bench" "$source" "$size" | sed -n 's/^computing //p')
  awk -v w="$width" -v n="$size" -v o="$alone" 'BEGIN {
    printf "  %5d x %-5d to %4d   %8.1f ms   %6.1f ns a texel of the source, %6.1f of the chain\n",
           w, w / 2, n, o, o * 1e6 / (w * w / 2), o * 1e6 / (8 * n * n) }'
}

compare 1024 256 "$runs"
compare 4096 512 "$(((runs + 1) / 2))"
echo "growth with the source:"
for width in 1024 2048 4096 8192; do growth "$width" 128; done
echo "growth with the chain:"
for size in 128 256 512 1024; do growth 1024 "$size"; done
