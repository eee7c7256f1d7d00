#!/usr/bin/env bash
# Builds everything and runs all tests. Arguments go to ctest.
#
#   scripts/test.sh                 all
#   scripts/test.sh -R EnvMap       those whose name matches
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=$root/build/test
"$root/scripts/setup.sh"
cmake -S "$root" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DFACEPROBE_UNITY=ON \
  -DFACEPROBE_BUILD_TESTS=ON -DFACEPROBE_BUILD_BENCH=ON -DFACEPROBE_TRAIN=ON -DFACEPROBE_PYTHON=ON
cmake --build "$build"
# Threads that wait for others sleep: by default those of OpenMP spin, and take the processor from the test beside them.
OMP_WAIT_POLICY=${OMP_WAIT_POLICY:-passive} ctest --test-dir "$build" --output-on-failure -j2 "$@"
