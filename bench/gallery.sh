#!/usr/bin/env bash
# Puts objects into twelve freely licensed portraits (docs/data.md) and writes docs/gallery.jpg, one page to look at. With --failures it writes
# the pictures of docs/limits.md instead: surface_photos.png, highlight_failures.png, light_failures.jpg. Needs ImageMagick, the failures oiiotool
# too.
#
#   bench/gallery.sh [--failures] --data DIR BUILD [OUT]     DIR holds real/portraits and objects; OUT: where the parts go, else a temporary folder
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
failures=
[ "${1:-}" != --failures ] || { failures=1; shift; }
[ $# -ge 3 ] && [ "$1" = --data ] || { sed -n '6p' "$0" | cut -c3- >&2; exit 2; }
data=$2
program=$3/bin/faceprobe
command -v montage >/dev/null || { echo "gallery: ImageMagick's montage is not installed." >&2; exit 2; }
if [ $# -ge 4 ]; then out=$4; mkdir -p "$out"; else out=$(mktemp -d); trap 'rm -rf "$out"' EXIT; fi
portraits=$data/real/portraits
samples=$root/.deps/data/samples
bunny=$data/objects/stanford-bunny.obj

if [ -n "$failures" ]; then
  command -v oiiotool >/dev/null || { echo "gallery: oiiotool is not installed." >&2; exit 2; }
  paper='#18191c' ink='#e6e8ec'
  rm -rf "$out/cells"
  mkdir "$out/cells"
  shown() {  # EXR GAIN PNG
    oiiotool "$1" --mulc "$2" --colorconvert linear sRGB -d uint8 -o "$3"
  }
  read_face() {  # NAME PHOTO [GAIN]: what the command leaves, as pictures; GAIN: of the map
    local to=$out/$1
    "$program" -q estimate "$2" -o "$to" --layer-px 256
    oiiotool "$to/highlight.exr" "$to/diffuse.exr" --add -o "$to/sum.exr"
    shown "$to/sum.exr" 1 "$to/photo.png"
    shown "$to/highlight.exr" 4 "$to/highlight_bright.png"
    shown "$to/environment.exr" "${3:-0.35}" "$to/map.png"
    for layer in albedo shading; do  # off the face there is none
      convert "$to/$layer.png" \( "$to/regions.png" -fill white +opaque black \) -compose multiply -composite "$to/face_$layer.png"
    done
  }
  cell() {  # SIZE LABEL PICTURE: the next one of the page
    local number
    number=$(find "$out/cells" -name '*.png' | wc -l)
    convert \( "$3" -background "$paper" -alpha remove -resize "$1" -gravity Center -extent "$1" \) -size "${1%x*}x18" -fill "$ink" \
      -font DejaVu-Sans -pointsize 11 -gravity Center caption:"$2" -append "$out/cells/$(printf %02d "$number").png"
  }
  page() {  # COLUMNS PICTURE: a .png in 160 colours, which is small
    montage "$out"/cells/*.png -tile "${1}x" -geometry +3+3 -background "$paper" -depth 8 "$out/page.png"
    case $2 in
      *.png) convert "$out/page.png" -strip -dither FloydSteinberg -colors 160 "PNG8:$2" ;;
      *) convert "$out/page.png" -strip -quality 88 "$2" ;;
    esac
    rm "$out"/cells/*.png
  }

  # A lamp at the right of the photo, in OpenEXR's columns, and little else.
  oiiotool --pattern constant:color=.05,.05,.05 256x128 3 --fill:color=6,6,6 32x32+56+36 -o "$out/lamp.exr"
  for who in 001 033 063 099; do
    photo=$portraits/london/neutral_front/${who}_03.jpg
    read_face $who "$photo"
    "$program" -q relight "$photo" --map "$out/lamp.exr" -o "$out/$who/relit.png"
    convert "$out/$who/relit.png" -crop 360x420+140+120 +repage "$out/$who/relit_face.png"
    cell 110x132 photo "$out/$who/photo.png"
    cell 110x132 normals "$out/$who/normals.png"
    cell 110x132 albedo "$out/$who/face_albedo.png"
    cell 110x132 shading "$out/$who/face_shading.png"
    cell 110x132 'lamp at the right' "$out/$who/relit_face.png"
  done
  page 10 "$root/docs/surface_photos.png"

  for who in 003 024 092 143; do
    read_face $who "$portraits/london/neutral_front/${who}_03.jpg"
    cell 120x144 photo "$out/$who/photo.png"
    cell 120x144 'highlight, times four' "$out/$who/highlight_bright.png"
    cell 120x144 regions "$out/$who/regions.png"
  done
  page 6 "$root/docs/highlight_failures.png"

  # Rings where the studio's three lamps are, by catchlights in the eyes (docs/limits.md): azimuth and elevation on a map of 256 columns.
  rings() {  # NAME
    local draw=
    for at in -49,26 -8,26 43,28; do
      draw+=" ellipse $((128 - ${at%,*} * 256 / 360)),$((64 - ${at#*,} * 128 / 180)) 6,6 0,360"
    done
    convert "$out/$1/map.png" -fill none -stroke '#ff5c50' -strokewidth 1.5 -draw "$draw" "$out/$1/ringed.png"
  }
  for who in 083 135 173; do read_face $who "$portraits/london/neutral_front/${who}_03.jpg"; done
  for who in 1 4; do read_face lisa$who "$portraits/cc0_selfies/lisa_lisa$who.jpg" 1.5; done
  for who in 083 099; do
    cell 240x150 photo "$out/$who/photo.png"
    cell 240x150 'highlight, times four' "$out/$who/highlight_bright.png"
  done
  for who in 135 173; do
    rings $who
    cell 240x150 photo "$out/$who/photo.png"
    cell 240x150 'its light; rings: the lamps' "$out/$who/ringed.png"
  done
  for who in lisa1 lisa4; do
    cell 240x150 photo "$out/$who/photo.png"
    cell 240x150 'its light' "$out/$who/map.png"
  done
  page 4 "$root/docs/light_failures.jpg"
  exit
fi

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
