#!/usr/bin/env bash
# Shows that headers_alone.sh can fail: each fault is planted alone in a small clean folder and has to be found there.
#   headers_alone_test.sh CXX_COMPILER
set -euo pipefail

check=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)/headers_alone.sh
compiler=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
failures=0

clean_folder() {
  rm -rf "${folder:?}"/*
  mkdir -p "$folder"/faceprobe/{core,io} "$folder/Eigen"
  echo '#pragma once' >"$folder/Eigen/Core"
  printf '%s\n' '#pragma once' '#include <string>' 'struct Name { std::string text; };' >"$folder/faceprobe/core/name.h"
  printf '%s\n' '#pragma once' '#include <Eigen/Core>' 'struct Grid { int cells = 0; };' >"$folder/faceprobe/core/grid.h"
  printf '%s\n' '#pragma once' '#include "faceprobe/core/grid.h"' 'struct File { Grid grid; };' >"$folder/faceprobe/io/file.h"
}

# expect NAME PATTERN FILE LINE...: with FILE of those lines the check fails and says PATTERN.
expect() {
  local name=$1 pattern=$2 file=$3 output
  shift 3
  clean_folder
  printf '%s\n' "$@" >"$folder/$file"
  if output=$(bash "$check" "$folder" "$compiler" 2>&1); then
    echo "FAILED: $name was not found"
    failures=$((failures + 1))
  elif ! grep -q "$pattern" <<<"$output"; then
    echo "FAILED: $name gave another message: $output"
    failures=$((failures + 1))
  fi
}

clean_folder
output=$(bash "$check" "$folder" "$compiler" 2>&1) || true
[ "$output" = "1 headers compile alone, 2 by rooms in the opposite order of their names" ] ||
  { echo "FAILED: of the clean folder it says $output"; failures=$((failures + 1)); }

expect "a light header without its include" "FAILED: faceprobe/core/name.h alone" \
  faceprobe/core/name.h '#pragma once' 'struct Name { std::string text; };'
expect "a header without the one it stands on" "FAILED: io's headers in the opposite order" \
  faceprobe/io/file.h '#pragma once' '#include <Eigen/Core>' 'struct File { Grid grid; };'
expect "a warning" "unused parameter" faceprobe/core/name.h '#pragma once' 'inline int zero(int count) { return 0; }'

[ $failures = 0 ] && echo "every planted fault was found"
