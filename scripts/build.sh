#!/usr/bin/env bash
# Builds the product: the command `faceprobe`, its page and manual, and the libraries that `cmake --install` puts in place; no tests and benchmarks. The last line on stdout is the program's
# path; everything else goes to stderr.
#
#   "$(scripts/build.sh)" --help
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=$root/build/release
{
  "$root/scripts/setup.sh"
  cmake -S "$root" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DFACEPROBE_UNITY=ON \
    -DFACEPROBE_BUILD_TESTS=OFF -DFACEPROBE_BUILD_BENCH=OFF
  cmake --build "$build"
} >&2
echo "$build/bin/faceprobe"
