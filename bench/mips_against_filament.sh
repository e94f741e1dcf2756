#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Times kiln's roughness mips of a normal map against Filament's roughness-prefilter (Debian package
# libfilament-tools): whole processes, in turn on this machine, medians, PNG in and a PNG per level
# out; and kiln's computing alone. Filament's computing is taken as its whole process less the time
# that reading the PNG takes kiln, which reads no faster. Then both tools' errors against brute
# force.
#
#   bench/mips_against_filament.sh [NORMAL_MAP] [KILN] [RUNS]
#
# The map is resized to 4096 x 4096; without one, textures/woven_fabric's is taken.
set -euo pipefail
here=$PWD
cd "$(dirname "${BASH_SOURCE[0]}")/.."

map=$(cd "$here" && realpath "${1:-$OLDPWD/textures/woven_fabric/woven_fabric_normal.png}")
kiln=$(realpath "${2:-build/release/bin/kiln}")
bin=$(dirname "$kiln")
runs=${3:-5}
roughness=0.3
for tool in roughness-prefilter oiiotool; do
  command -v "$tool" > /dev/null || {
    echo "$tool is not here: apt-get install libfilament-tools openimageio-tools" >&2
    exit 3
  }
done
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

source bench/timing.sh

oiiotool "$map" --ch R,G,B --resize 4096x4096 -d uint8 -o "$work/normal.png"
mkdir "$work/theirs_levels"
cat > "$work/material.yaml" << YAML
version: 1
sets:
  - name: normals
    maps:
      normal: { path: normal.png, convention: gl }
      roughness: { value: $roughness }
bakes:
  - { bake: mips, map: roughness, format: files, out: "ours_levels/r.png" }
YAML
: > "$work/ours"
: > "$work/theirs"
for ((i = 0; i < runs; i++)); do
  timed roughness-prefilter --roughness=$roughness "$work/normal.png" \
    "$work/theirs_levels/r.png" >> "$work/theirs"
  timed "$kiln" run "$work/material.yaml" -o "$work" >> "$work/ours"
done
"$bin/bench_mips" "$work/normal.png" $roughness "$runs" > "$work/alone"
reading=$(sed -n 's/^reading //p' "$work/alone")
computing=$(sed -n 's/^computing vmf //p' "$work/alone")
awk -v a="$(median "$work/theirs")" -v b="$(median "$work/ours")" -v r="$reading" \
  -v c="$computing" -v n="$runs" 'BEGIN {
  a /= 1000; b /= 1000
  printf "4096 x 4096   roughness-prefilter, whole process %8.1f ms   (medians of %d)\n", a, n
  printf "              roughness-prefilter, computing     %8.1f ms   (reading %.1f ms)\n", a - r, r
  printf "  kiln, whole process %8.1f ms   ratio %6.1f\n", b, a / b
  printf "  kiln, computing     %8.1f ms   ratio %6.1f\n", c, (a - r) / c }'
echo "errors of lobes against brute force, roughness $roughness, 'theirs' is roughness-prefilter:"
"$bin/mips_judge" "$work/normal.png" gl $roughness 100 "$work/theirs_levels/r" | sed 's/^/  /'
