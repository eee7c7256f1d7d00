#!/usr/bin/env bash
# What finetuning on photos of people does: the table of `faceprobe finetune` on people that were held out, with the error on synthetic faces
# by which its weights are chosen, and that error as `faceprobe eval` measures it. The weights that come of it have seen research-only
# photos; they stay where they are made.
#
#   bench/people.sh --data DIR --faces DEV --training TRAIN [BUILD_DIR]        DEV and TRAIN: the faces of docs/training.md
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
data= faces= training= build=$root/build/test
while [ $# -gt 0 ]; do
  case $1 in
    --data) data=${2:?--data takes a folder}; shift ;;
    --faces) faces=${2:?--faces takes a folder}; shift ;;
    --training) training=${2:?--training takes a folder}; shift ;;
    -*) echo "unknown option $1; there are --data, --faces and --training." >&2; exit 2 ;;
    *) build=$1 ;;
  esac
  shift
done
for folder in "$data" "$faces" "$training"; do
  [ -d "$folder" ] || { echo "usage: bench/people.sh --data DIR --faces DEV --training TRAIN [BUILD_DIR]" >&2; exit 2; }
done
start=$root/models/face.safetensors
work=$build/people
rm -rf "$work"  # a run that is there would go on, and here it is to be measured
"$build/bin/faceprobe" finetune --config "$root/models/finetune.json" --people "$data/real/finetune" --start "$start" --data "$training" \
  --validation "$faces" -o "$work"
"$build/bin/faceprobe" eval highlight --data "$faces" --weights pretrained="$start" --weights finetuned="$work/weights.safetensors" \
  --samples 100 >"$work/eval.md"
printf '\nOn synthetic faces:\n\n'
sed -n "/^### RMSE on the face's skin/,/^### SSIM/p" "$work/eval.md" | grep -E '^\|'
