#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Builds the tests with address and undefined-behaviour sanitizers and runs them, but for the long
# ones. Options of ctest may follow. Threads are not sanitised here: Debian's oneTBB is built
# without ThreadSanitizer, which then reports its every hand-over as a race; preset `tsan` is for a
# oneTBB that is built with it.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

scripts/setup.sh
cmake --preset dev --log-level=WARNING
cmake --build --preset dev
ctest --preset dev -j "$(nproc)" "$@"
