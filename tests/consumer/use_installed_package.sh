#!/usr/bin/env bash
# Installs a build into a fresh folder, moves that folder, and builds and runs the project beside this script on it.
#   use_installed_package.sh CMAKE BUILD_FOLDER SOURCE_FOLDER CXX_COMPILER
set -euo pipefail

cmake=$1 build=$2 source=$3 compiler=$4
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

"$cmake" --install "$build" --prefix "$folder/first" >"$folder/install.log" || { cat "$folder/install.log"; exit 1; }
# What still works after a move does not depend on where it was installed.
mv "$folder/first" "$folder/moved"

if grep -rlF -e "$source/" -e "$build" "$folder/moved" --include='*.cmake' --include='*.h'; then
  echo "the files above name the source or build folder"
  exit 1
fi

"$cmake" -S "$here/project" -B "$folder/build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER="$compiler" \
  -DCMAKE_PREFIX_PATH="$folder/moved"
"$cmake" --build "$folder/build"
FACEPROBE_DATA_DIR="$folder/moved/share/faceprobe" "$folder/build/consumer"

# The installed command finds its libraries by itself.
"$folder/moved/bin/faceprobe" --version
