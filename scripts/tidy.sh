#!/usr/bin/env bash
# Runs clang-tidy (.clang-tidy; version 14, from scripts/setup.sh --dev) over src and apps. Nothing is built: the folder
# build/tidy is configured only for its compile_commands.json.
#
#   scripts/tidy.sh                        all but the rooms of training (synth, assets, net, train), which take half an hour
#   scripts/tidy.sh --all                  those too
#   scripts/tidy.sh src/core/env_map.cpp   these files
#   JOBS=4 scripts/tidy.sh                 so many at a time
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=$root/build/tidy
command -v run-clang-tidy >/dev/null || { echo "clang-tidy is not installed; run scripts/setup.sh --dev." >&2; exit 1; }

training=OFF
patterns=()
for file in "$@"; do
  if [ "$file" = --all ]; then training=ON; continue; fi
  case $file in *src/synth/* | *src/assets/* | *src/net/* | *src/train/* | *apps/*) training=ON ;; esac
  [ -f "$file" ] || { echo "there is no file $file." >&2; exit 2; }
  patterns+=("^$(realpath "$file" | sed 's/[][\.*^$+?(){}|]/\\&/g')\$")
done
if [ ${#patterns[@]} = 0 ]; then patterns=("/(src|apps)/"); fi

"$root/scripts/setup.sh"
cmake -S "$root" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_COMPILER=clang++ \
  -DCMAKE_EXPORT_COMPILE_COMMANDS=ON -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON \
  -DFACEPROBE_BUILD_TESTS=OFF -DFACEPROBE_BUILD_BENCH=OFF \
  -DFACEPROBE_TRAIN=$training -DFACEPROBE_SYNTH=$training >/dev/null
run-clang-tidy -quiet -p "$build" -j "${JOBS:-$(nproc)}" "${patterns[@]}"
