#!/usr/bin/env bash
# Installs a build into a fresh folder, moves that folder, and builds and runs the project beside this script on it.
#   use_installed_package.sh CMAKE BUILD_FOLDER SOURCE_FOLDER CXX_COMPILER DATA_FOLDER
set -euo pipefail

cmake=$1 build=$2 source=$3 compiler=$4
photo=$5/samples/grace_hopper.jpg  # public domain, one face
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
export FACEPROBE_DATA_DIR="$folder/moved/share/faceprobe"
"$folder/build/consumer"

# What the example in faceprobe/faceprobe.h says that it does.
mkdir "$folder/run"
cd "$folder/run"
status=0
"$folder/build/example" >out.txt 2>err.txt || status=$?
[ "$status" = 3 ] || { echo "the example ended with $status where there is no photo, not with 3"; cat err.txt; exit 1; }
grep -q '^portrait.jpg cannot be read' err.txt || { echo "the example did not say which photo it wants:"; cat err.txt; exit 1; }
if [ -f "$photo" ]; then
  "$folder/build/example" "$photo" >out.txt
  cat out.txt
  for line in '^light from [+-][0-9]*, [+-][0-9]* degrees: [0-9]* % of the energy$' '^on a table: [0-9.]* [0-9.]* [0-9.]*$'; do
    grep -q "$line" out.txt || { echo "the example printed no line like $line"; exit 1; }
  done
  for file in light.exr with_pot.png dimmed.png; do
    [ -s "$file" ] || { echo "the example wrote no $file"; exit 1; }
  done
  ! cmp -s with_pot.png dimmed.png || { echo "the example wrote one picture twice"; exit 1; }
fi

# The installed command finds its libraries by itself.
"$folder/moved/bin/faceprobe" --version

# The installed Python package too, and its models.
site=$folder/moved/lib/python3/dist-packages
if [ -d "$site/faceprobe" ] && [ -f "$photo" ]; then
  env -u FACEPROBE_DATA_DIR PYTHONPATH="$site" /usr/bin/python3 - "$photo" "$folder/moved" <<'END'
import sys

import faceprobe as fp

assert fp.__file__.startswith(sys.argv[2]), fp.__file__
estimate = fp.estimate(sys.argv[1])
environment = estimate.faces[0].environment.to_numpy()
assert environment.ndim == 3 and environment.max() > 0
print("from Python:", environment.shape)
END
fi
