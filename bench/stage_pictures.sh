#!/usr/bin/env bash
# Makes every picture of docs/how_it_works.md, docs/stages/*.jpg, from what `faceprobe estimate` and `faceprobe insert` leave of the two sample
# photos. Takes a minute. Needs ImageMagick, and oiiotool for the .exr files (Debian: imagemagick, openimageio-tools).
#
#   bench/stage_pictures.sh [BUILD] [OUT]     BUILD: a build with the command, else build/release; OUT: where pictures go, else docs/stages
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
program=${1:-$root/build/release}/bin/faceprobe
out=${2:-$root/docs/stages}
samples=$root/.deps/data/samples
for tool in convert montage oiiotool; do
  command -v "$tool" >/dev/null || { echo "stage_pictures: $tool is not installed; see the head of this script." >&2; exit 2; }
done
[ -x "$program" ] || { echo "stage_pictures: there is no $program; build it with scripts/build.sh, or name a build." >&2; exit 2; }
mkdir -p "$out"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

paper='#18191c' ink='#e6e8ec'

# page OUT COLUMNS SIZE LABEL PICTURE LABEL PICTURE ...: pictures side by side, each with its name above it. SIZE as ImageMagick has it.
page() {
  local to=$out/$1 columns=$2 size=$3 number=0
  shift 3
  rm -rf page
  mkdir page
  while [ $# -gt 0 ]; do
    convert -size "${size%x*}x24" -background "$paper" -fill "$ink" -font DejaVu-Sans -pointsize 14 -gravity West caption:"$1" \
      \( "$2" -background "$paper" -alpha remove -resize "$size" -gravity Center -extent "$size" \) -append "page/$(printf %02d $number).png"
    number=$((number + 1))
    shift 2
  done
  montage page/*.png -tile "${columns}x" -geometry +6+6 -background "$paper" -strip -quality 88 "$to"
}

# light EXR GAIN PNG: linear light to a picture that a screen shows.
light() { oiiotool "$1" --mulc "$2" --colorconvert linear sRGB -d uint8 -o "$3"; }

# part X Y WIDTH HEIGHT NAME.png FOLDER: out of the overview, whose layout src/pipeline/overview.cpp has.
part() {
  [ "$(identify -format %wx%h "$6/overview.png")" = 1600x1142 ] || { echo "stage_pictures: the overview has a new layout." >&2; exit 1; }
  convert "$6/overview.png" -crop "$3x$4+$1+$2" +repage "$6/$5"
}

estimate() { "$program" -q estimate "$@"; }
# The two photos: a is the US Navy's, b NASA's.
admiral=$samples/grace_hopper.jpg astronaut=$samples/astronaut.png
for person in a b; do
  photo=$admiral
  [ $person = a ] || photo=$astronaut
  estimate "$photo" -o $person
  estimate "$photo" -o ${person}_mesh --geometry mesh
  estimate "$photo" -o ${person}_step --iterations 1
  estimate "$photo" -o ${person}_smooth --prior smooth
done
"$program" -q insert "$astronaut" -o pot --object pot --height 0.14

for person in a b; do
  part 144 218 380 405 face.png $person  # out of the photo's frame: the mesh is thin
  part 24 782 640 320 rings.png $person
  part 688 752 636 230 balls.png $person
  convert $person/regions.png -filter point -resize 300% $person/regions_large.png
  oiiotool $person/highlight.exr $person/diffuse.exr --add -o $person/sum.exr
  light $person/sum.exr 1 $person/sum.png
  light $person/highlight.exr 6 $person/highlight_bright.png
  for map in $person ${person}_step ${person}_smooth; do light "$map/environment.exr" 0.35 "$map/map.png"; done
  light $person/environment_rest.exr 0.35 $person/rest.png
  oiiotool $person/confidence.exr --ch 0,0,0 -d uint8 -o $person/confidence.png  # a picture of one channel, three times
done
oiiotool pot/shadow.exr --subc 1 --mulc 4 --addc 1 --colorconvert linear sRGB -d uint8 -o pot/shadow.png
for layer in composite object shadow; do convert pot/$layer.png -crop 340x256+172+256 +repage pot/${layer}_corner.png; done

page face.jpg 4 300x320 "photo, face mesh" a/face.png "regions" a/regions_large.png "photo, face mesh" b/face.png "regions" b/regions_large.png
page layers.jpg 3 300x320 \
  "photo" a/sum.png "= highlight (here six times as bright)" a/highlight_bright.png "+ diffuse" a/diffuse.png \
  "photo" b/sum.png "= highlight (here six times as bright)" b/highlight_bright.png "+ diffuse" b/diffuse.png
page albedo.jpg 3 300x320 "diffuse" a/diffuse.png "= albedo" a/albedo.png "x shading (here on its own scale)" a/shading.png \
  "diffuse" b/diffuse.png "= albedo" b/albedo.png "x shading (here on its own scale)" b/shading.png
page normals.jpg 4 300x320 "of the mesh" a_mesh/normals.png "of the network" a/normals.png "of the mesh" b_mesh/normals.png \
  "of the network" b/normals.png
page solver.jpg 3 400x200 "one step from the light prior's guess" a_step/map.png "50 steps from it: the result" a/map.png \
  "50 steps from one smooth lamp" a_smooth/map.png "one step from the light prior's guess" b_step/map.png \
  "50 steps from it: the result" b/map.png "50 steps from one smooth lamp" b_smooth/map.png
page confidence.jpg 2 500x250 "map" a/map.png "confidence" a/confidence.png "map" b/map.png "confidence" b/confidence.png
page lights.jpg 2 500x250 "main lights" a/rings.png "the map without the first of them" a/rest.png \
  "main lights" b/rings.png "the map without the first of them" b/rest.png
page spheres.jpg 2 636x230 "in the light of the first portrait" a/balls.png "in the light of the second" b/balls.png
page insert.jpg 3 340x256 "the object with its alpha" pot/object_corner.png "its shadow (here four times as dark)" pot/shadow_corner.png \
  "both over the photo" pot/composite_corner.png
