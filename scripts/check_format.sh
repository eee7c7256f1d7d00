#!/usr/bin/env bash
# Fails when a source file is not formatted as .clang-format says (clang-format 14, from scripts/setup.sh --dev).
#
#   scripts/check_format.sh          checks
#   scripts/check_format.sh --fix    formats the files in place
set -euo pipefail

cd "$(dirname "${BASH_SOURCE[0]}")/.."
command -v clang-format >/dev/null || { echo "clang-format is not installed; run scripts/setup.sh --dev." >&2; exit 1; }
mode=(--dry-run -Werror)
case ${1:-} in
  "") ;;
  --fix) mode=(-i) ;;
  *) echo "unknown option $1; there is --fix." >&2; exit 2 ;;
esac
folders=()
for folder in include src apps bindings tests bench fuzz; do
  if [ -d "$folder" ]; then folders+=("$folder"); fi
done
mapfile -d '' -t sources < <(find "${folders[@]}" -type f \( -name '*.h' -o -name '*.cpp' \) -print0 | sort -z)
clang-format --style=file "${mode[@]}" "${sources[@]}"
echo "${#sources[@]} files are formatted." >&2
