#!/usr/bin/env bash
# The reference of the C++ library comes out without a warning, with a page for each header; and a planted fault stops it.
#   doxygen_test.sh SOURCE_FOLDER
set -euo pipefail

source=$1
command -v doxygen >/dev/null || { echo "Doxygen is not installed"; exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
failures=0

"$source/scripts/api_docs.sh" "$folder/api"
while read -r header; do
  page=$(sed 's/_/__/g; s|/|__|; s/\.h$//' <<<"${header#faceprobe/}")
  [ "$page" != faceprobe ] || page=umbrella
  [ -s "$folder/api/group__$page.html" ] || { echo "FAILED: $header has no page"; failures=$((failures + 1)); }
done < <(cd "$source/include" && find faceprobe -name '*.h')
# The example is on the page of faceprobe.h, the rooms are told, and no page says where this was run.
for words in group__umbrella.html:load_photo modules.html:"pure numerics" index.html:find_package; do
  grep -q "${words#*:}" "$folder/api/${words%%:*}" || { echo "FAILED: ${words%%:*} lacks ${words#*:}"; failures=$((failures + 1)); }
done
if grep -rlF -e "$source/" -e "$folder/" "$folder/api" --include='*.html'; then
  echo "FAILED: the pages above name a folder of this machine"
  failures=$((failures + 1))
fi

# Faults in a copy, all at once, because Doxygen takes longer than a moment to read it: the reference fails and says each of them.
mkdir "$folder/tree"
(cd "$source" && cp -r --parents include/faceprobe docs/api scripts/api_docs.sh ARCHITECTURE.md CONVENTIONS.md "$folder/tree")
patterns=()
# plant PATTERN FILE EDIT: FILE, changed by that sed command, is to be told of by PATTERN.
plant() {
  patterns+=("$1")
  sed -i "$3" "$folder/tree/$2"
}
plant "core/color.h:[0-9]*: int shades.*no comment says what it gives" include/faceprobe/core/color.h 's|^}  // namespace|int shades(int from);\n\n&|'
plant "mainpage.md:[0-9]*: .*io_nothing" docs/api/mainpage.md 's|^## Where to look|\\ref io_nothing\n\n&|'
plant "rooms.dox:[0-9]*: ARCHITECTURE.md has no room cellar" docs/api/rooms.dox 's/core/core cellar/'
if output=$("$folder/tree/scripts/api_docs.sh" "$folder/faulty" 2>&1); then
  echo "FAILED: no planted fault was found"
  failures=$((failures + 1))
fi
for pattern in "${patterns[@]}"; do
  grep -q "$pattern" <<<"$output" || { echo "FAILED: nothing like \"$pattern\" is among these: $output"; failures=$((failures + 1)); }
done

[ $failures = 0 ] && echo "the reference is whole, and every planted fault was found"
