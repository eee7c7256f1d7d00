#!/usr/bin/env bash
# Trains on another machine, one with a graphics card and little else: g++ (12 or later), CMake, make or ninja, a Python with torch. No network and
# no root are needed there. What it lacks goes along in one file.
#
#   scripts/train_gpu.sh pack DATA OUT.tar           here: sources, Embree, headers, face models, weights to begin with, heads, skins and
#                                                    maps of DATA (docs/data.md); at most 64 MiB
#     --faceprobe FILE    the full command, which reads DATA; default: that of build/test or build/release
#     --map-height N      maps are reduced to it, px; default 128
#     --limit-mib N       default 64
#
#   scripts/train_gpu.sh run OUT.tar CONFIG FOLDER   there: builds, makes faces, finds their meshes, trains. FOLDER gets checkpoint, weights,
#                                                    log and pictures
#     --minutes N         stop after so long, all in all; the same command goes on. Default: no limit
#     --count N           faces to train on; default 20000
#     --dev-count N       faces to measure on; default 2000
#     --start FILE        weights to begin with; a name such as face.safetensors is one of the pack's
#     --resume FOLDER     copy the checkpoint of an earlier FOLDER first, where the machine is another one
#     --work DIR          for the build and the faces; default: build/train_gpu. Kept, so that a second run need not make them again
#     --device NAME       default cuda
#
# `run` ends with 0 when the training is done and with 10 when the time was up before.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
python=${PYTHON:-python3}

say() { echo "train_gpu: $*" >&2; }
die() { say "$*"; exit 2; }
usage() { sed -n '2,/^set /{/^#/s/^# \{0,1\}//p}' "${BASH_SOURCE[0]}"; }
value_of() { [ $# -ge 2 ] || die "$1 needs a value."; echo "$2"; }
whole_number() { [[ $2 =~ ^[0-9]+$ ]] || die "$1 is \"$2\"; a whole number is needed."; }

# ---- here

full_command() {
  local candidate
  for candidate in "$root/build/test/bin/faceprobe" "$root/build/release/bin/faceprobe"; do
    if [ -x "$candidate" ]; then echo "$candidate"; return; fi
  done
  die "there is no faceprobe in build/test or build/release; run scripts/build.sh, or name it with --faceprobe."
}

# A library's file, under the name that others ask for.
carry_library() {
  local file
  file=$(g++ -print-file-name="$1")
  [ -f "$file" ] || die "the library $1 was not found; run scripts/setup.sh."
  cp -L "$file" "$stage/carried/lib/$1"
}

carry_headers() {
  local from
  for from in "$@"; do
    [ -e "$from" ] || die "$from is not there; run scripts/setup.sh."
    cp -rL "$from" "$stage/carried/include/"
  done
}

collect_sources() {
  mkdir -p "$stage/source/apps" "$stage/source/models" "$stage/source/scripts"
  cp -r "$root/CMakeLists.txt" "$root/cmake" "$root/src" "$root/include" "$root/LICENSE" "$root/THIRD_PARTY.md" "$stage/source/"
  cp -r "$root/apps/cli" "$stage/source/apps/"
  cp "$root/scripts/train_gpu.sh" "$stage/source/scripts/"
  cp "$root"/models/*.json "$stage/source/models/"
  cp "$root/models/face.safetensors" "$root/models/highlight.safetensors" "$stage/source/models/"
}

collect_libraries() {
  mkdir -p "$stage/carried/include" "$stage/carried/lib" "$stage/carried/data"
  carry_library libembree3.so.3
  carry_library libtbb.so.12
  carry_headers /usr/include/eigen3/Eigen /usr/include/{embree3,nlohmann,CLI,spdlog,fmt,nanoflann.hpp}
  local deps=${FACEPROBE_DEPS_DIR:-$root/.deps}
  [ -f "$deps/tflite/libtensorflowlite_c.so" ] || die "TensorFlow Lite is not in $deps; run scripts/setup.sh."
  cp -r "$deps/tflite" "$stage/carried/"
  cp "$deps"/data/*.tflite "$deps/data/canonical-face-model.obj" "$stage/carried/data/"
}

collect_data() {
  local data=$1 height=$2 faceprobe=$3 map
  mkdir -p "$stage/assets" "$temporary/train"
  for map in "$data"/hdri/train/*.hdr; do
    case ${map##*/} in
      open3d_*) ;;  # whose terms are not known to be free
      *) ln -s "$map" "$temporary/train/" ;;
    esac
  done
  "$faceprobe" -q synth pack --heads "$data/faces/ict_facekit" --skins "$data/faces/london_uv_textures" -o "$stage/assets/faces.safetensors"
  "$faceprobe" -q synth pack --maps "$temporary/train" --map-height "$height" -o "$stage/assets/maps_train.safetensors"
  "$faceprobe" -q synth pack --maps "$data/hdri/dev" --map-height "$height" -o "$stage/assets/maps_dev.safetensors"
}

