#!/usr/bin/env bash
# Does Blender light a sphere from the side that report.json names? By the script that comes with the map, by hand as docs/recipes.md
# says, and under a made-up map with a red lamp at camera right. Skipped (77) without Blender or without the photo.
#   blender_same_side.sh FACEPROBE DATA_FOLDER [PHOTO]
set -euo pipefail

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
faceprobe=$1 photo=${3:-$2/samples/grace_hopper.jpg}
blender=${BLENDER:-blender}
command -v "$blender" >/dev/null || { echo "there is no $blender"; exit 77; }
[ -f "$photo" ] || { echo "there is no $photo"; exit 77; }

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# check NAME PHOTO
check() {
  local light=$work/$1 quick=(--layer-px 256 --size 128) code=0
  echo "$1:"
  "$faceprobe" estimate "$2" -o "$light" "${quick[@]}"
  "$faceprobe" estimate "$2" -o "$light/by_hand.exr" --orient blender "${quick[@]}"
  # An error in either script becomes Blender's exit code.
  "$blender" --background --factory-startup --python-exit-code 1 --python "$light/blender.py" \
    --python "$here/blender_same_side.py" -- "$light" >"$light/log" 2>&1 || code=$?
  grep -E '^(ok|FAILED|--) ' "$light/log" || true
  [ $code = 0 ] || { tail -n 20 "$light/log"; exit 1; }
}

check photo "$photo"
# README.md's first object.
"$blender" --background --factory-startup --python-exit-code 1 --python "$work/photo/blender.py" \
  --python "$here/../../scripts/blender_demo.py" -- "$work/monkey.png" >"$work/log" 2>&1 || { tail -n 20 "$work/log"; exit 1; }
[ -s "$work/monkey.png" ] || { echo "scripts/blender_demo.py wrote no picture"; exit 1; }
# The same face darkened from the left and reddened: now its main light is at camera right.
if [ $# -lt 3 ] && command -v oiiotool >/dev/null; then
  oiiotool --create 512x600 3 --fill:color=.15,.15,.15 168x600 --fill:left=.15,.15,.15:right=1,.8,.7 188x600+168+0 \
    --fill:color=1,.8,.7 156x600+356+0 "$photo" --mul -d uint8 -o "$work/side.png"
  check side "$work/side.png"
fi
