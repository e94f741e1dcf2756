#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Puts the readers of others that tests compare with, and that only npm has, into build/readers.
# Where there is no npm, or it finds no network, those tests skip and say so.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

readers=(ktx-parse@2.0.0 zstddec@0.2.0)
command -v npm >/dev/null || exit 0
for reader in "${readers[@]}"; do
  [[ -d build/readers/node_modules/${reader%@*} ]] || missing=1
done
[[ -n ${missing:-} ]] || exit 0

mkdir -p build/readers
npm install --prefix build/readers --silent --no-audit --no-fund --ignore-scripts \
  --fetch-retries=0 --fetch-timeout=20000 "${readers[@]}" ||
  echo "readers: npm could not install ${readers[*]}; the tests that want them skip" >&2
