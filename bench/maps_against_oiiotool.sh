#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Times bakes of maps against what oiiotool (Debian package openimageio-tools) needs to read the
# same inputs and to write the same outputs: whole processes, in turn on this machine, medians.
#
#   bench/maps_against_oiiotool.sh SET [KILN] [RUNS]
#
# SET is a folder with one map each, named Color, Roughness, Metallic, Normal and AO. They are
# resized to 4096 x 4096 first, without their profiles.
set -euo pipefail
here=$PWD
cd "$(dirname "${BASH_SOURCE[0]}")/.."

set=$(cd "$here" && realpath "${1:?the folder of a texture set}")
kiln=$(realpath "${2:-build/release/bin/kiln}")
runs=${3:-5}
command -v oiiotool > /dev/null || {
  echo "oiiotool is not here: apt-get install openimageio-tools" >&2
  exit 3
}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

source bench/timing.sh

# The map of that slot.
map_of() {
  local found=("$work"/maps/*"$1"*.png)
  echo "${found[0]}"
}

# Reads every map that `pack --preset unreal` reads, and writes files like its.
pack_by_oiiotool() {
  oiiotool "$(map_of Color)" -o "$work/BC.png" \
    "$(map_of AO)" --ch 0 "$(map_of Roughness)" --ch 0 "$(map_of Metallic)" --ch 0 \
    --chappend --chappend -d uint8 -o "$work/ORM.png" "$(map_of Normal)" -o "$work/N.png"
}

# The same of derive: two colours and a number in half.
derive_by_oiiotool() {
  oiiotool -i:now=1 "$(map_of AO)" -i:now=1 "$(map_of Metallic)" -i:now=1 "$(map_of Normal)" \
    -i:now=1 "$(map_of Color)" -d half --compression zip -o "$work/f0.exr" \
    -o "$work/diffuse_albedo.exr" \
    -i:now=1 "$(map_of Roughness)" --ch 0 -d half --compression zip -o "$work/alpha.exr"
}

# The same of a split-sum preview: R G B A in half, its colours those of the normal map, which take
# as long to pack as those of a lit picture, or less.
preview_by_oiiotool() {
  oiiotool -i:now=1 "$(map_of AO)" -i:now=1 "$(map_of Metallic)" -i:now=1 "$(map_of Roughness)" \
    -i:now=1 "$(map_of Color)" -i:now=1 "$(map_of Normal)" --ch R,G,B,A=1.0 \
    -d half --compression zip -o "$work/preview.exr"
}

# compare NAME COMMAND...: NAME_by_oiiotool does the same.
compare() {
  local name=$1 i
  shift
  : > "$work/ours"
  : > "$work/theirs"
  for ((i = 0; i < runs; i++)); do
    timed "$@" >> "$work/ours"
    timed "${name}_by_oiiotool" >> "$work/theirs"
  done
  awk -v n="$name" -v a="$(median "$work/theirs")" -v b="$(median "$work/ours")" 'BEGIN {
    printf "%-8s kiln %8.0f ms   oiiotool %8.0f ms   ratio %.2f\n", n, b / 1000, a / 1000, b / a }'
}

mkdir -p "$work/maps" "$work/made"
for map in "$set"/*.png "$set"/*.jpg; do
  [ -e "$map" ] || continue
  oiiotool "$map" --resize 4096x4096 --eraseattrib ICCProfile -d uint8 \
    -o "$work/maps/$(basename "${map%.*}").png"
done
echo "kiln's time over that of oiiotool; medians of $runs"
compare pack "$kiln" bake pack "$work/maps" -o "$work/made/pack" --preset unreal
compare derive "$kiln" bake derive "$work/maps" -o "$work/made/derive" \
  --quantities f0,diffuse_albedo,alpha
compare preview "$kiln" preview "$work/maps" --env textures/env/studio.exr --mode split-sum \
  -o "$work/made/preview.exr"
