#!/usr/bin/env bash
# Installs a build into a fresh folder, moves that folder, and builds and runs the project of tests/consumer by pkg-config alone.
#   use_pkg_config.sh CMAKE BUILD_FOLDER SOURCE_FOLDER CXX_COMPILER PHOTO
set -euo pipefail

cmake=$1 build=$2 source=$3 compiler=$4 photo=$5
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

"$cmake" --install "$build" --prefix "$folder/first" >"$folder/install.log" || { cat "$folder/install.log"; exit 1; }
mv "$folder/first" "$folder/moved"

file=$(find "$folder/moved" -name faceprobe.pc)
[ -n "$file" ] || { echo "no faceprobe.pc was installed"; exit 1; }
if grep -nF -e "$source" -e "$build" -e "$folder/first" "$file"; then
  echo "faceprobe.pc names a folder of this machine"
  exit 1
fi
PKG_CONFIG_PATH=$(dirname "$file")
export PKG_CONFIG_PATH
pkg-config --validate faceprobe
[ "$(pkg-config --modversion faceprobe)" = "$("$folder/moved/bin/faceprobe" --version)" ] || { echo "the version is another"; exit 1; }

# As somebody compiles who knows only what pkg-config says, without our -march: structs that hold matrices must have the library's layout,
# which only shows when an estimate is made and freed.
flags=$(pkg-config --cflags --libs faceprobe)
# shellcheck disable=SC2086  # they are words
"$compiler" -std=c++20 -O1 "$source/tests/consumer/project/main.cpp" $flags -o "$folder/consumer"
if [ -f "$photo" ]; then set -- "$photo"; else set --; fi
output=$(FACEPROBE_DATA_DIR="$folder/moved/share/faceprobe" "$folder/consumer" "$@")
echo "$output"
grep -q "installed package works" <<<"$output"
[ $# = 0 ] || grep -q "% of the energy" <<<"$output" || { echo "the photo has no lights"; exit 1; }
