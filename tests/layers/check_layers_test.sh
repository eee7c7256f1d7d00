#!/usr/bin/env bash
# Shows that check_layers.sh can fail: each fault is planted alone in a small clean tree and has to be found there.
set -euo pipefail

check=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)/check_layers.sh
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT
failures=0

clean_tree() {
  rm -rf "${tree:?}"/*
  mkdir -p "$tree"/include/faceprobe/{core,io,lighting} "$tree"/src/{core,io,net/torch,face,lighting,pipeline} "$tree/apps/cli"
  echo '#include <vector>' >"$tree/include/faceprobe/core/image.h"
  echo '#include "faceprobe/core/image.h"' >"$tree/include/faceprobe/io/photo.h"
  printf '%s\n' '#include "faceprobe/io/photo.h"' '#include "io/header.h"' '#include <cmath>' >"$tree/src/io/photo.cpp"
  printf '%s\n' '// #include "faceprobe/pipeline/estimate.h" in a comment is no include' >"$tree/src/core/image.cpp"
  echo '#include <torch/torch.h>' >"$tree/src/net/torch/unet.cpp"
  printf '%s\n' '#include "cli/report.h"' '#include "faceprobe/pipeline/estimate.h"' >"$tree/apps/cli/main.cpp"
}

# expect NAME PATTERN FILE LINE...: the check fails on the clean tree with FILE of those lines, and says PATTERN.
expect() {
  local name=$1 pattern=$2 file=$3 output
  shift 3
  clean_tree
  printf '%s\n' "$@" >"$tree/$file"
  if output=$(bash "$check" "$tree"); then
    echo "FAILED: $name was not found"
    failures=$((failures + 1))
  elif ! grep -q "^$file:[0-9]*: .*$pattern" <<<"$output"; then
    echo "FAILED: $name gave another message: $output"
    failures=$((failures + 1))
  fi
}

clean_tree
bash "$check" "$tree" >/dev/null || { echo "FAILED: the clean tree has a fault"; failures=$((failures + 1)); }

expect "an upward arrow" "core may not include io" src/core/up.cpp '#include "faceprobe/io/photo.h"'
expect "an upward arrow in a public header" "io may not include lighting" include/faceprobe/io/up.h '#include "faceprobe/lighting/solve.h"'
expect "an upward arrow to an internal header" "io may not include face" src/io/up.cpp '#include "face/mesh.h"'
expect "an upward arrow in angle brackets" "core may not include io" src/core/up.cpp '  #  include <faceprobe/io/photo.h>'
expect "a sideways arrow" "lighting may not include face" src/lighting/side.cpp '#include "faceprobe/face/face.h"'
expect "a library that includes an app" "pipeline may not include apps" src/pipeline/up.cpp '#include "apps/report.h"'
expect "an internal header in a public one" "internal" include/faceprobe/io/leak.h '#include "io/header.h"'
expect "torch in lighting" "torch" src/lighting/net.cpp '#include <torch/torch.h>'
expect "torch in what runs networks" "torch" src/net/net.cpp '#include <torch/torch.h>'
expect "what stands on torch, in the rooms of every build" "torch" src/pipeline/net.cpp '#include "faceprobe/net/torch_highlight_net.h"'
expect "a relative include" "relative" src/lighting/relative.cpp '#include "../face/face.h"'
expect "a room that is not in the plan" "not a room" src/io/other.cpp '#include "faceprobe/cellar/wine.h"'
mapfile -t lines < <(seq -f '// %g' 601)
expect "a file of 601 lines" "600" src/core/long.cpp "${lines[@]}"

[ $failures = 0 ] && echo "every planted fault was found"
