#!/usr/bin/env bash
# Fails when a lean build (scripts/train_gpu.sh) links what the machines it is for do not have.
#   check_lean.sh CMAKE SOURCE_FOLDER DEPS_FOLDER      configures one and reads what its rooms link
#   check_lean.sh LIST                                 reads such a list: "room: library library ..." a line
set -euo pipefail

check() {
  awk -F ': ' '
    BEGIN { forbidden = "opencv|openimageio|lcms|dnnl|gomp|hdf5|matio|libzip|tinyobj|assimp|openblas|pybind|httplib|faceprobe_(io|assets|assets_model|render|eval)( |$)" }
    tolower($2) ~ forbidden { print "a lean build must not link this: " $0; faults++ }
    { rooms[$1] = 1 }
    END {
      split("faceprobe_synth faceprobe_synth_assets faceprobe_train faceprobe_face faceprobe", wanted, " ")
      for (i in wanted) if (!(wanted[i] in rooms)) { print "a lean build has no " wanted[i]; faults++ }
      if (faults) exit 1
    }' "$1"
}

if [ $# = 1 ]; then
  check "$1"
  exit
fi
build=$(mktemp -d)
trap 'rm -rf "$build"' EXIT
"$1" -S "$2" -B "$build" -DFACEPROBE_LEAN=ON "-DFACEPROBE_DEPS_DIR=$3" >"$build/log" 2>&1 || { cat "$build/log"; exit 1; }
check "$build/lean_links.txt"

# The check can fail.
for fault in "faceprobe_face: opencv_core" "faceprobe_train: PkgConfig::OPENIMAGEIO" "faceprobe_synth: faceprobe_core faceprobe_io faceprobe_net" \
  "faceprobe_synth: faceprobe_io"; do
  { cat "$build/lean_links.txt"; echo "$fault"; } >"$build/planted"
  if check "$build/planted" >/dev/null; then
    echo "FAILED: \"$fault\" was not found"
    exit 1
  fi
done
grep -v '^faceprobe_face:' "$build/lean_links.txt" >"$build/planted"
if check "$build/planted" >/dev/null; then
  echo "FAILED: a room that is missing was not noticed"
  exit 1
fi
