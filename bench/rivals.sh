#!/usr/bin/env bash
# Trains the rivals that are networks and leaves their weights in one folder, as `faceprobe eval paper --rivals OUT` takes them: gardner, sky,
# legendre, mscr, shi and albedo_shading (docs/training.md). What is there is not made again. After a stop the same command goes on: faces, mscr, shi
# and albedo_shading where they were, each of the other three from its beginning.
#
#   bench/rivals.sh DATA OUT [FACES] [--build BUILD_DIR]
#
# DATA is the folder that docs/data.md describes. FACES has the folders train and dev, of docs/training.md; without it they are made in OUT/faces.
# BUILD_DIR (build/test) is a build with FACEPROBE_TRAIN=ON. On two cores the faces took 28 minutes; gardner, sky and legendre take minutes
# each, mscr, shi and albedo_shading longer. OUT/work has the logs; it may be deleted afterwards.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
usage="usage: bench/rivals.sh DATA OUT [FACES] [--build BUILD_DIR]"
build=$root/build/test
folders=()
while [ $# -gt 0 ]; do
  case $1 in
    --build) build=${2:?--build takes a folder}; shift ;;
    -*) echo "unknown option $1; there is --build. $usage" >&2; exit 2 ;;
    *) folders+=("$1") ;;
  esac
  shift
done
if [ ${#folders[@]} -lt 2 ] || [ ${#folders[@]} -gt 3 ]; then
  echo "$usage" >&2
  exit 2
fi
data=${folders[0]} out=${folders[1]} faces=${folders[2]:-}
for needed in hdri/train hdri/dev faces/ict_facekit faces/london_uv_textures; do
  [ -d "$data/$needed" ] || { echo "there is no $data/$needed; docs/data.md says what belongs into the data folder." >&2; exit 2; }
done
if [ -n "$faces" ]; then
  for needed in train dev; do
    [ -f "$faces/$needed/index.json" ] || { echo "$faces/$needed holds no synthetic faces; docs/training.md makes them." >&2; exit 2; }
  done
fi
data=$(cd "$data" && pwd)
faceprobe=$build/bin/faceprobe
[ -x "$faceprobe" ] || { echo "there is no $faceprobe; scripts/test.sh builds it." >&2; exit 2; }
work=$out/work
mkdir -p "$work"
status=0

# The recipes of docs/training.md. A folder that is whole has an index.
if [ -z "$faces" ]; then
  faces=$out/faces
  maps=$work/maps
  mkdir -p "$maps"
  for map in "$data"/hdri/train/*.hdr; do
    case $(basename "$map") in
      open3d_*) ;;  # whose terms are not known to be free
      *) ln -sf "$map" "$maps/" ;;
    esac
  done
  make_faces() {  # NAME MAPS OPTIONS...
    local name=$1 lights=$2
    shift 2
    [ -f "$faces/$name/index.json" ] && return
    echo "rivals: faces, $name" >&2
    "$faceprobe" synth --heads "$data/faces/ict_facekit" --skins "$data/faces/london_uv_textures" --maps "$lights" --split "$name" "$@" \
      -o "$faces/$name"
  }
  make_faces train "$maps" --count 20000 --seed 1
  make_faces dev "$data/hdri/dev" --count 2000 --seed 2
  "$faceprobe" mesh "$faces/train"
  "$faceprobe" mesh "$faces/dev"
fi

# keep NAME: the weights of a training that ran to its end.
keep() {
  cp "$work/$1/weights.safetensors" "$work/$1.part"
  mv "$work/$1.part" "$out/$1.safetensors"
}

train() {  # NAME NET OPTIONS...
  local name=$1 net=$2
  shift 2
  if [ -f "$out/$name.safetensors" ]; then
    echo "rivals: $name is there" >&2
    return
  fi
  echo "rivals: $name" >&2
  # A run that was interrupted ends with 0, too, and says in its JSON that it is not finished.
  if ! "$faceprobe" train "$net" "$@" -o "$work/$name" >"$work/$name.json"; then
    echo "rivals: $name failed; the others go on." >&2
    status=1
  elif grep -q '"finished": *false' "$work/$name.json"; then
    echo "rivals: $name was stopped; the same command goes on." >&2
    exit 1
  else
    keep "$name"
  fi
}

scenes=()
for table in "$data/hdri/train.csv" "$data/hdri/dev.csv"; do
  if [ -f "$table" ]; then scenes+=("$table"); fi
done
if [ ${#scenes[@]} -gt 0 ]; then scenes=(--scenes "${scenes[@]}"); fi

train gardner gardner --data "$data/hdri/train" --validation "$data/hdri/dev" "${scenes[@]}"
train sky sky --data "$data/hdri/train" --validation "$data/hdri/dev" "${scenes[@]}"
train legendre legendre --data "$faces/train" --validation "$faces/dev"
train mscr highlight --config "$root/models/rivals/mscr.json" --data "$faces/train" --validation "$faces/dev" --json
train shi highlight --config "$root/models/rivals/shi.json" --data "$faces/train" --validation "$faces/dev" --json
train albedo_shading highlight --config "$root/models/rivals/albedo_shading.json" --data "$faces/train" --validation "$faces/dev" --json
exit $status
