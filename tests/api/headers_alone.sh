#!/usr/bin/env bash
# Fails when a public header does not compile by itself, because something that it needs comes only with what others include before it.
#   headers_alone.sh INCLUDE_FOLDER CXX_COMPILER [FLAG ...]
#
# Each header alone would be right, and takes minutes, nearly all of it for reading Eigen again. So: alone are those that do without Eigen, and
# faceprobe.h; the others are read room by room in the opposite order of their names.
set -euo pipefail

include=$1 compiler=$2
shift 2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$include"
mapfile -t headers < <(find faceprobe -name '*.h' | sort)
[ ${#headers[@]} -gt 0 ] || { echo "no headers under $include"; exit 1; }
flags=(-std=c++20 -Wall -Wextra -Wconversion -Werror -I. "$@")

# reaching PATTERN: the headers that a file of such a name comes with, by whatever way.
reaching() {
  awk -v pattern="^#include <$1" '
  FNR == 1 { file[FILENAME] }
  $0 ~ pattern { heavy[FILENAME] }
  /^#include "faceprobe\// { split($0, part, "\""); uses[FILENAME] = uses[FILENAME] " " part[2] }
  END {
    do {
      found = 0
      for (f in file) {
        if (f in heavy) continue
        n = split(uses[f], one, " ")
        for (i = 1; i <= n; i++) if (one[i] in heavy) { heavy[f]; found = 1; break }
      }
    } while (found)
    for (f in heavy) print f
  }' "${headers[@]}" | sort -r
}

# read_once NAME: makes NAME.h, which includes <NAME>, to be put before headers that come with <NAME> anyway, so that it is read once. Before others
# it could hide that they lack something.
mkdir "$folder/once"
read_once() {
  mkdir -p "$(dirname "$folder/once/$1")"
  echo "#include <$1>" >"$folder/once/$1.h"
  "$compiler" "${flags[@]}" -x c++-header "$folder/once/$1.h" -o "$folder/once/$1.h.gch"
}

failures=0
# check NAME [FLAG ...]: the source on stdin compiles.
check() { "$compiler" "${flags[@]}" -fsyntax-only "${@:2}" -x c++ - || { echo "FAILED: $1"; failures=$((failures + 1)); }; }

heavy=$(reaching Eigen/)
slow=$(reaching filesystem)
if [ -n "$heavy" ]; then read_once Eigen/Core; fi
if [ -n "$slow" ]; then read_once filesystem; fi

alone=0
for header in "${headers[@]}"; do
  once=()
  if grep -qxF "$header" <<<"$heavy"; then
    [ "$header" = faceprobe/faceprobe.h ] || continue
    once=(-include "$folder/once/Eigen/Core.h")
  elif grep -qxF "$header" <<<"$slow"; then
    once=(-include "$folder/once/filesystem.h")
  fi
  check "$header alone" "${once[@]}" <<<"#include \"$header\""
  alone=$((alone + 1))
done
rooms=$(cut -d/ -f2 <<<"$heavy" | grep -v '\.h$' | sort -u)
for room in $rooms; do
  check "$room's headers in the opposite order" -include "$folder/once/Eigen/Core.h" < <(grep "^faceprobe/$room/" <<<"$heavy" | sed 's/.*/#include "&"/')
done

[ $failures = 0 ] || exit 1
echo "$alone headers compile alone, $((${#headers[@]} - alone)) by rooms in the opposite order of their names"
