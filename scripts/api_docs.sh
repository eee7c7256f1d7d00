#!/usr/bin/env bash
# Makes the reference of the C++ library by Doxygen. Fails on each warning, and on each declaration that does not say what docs/api/rules.awk
# asks for.
#
#   scripts/api_docs.sh             writes out/api/index.html
#   scripts/api_docs.sh FOLDER      writes FOLDER/index.html
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
folder=$(realpath -m "${1:-$root/out/api}")
command -v doxygen >/dev/null || { echo "api_docs: Doxygen is not installed; on Debian it is in the package doxygen." >&2; exit 1; }

cd "$root"
version=$(sed -n 's/.*kVersion = "\([0-9.]*\)".*/\1/p' include/faceprobe/core/version.h)
mkdir -p "$folder"
log=$(mktemp)
trap 'rm -f "$log"' EXIT
status=0
{
  cat docs/api/Doxyfile
  echo "PROJECT_NUMBER = $version"
  echo "OUTPUT_DIRECTORY = \"$folder\""
} | doxygen - 2>"$log" || status=$?
# What the filters find wrong does not change how Doxygen ends.
if [ "$status" != 0 ] || [ -s "$log" ]; then
  sort -u "$log" | sed "s|$root/||" >&2
  echo "api_docs: $(sort -u "$log" | wc -l) warnings; there must be none." >&2
  exit 1
fi
echo "api_docs: $folder/index.html, $(find "$folder" -name '*.html' | wc -l) pages, no warnings" >&2
