#!/usr/bin/env bash
# scripts/train_gpu.sh: what it packs and what it refuses, with a stand-in for the command that reads the data. Nothing is built or trained.
#   train_gpu_test.sh SOURCE_FOLDER DEPS_FOLDER
set -euo pipefail

script=$1/scripts/train_gpu.sh
export FACEPROBE_DEPS_DIR=$2 XZ_OPT=-0
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
failures=0
fail() { echo "FAILED: $*"; failures=$((failures + 1)); }

# refuses NAME PATTERN ARGUMENTS...: ends with 2 and one sentence that holds PATTERN.
refuses() {
  local name=$1 pattern=$2 status=0 said
  shift 2
  said=$(bash "$script" "$@" 2>&1 >/dev/null) || status=$?
  [ $status = 2 ] || fail "$name ended with $status"
  grep -q -- "$pattern" <<<"$said" || fail "$name said: $said"
}

mkdir -p "$folder"/data/hdri/{train,dev} "$folder"/data/faces/{ict_facekit,london_uv_textures}
touch "$folder/data/hdri/train/studio.hdr" "$folder/data/hdri/train/open3d_studio.hdr" "$folder/data/hdri/dev/park.hdr"
cat >"$folder/faceprobe" <<'STANDIN'
#!/usr/bin/env bash
# Writes where -o says; notes which maps it was given.
while [ $# -gt 0 ]; do
  case $1 in
    -o) head -c 1500000 /dev/urandom >"$2" ;;
    --maps) ls "$2" >>"$MAPS_SEEN" ;;
  esac
  shift
done
STANDIN
chmod +x "$folder/faceprobe"
export MAPS_SEEN=$folder/maps_seen

bash -n "$script" || fail "the script does not parse"
if command -v shellcheck >/dev/null; then shellcheck "$script" || fail "shellcheck"; fi
refuses "no name" "two names" pack
refuses "no data" "hdri/train" pack "$folder" "$folder/out.tar"
refuses "a word for a number" "whole number" pack "$folder/data" "$folder/out.tar" --limit-mib many
refuses "an unknown option" "no option --fast" run --fast
refuses "no pack" "no pack" run "$folder/none.tar" "$folder/none.json" "$folder/out"

# Embree alone is more than 4 MiB however it is packed, so that this pack is not.
mkdir "$folder/stored"
printf '#!/bin/sh\nexec cat\n' >"$folder/stored/xz"
chmod +x "$folder/stored/xz"
PATH=$folder/stored:$PATH refuses "a pack that is too large" "4 MiB are allowed. Give a lower --map-height" \
  pack "$folder/data" "$folder/out.tar" --faceprobe "$folder/faceprobe" --limit-mib 4
[ ! -e "$folder/out.tar" ] || fail "a pack that is too large was written"

bash "$script" pack "$folder/data" "$folder/out.tar" --faceprobe "$folder/faceprobe" 2>/dev/null || fail "packing"
listed=$(tar -tf "$folder/out.tar")
for wanted in source/CMakeLists.txt source/apps/cli/main.cpp source/scripts/train_gpu.sh source/models/face.safetensors carried/lib/libembree3.so.3 \
  carried/lib/libtbb.so.12 carried/include/Eigen/Core carried/include/embree3/rtcore.h carried/tflite/libtensorflowlite_c.so \
  carried/data/face_landmark.tflite assets/faces.safetensors assets/maps_train.safetensors assets/maps_dev.safetensors; do
  grep -qx "$wanted" <<<"$listed" || fail "the pack has no $wanted"
done
if grep -q open3d "$MAPS_SEEN"; then fail "a map whose terms are unknown was packed"; fi

[ $failures = 0 ] && echo "as it should be"
