#!/usr/bin/env bash
# Puts objects into twelve freely licensed portraits (docs/data.md) and writes docs/gallery.jpg, one page to look at. Needs ImageMagick.
#
#   bench/gallery.sh --data DIR BUILD [OUT]     DIR holds real/portraits and objects; OUT: where the pictures go, else a temporary folder
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
[ $# -ge 3 ] && [ "$1" = --data ] || { sed -n '4p' "$0" | cut -c3- >&2; exit 2; }
data=$2
program=$3/bin/faceprobe
command -v montage >/dev/null || { echo "gallery: ImageMagick's montage is not installed." >&2; exit 2; }
if [ $# -ge 4 ]; then out=$4; mkdir -p "$out"; else out=$(mktemp -d); trap 'rm -rf "$out"' EXIT; fi
portraits=$data/real/portraits
samples=$root/.deps/data/samples
bunny=$data/objects/stanford-bunny.obj

put() {  # NAME PHOTO OPTIONS...
  local name=$1 photo=$2
  shift 2
  "$program" -q insert "$photo" -o "$out/$name.png" "$@"
}
put 01 "$portraits/astronaut_collins_nasa_pd.png" --object pot --height 0.14
put 02 "$samples/grace_hopper.jpg" --object robot
put 03 "$portraits/cc0_selfies/lisa_lisa1.jpg" --object "$bunny" --material silver --turn -30
put 04 "$portraits/cc0_selfies/lisa_lisa3.jpg" --object spheres
put 05 "$portraits/cc0_selfies/zoom_60cm.jpg" --object pot --material gold
put 06 "$portraits/cc0_selfies/zoom_30cm.jpg" --object sphere --material glass
put 07 "$portraits/london_fullres/069_03.jpg" --object "$bunny" --material plastic
put 08 "$portraits/london_fullres/099_03.jpg" --object spheres --height 0.06
put 09 "$portraits/london_fullres/140_03.jpg" --object robot --turn -20
put 10 "$portraits/london_fullres/173_03.jpg" --object pot --material red
put 11 "$portraits/london/smiling_front/002_08.jpg" --object cube --turn 30 --height 0.05
put 12 "$portraits/cc0_selfies/zoom_45cm.jpg" --object sphere --material mirror --at 150 700 --distance 0.7 --height 0.15 --no-ground
montage "$out"/??.png -geometry 400x400+3+3 -tile 4x3 -background '#18191c' -quality 88 "$root/docs/gallery.jpg"
