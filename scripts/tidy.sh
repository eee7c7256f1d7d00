#!/usr/bin/env bash
# Runs clang-tidy (.clang-tidy; version 14, from scripts/setup.sh --dev) over src and apps. Nothing is built: the folder
# build/tidy is configured only for its compile_commands.json.
#
#   scripts/tidy.sh                        all but the rooms of training (synth, assets, train, net/torch)
#   scripts/tidy.sh --all                  synth and assets too; what sees libtorch never, whose headers clang 14 does not take
#   scripts/tidy.sh src/core/env_map.cpp   these files
#   JOBS=4 scripts/tidy.sh                 so many at a time
#
# All files of a room are read as one (CMake's unity build), because reading Eigen takes longer than looking at a file. So two files of
# a room cannot have the same name in their unnamed namespaces; such a name is mostly a helper that should be shared.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=$root/build/tidy
command -v run-clang-tidy >/dev/null || { echo "clang-tidy is not installed; run scripts/setup.sh --dev." >&2; exit 1; }

unity=ON
synth=OFF
patterns=()
for file in "$@"; do
  if [ "$file" = --all ]; then synth=ON; continue; fi
  [ -f "$file" ] || { echo "there is no file $file." >&2; exit 2; }
  unity=OFF
  synth=ON
  patterns+=("^$(realpath "$file" | sed 's/[][\.*^$+?(){}|]/\\&/g')\$")
done
if [ ${#patterns[@]} = 0 ]; then patterns=("/(src|apps)/"); fi

"$root/scripts/setup.sh"
cmake -S "$root" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_COMPILER=clang++ \
  -DCMAKE_EXPORT_COMPILE_COMMANDS=ON -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON -DCMAKE_UNITY_BUILD=$unity \
  -DCMAKE_UNITY_BUILD_BATCH_SIZE=16 -DFACEPROBE_BUILD_TESTS=OFF -DFACEPROBE_BUILD_BENCH=OFF -DFACEPROBE_SYNTH=$synth -DFACEPROBE_TRAIN=OFF >/dev/null
for file in "$@"; do
  [ "$file" != --all ] || continue
  grep -qF "\"$(realpath "$file")\"" "$build/compile_commands.json" || { echo "$file is not among what is checked." >&2; exit 2; }
done
# The one check that minds how a unity build is made.
run-clang-tidy -quiet -p "$build" -checks=-bugprone-suspicious-include -j "${JOBS:-$(nproc)}" "${patterns[@]}"
