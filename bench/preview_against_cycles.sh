#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Times kiln's reference preview against Blender Cycles (Debian package blender): a white glossy
# plane, GGX without Fresnel, one roughness a texel, under one environment, in turn on this machine.
# Both pictures are judged by their rms error against a converged one of kiln's with another seed,
# and kiln doubles its samples until its error is no greater than that of Cycles.
#
#   bench/preview_against_cycles.sh [IMAGE] [ROUGHNESS] [KILN] [EDGE] [SAMPLES OF CYCLES] \
#     [SAMPLES OF THE CONVERGED PICTURE]
#
# IMAGE is a lat-long environment, ROUGHNESS a map; without them, those of textures/. Times are
# processor seconds of all threads, for machines that others use too; wall seconds in brackets.
# kiln's are those of the whole process, Cycles' those of the rendering alone.
set -euo pipefail
here=$PWD
cd "$(dirname "${BASH_SOURCE[0]}")/.."

root=$PWD
image=$(cd "$here" && realpath "${1:-$root/textures/env/studio.exr}")
map=$(cd "$here" && realpath "${2:-$root/textures/rusted_iron/rusted_iron_occlusionRoughnessMetallic.png}")
kiln=$(cd "$here" && realpath "${3:-$root/build/release/bin/kiln}")
edge=${4:-1024}
samples=${5:-64}
converged=${6:-2048}
for tool in blender oiiotool; do
  command -v "$tool" > /dev/null || {
    echo "$tool is not here: apt-get install blender openimageio-tools" >&2
    exit 3
  }
done
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

channels=$(oiiotool --info "$map" | sed -n 's/.*, \([0-9]\) channel.*/\1/p')
oiiotool "$map" --ch "$((channels > 1 ? 1 : 0))" --chnames Y --resize "${edge}x$edge" -d uint8 \
  -o "$work/roughness.png"
oiiotool "$image" --ch R,G,B -d float -o "$work/env.exr"
cat > "$work/glossy.yaml" << YAML
maps:
  diffuse: { value: 0 }
  specular_color: { value: 1 }
  roughness: roughness.png
material: { workflow: albedo-specular-roughness, masking: smith-separable, energy: none }
YAML

# preview SAMPLES SEED OUT: prints processor seconds and wall seconds.
preview() {
  local times="$work/times"
  TIMEFORMAT='%U %S %R'
  { time "$kiln" preview "$work/glossy.yaml" --env "$work/env.exr" --samples "$1" --seed "$2" \
    --type float -q -o "$3" 2> "$work/log"; } 2> "$times"
  awk 'END { print $1 + $2, $3 }' "$times"
}

cycles() {
  blender -b --python bench/preview_cycles.py -- "$work/env.exr" "$work/roughness.png" "$edge" \
    "$1" "$2" "$3" > "$work/blender.log" 2>&1 || { cat "$work/blender.log" >&2; exit 1; }
  sed -n 's/^rendering \([0-9.]*\) \([0-9.]*\)/\2 \1/p' "$work/blender.log"
}

colors() { oiiotool "$1" --ch R,G,B -d float -o "$2"; }

# oiiotool fails where pictures differ, as these do.
rms() { { oiiotool --diff "$1" "$2" || true; } | sed -n 's/.*RMS error = *//p' | head -1; }
mean() { oiiotool --stats "$1" | sed -n 's/.*Stats Avg: \([^(]*\)(.*/\1/p'; }
better() { awk -v a="$1" -v b="$2" 'BEGIN { exit !(a <= b) }'; }

echo "$edge x $edge texels, $(basename "$image")"
read -r cpu wall <<< "$(preview "$converged" 77 "$work/converged.exr")"
colors "$work/converged.exr" "$work/truth.exr"
read -r their_cpu their_wall <<< "$(cycles "$samples" 1 "$work/cycles.exr")"
colors "$work/cycles.exr" "$work/theirs.exr"
their_error=$(rms "$work/theirs.exr" "$work/truth.exr")
printf 'Cycles  %6d samples  %8.2f s (%7.2f)  rms error %.5f\n' "$samples" "$their_cpu" \
  "$their_wall" "$their_error"
for ((n = 16; n <= 4096; n *= 2)); do
  read -r our_cpu our_wall <<< "$(preview "$n" 1 "$work/kiln.exr")"
  colors "$work/kiln.exr" "$work/ours.exr"
  our_error=$(rms "$work/ours.exr" "$work/truth.exr")
  printf 'kiln    %6d samples  %8.2f s (%7.2f)  rms error %.5f\n' "$n" "$our_cpu" "$our_wall" \
    "$our_error"
  if better "$our_error" "$their_error"; then break; fi
done
awk -v tc="$their_cpu" -v te="$their_error" -v oc="$our_cpu" -v oe="$our_error" -v s="$samples" \
  -v n="$edge" 'BEGIN {
  printf "time to an error no greater: ratio %.1f\n", tc / oc
  printf "time times error squared:    ratio %.1f\n", tc * te * te / (oc * oe * oe)
  printf "Cycles takes %.2f million samples a second of one processor\n", n * n * s / tc / 1e6 }'
# Two renderings of Cycles tell its noise; what they differ from kiln by should be no more, also where
# 16 x 16 texels are averaged and the noise is a sixteenth.
cycles "$samples" 2 "$work/cycles2.exr" > /dev/null
colors "$work/cycles2.exr" "$work/theirs2.exr"
blocks() { oiiotool "$1" --resize:filter=box "$((edge / 16))x$((edge / 16))" -o "$2"; }
for picture in truth theirs theirs2; do blocks "$work/$picture.exr" "$work/$picture.blocks.exr"; done
agree() {
  awk -v d="$(rms "$work/theirs.$2" "$work/truth.$2")" -v t="$(rms "$work/theirs.$2" "$work/theirs2.$2")" \
    -v what="$1" 'BEGIN { printf "%s: Cycles differs from kiln by %.5f rms, its noise is %.5f\n", what, d,
                          t / sqrt(2) }'
}
agree "texels" exr
agree "means of 16 x 16" blocks.exr
echo "means of the colours: Cycles $(mean "$work/theirs.exr"), kiln $(mean "$work/truth.exr")"
