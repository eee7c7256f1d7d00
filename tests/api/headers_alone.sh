#!/usr/bin/env bash
# Fails when a public header does not compile by itself, because something that it needs comes only with what others include before it.
#   headers_alone.sh INCLUDE_FOLDER CXX_COMPILER [FLAG ...]
#
# Each header alone would be right, and takes minutes, nearly all of it for reading Eigen again. So: alone are those that do without Eigen, and
# faceprobe.h; the others are read room by room in the opposite order of their names.
set -euo pipefail

include=$1 compiler=$2
shift 2
cd "$include"
mapfile -t headers < <(find faceprobe -name '*.h' | sort)
[ ${#headers[@]} -gt 0 ] || { echo "no headers under $include"; exit 1; }
flags=(-std=c++20 -fsyntax-only -Wall -Wextra -Wconversion -Werror -I. "$@" -x c++)

# Headers that Eigen comes with, by whatever way.
heavy=$(awk '
  FNR == 1 { file[FILENAME] }
  /^#include <Eigen\// { heavy[FILENAME] }
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
  }' "${headers[@]}" | sort -r)

failures=0
# check NAME: the source on stdin compiles.
check() { "$compiler" "${flags[@]}" - || { echo "FAILED: $1"; failures=$((failures + 1)); }; }

alone=0
for header in "${headers[@]}"; do
  if [ "$header" != faceprobe/faceprobe.h ] && grep -qxF "$header" <<<"$heavy"; then continue; fi
  check "$header alone" <<<"#include \"$header\""
  alone=$((alone + 1))
done
rooms=$(cut -d/ -f2 <<<"$heavy" | grep -v '\.h$' | sort -u)
for room in $rooms; do
  check "$room's headers in the opposite order" < <(grep "^faceprobe/$room/" <<<"$heavy" | sed 's/.*/#include "&"/')
done

[ $failures = 0 ] || exit 1
echo "$alone headers compile alone, $((${#headers[@]} - alone)) by rooms in the opposite order of their names"