in_mib() { awk -v bytes="$1" 'BEGIN { printf "%.1f", bytes / 1048576 }'; }

pack() {
  local faceprobe="" height=128 limit=64 names=() bytes part
  while [ $# -gt 0 ]; do
    case $1 in
      --faceprobe) faceprobe=$(value_of "$@"); shift ;;
      --map-height) height=$(value_of "$@"); whole_number "$1" "$height"; shift ;;
      --limit-mib) limit=$(value_of "$@"); whole_number "$1" "$limit"; shift ;;
      -*) die "pack has no option $1; there are --faceprobe, --map-height and --limit-mib." ;;
      *) names+=("$1") ;;
    esac
    shift
  done
  [ ${#names[@]} = 2 ] || die "pack takes two names: the folder of data and the file to write."
  local data out=${names[1]}
  [ -d "${names[0]}/hdri/train" ] || die "${names[0]} has no hdri/train; name the folder that docs/data.md describes."
  data=$(cd "${names[0]}" && pwd)
  [ -n "$faceprobe" ] || faceprobe=$(full_command)

  temporary=$(mktemp -d)
  trap 'rm -rf "$temporary"' EXIT
  stage=$temporary/pack
  mkdir "$stage"
  say "collecting sources, libraries and data"
  collect_sources
  collect_libraries
  collect_data "$data" "$height" "$faceprobe"
  say "packing"
  XZ_OPT=${XZ_OPT:--6 -T0} tar -C "$stage" --sort=name --owner=0 --group=0 --mtime=@0 -cJf "$temporary/out" source carried assets
  bytes=$(stat -c %s "$temporary/out")
  if [ "$bytes" -gt $((limit * 1048576)) ]; then
    for part in "$stage"/assets/* "$stage"/carried/lib/* "$stage/source"; do
      say "  ${part#"$stage/"}: $(in_mib "$(du -sb "$part" | cut -f 1)") MiB before packing"
    done
    die "the pack would be $(in_mib "$bytes") MiB, and $limit MiB are allowed. Give a lower --map-height (it is $height), or fewer maps or skins; $out was not written."
  fi
  mv "$temporary/out" "$out"
  say "$out: $(in_mib "$bytes") MiB of $limit"
}

# ---- there

left_s() { echo $((end_s - $(date +%s))); }

# A step of the way within the time that is left; all of them go on where they were cut off.
within_time() {
  if [ "$minutes" = 0 ]; then "$@"; return; fi
  local left status=0
  left=$(left_s)
  [ "$left" -gt 0 ] || time_is_up
  timeout --signal=TERM --kill-after=30 "$left" "$@" || status=$?
  if [ $status = 124 ] || [ $status = 137 ]; then time_is_up; fi
  return $status
}

time_is_up() {
  say "the $minutes minutes are over; give the same command again and it goes on."
  exit 10
}

unpack() {
  local stamp
  stamp=$(sha256sum <"$1")
  if [ "$(cat "$work/.stamp" 2>/dev/null)" = "$stamp" ]; then return; fi
  say "unpacking"
  rm -rf "$work/pack" "$work/build"
  mkdir -p "$work/pack"
  # tar calls xz, which may not be there; Python has its own.
  if command -v xz >/dev/null; then tar -xJf "$1" -C "$work/pack"; else "$python" -m tarfile -e "$1" "$work/pack"; fi
  echo "$stamp" >"$work/.stamp"
}

build() {
  local options=(-DCMAKE_BUILD_TYPE=Release -DFACEPROBE_LEAN=ON -DFACEPROBE_NATIVE=ON "-DFACEPROBE_CARRIED=$work/pack/carried") torch=""
  if command -v ninja >/dev/null; then options+=(-G Ninja); fi
  if torch=$("$python" -c 'import os, torch; print(os.path.dirname(torch.__file__))' 2>/dev/null); then
    [ "$("$python" -c 'import torch; print(torch.compiled_with_cxx11_abi())')" = True ] ||
      die "the torch in $torch is compiled for the old C++ ABI, which C++20's library does not fit; torch 2.7 or later is needed."
    options+=("-DFACEPROBE_TORCH_DIR=$torch")
  else
    say "this Python ($python) has no torch; trying libtorch as CMake finds it."
  fi
  say "building"
  within_time cmake -S "$work/pack/source" -B "$work/build" "${options[@]}" >"$work/configure.log" 2>&1 || log_and_die configure
  within_time cmake --build "$work/build" --parallel "$(nproc)" >"$work/build.log" 2>&1 || log_and_die build
}

log_and_die() {
  tail -n 40 "$work/$1.log" >&2
  die "the $1 step failed; all of it is in $work/$1.log."
}

run() {
  local count=20000 dev_count=2000 start="" resume="" device=cuda names=()
  minutes=0
  work=$root/build/train_gpu
  while [ $# -gt 0 ]; do
    case $1 in
      --minutes) minutes=$(value_of "$@"); whole_number "$1" "$minutes"; shift ;;
      --count) count=$(value_of "$@"); whole_number "$1" "$count"; shift ;;
      --dev-count) dev_count=$(value_of "$@"); whole_number "$1" "$dev_count"; shift ;;
      --start) start=$(value_of "$@"); shift ;;
      --resume) resume=$(value_of "$@"); shift ;;
      --work) work=$(value_of "$@"); shift ;;
      --device) device=$(value_of "$@"); shift ;;
      -*) die "run has no option $1; see $0 --help." ;;
      *) names+=("$1") ;;
    esac
    shift
  done
  [ ${#names[@]} = 3 ] || die "run takes three names: the pack, the training config and the folder for what comes of it."
  local file=${names[0]} config=${names[1]} out=${names[2]} net
  [ -f "$file" ] || die "there is no pack $file; make one with \`$0 pack\`."
  [ -f "$config" ] || die "there is no training config $config."
  end_s=$(($(date +%s) + 60 * minutes))
  mkdir -p "$work" "$out"
  work=$(cd "$work" && pwd)
  net=$("$python" -c 'import json, sys; print("face" if json.load(open(sys.argv[1])).get("architecture") == "face" else "highlight")' "$config")

  unpack "$file"
  if [ -n "$start" ] && [ ! -f "$start" ]; then start=$work/pack/source/models/$start; fi
  [ -z "$start" ] || [ -f "$start" ] || die "there are no weights ${start##*/}, neither as a file nor in the pack."
  if [ -n "$resume" ] && [ ! -f "$out/checkpoint.pt" ]; then
    [ -f "$resume/checkpoint.pt" ] || die "there is no checkpoint.pt in $resume."
    cp "$resume/checkpoint.pt" "$out/"
  fi
  build

  local faceprobe=$work/build/bin/faceprobe assets=$work/pack/assets
  export FACEPROBE_DATA_DIR=$work/pack/carried/data
  # Named by what they are made of, so that other counts do not meet them.
  local faces=$work/faces_$count dev=$work/dev_$dev_count
  local status=0 options=(--config "$config" --data "$faces" --validation "$dev" --device "$device" -o "$out" --json)
  within_time "$faceprobe" synth --assets "$assets/faces.safetensors" "$assets/maps_train.safetensors" --split train --count "$count" --seed 1 -o "$faces"
  within_time "$faceprobe" synth --assets "$assets/faces.safetensors" "$assets/maps_dev.safetensors" --split dev --count "$dev_count" --seed 2 -o "$dev"
  if [ "$net" = face ]; then
    within_time "$faceprobe" mesh "$faces"
    within_time "$faceprobe" mesh "$dev"
  fi
  if [ -n "$start" ]; then options+=(--start "$start"); fi
  within_time "$faceprobe" train "$net" "${options[@]}" >"$out/report.json" || status=$?
  if [ $status != 0 ]; then exit $status; fi
  grep -q '"finished":true' "$out/report.json" || time_is_up
  say "the weights are in $out/weights.safetensors"
}

case ${1:-} in
  pack) shift; pack "$@" ;;
  run) shift; run "$@" ;;
  -h | --help) usage ;;
  *) usage >&2; exit 2 ;;
esac
