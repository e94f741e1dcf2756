#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Sets up, builds, and bakes the demo: every shipped texture set under two environments.
# Options of `kiln run` may follow, e.g. --set samples=256 or -o FOLDER.
set -euo pipefail
here=$PWD
cd "$(dirname "${BASH_SOURCE[0]}")/.."

scripts/setup.sh
cmake --preset release --log-level=WARNING
cmake --build --preset release --target kiln

out=pipelines/out
for ((i = 1; i <= $#; ++i)); do
  [[ ${!i} == -o || ${!i} == --out ]] || continue
  next=$((i + 1))
  [[ ${!next} == /* ]] || set -- "${@:1:i}" "$here/${!next}" "${@:next+1}"
  out=${!next}
done
build/release/bin/kiln run pipelines/demo.yaml "$@"
echo "The pictures are in $(realpath "$out")"
