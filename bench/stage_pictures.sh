#!/usr/bin/env bash
# Makes every picture of docs/how_it_works.md, docs/stages/*.jpg, from what `faceprobe estimate` and `faceprobe insert` leave of the two sample
# photos. Takes a minute. Needs ImageMagick, oiiotool for the .exr files, and matplotlib for the first stage and the sixth (Debian: imagemagick,
# openimageio-tools, python3-matplotlib).
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
python=/usr/bin/python3  # Debian's matplotlib belongs to this one
[ -x "$python" ] || python=python3
"$python" -c 'import matplotlib, PIL' 2>/dev/null || { echo "stage_pictures: $python has no matplotlib; see the head of this script." >&2; exit 2; }
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

# The first stage: codes.png, linear.png, clipped.png, curve.png of NASA's photo, whose white helmet is clipped.
cat >file.py <<'PY'
import sys
import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from PIL import Image

paper, ink, dim = "#18191c", "#e6e8ec", "#969aa2"
codes = np.asarray(Image.open(sys.argv[1]).convert("RGB"))
value = codes / 255
light = np.where(value <= 0.04045, value / 12.92, ((value + 0.055) / 1.055) ** 2.4)
Image.fromarray(codes).save("codes.png")
# As a screen would show the numbers of light, had it no curve of its own.
Image.fromarray(np.uint8(255 * light + 0.5)).save("linear.png")
clipped = codes >= 254
faded = np.repeat(40 + codes.mean(-1, keepdims=True) // 4, 3, -1)
Image.fromarray(np.uint8(np.where(clipped.any(-1, keepdims=True), 255 * clipped, faded))).save("clipped.png")

figure = plt.figure(figsize=(3, 3), dpi=100, facecolor=paper)
axes = figure.add_axes((0.17, 0.16, 0.78, 0.79), facecolor=paper)
count, edges = np.histogram(codes, bins=64, range=(0, 256))
axes.bar(edges[:-1], count / count.max() * 0.6, width=4, align="edge", color="#3a3d44")
x = np.arange(256) / 255
axes.plot(255 * x, np.where(x <= 0.04045, x / 12.92, ((x + 0.055) / 1.055) ** 2.4), color="#5adcff", linewidth=2)
axes.axvspan(254, 258, color="#ff5c50")
half = 255 * (1.055 * 0.5 ** (1 / 2.4) - 0.055)
axes.plot([0, half, half], [0.5, 0.5, 0], color=dim, linewidth=1, linestyle=":")
axes.set(xlim=(0, 258), ylim=(0, 1.02), xlabel="code value", ylabel="light", xticks=[0, 64, 128, round(half), 255], yticks=[0, 0.5, 1])
axes.xaxis.label.set_color(ink)
axes.yaxis.label.set_color(ink)
axes.tick_params(colors=dim, labelsize=8)
for spine in axes.spines.values():
    spine.set_color(dim)
figure.savefig("curve.png", facecolor=paper)
print(f"stage 1: clipped in one channel at least: {100 * clipped.any(-1).mean():.1f} % of the pixels")
PY
"$python" file.py "$astronaut"

# The sixth: the rows of the transport of three patches, by the formulas of section 8 and the table of skin, at the network's normals. No horizon.
for channel in R G B; do oiiotool a/normals.exr --ch $channel -d float --compression none -o normal_$channel.tif; done
cat >rows.py <<'PY'
import json
import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from PIL import Image

normals = np.stack([np.asarray(Image.open(f"normal_{channel}.tif")) for channel in "RGB"], -1)
height, width, _ = normals.shape
# Where in the crop, roughness and specular albedo of the region (src/core/skin_reflectance.cpp), colour.
patches = [((0.45, 0.23), (0.28, 0.20), (90, 225, 120)), ((0.66, 0.55), (0.32, 0.17), (110, 170, 255)),
           ((0.435, 0.53), (0.25, 0.24), (255, 140, 70))]
face = json.load(open("a/report.json"))["faces"][0]
view = -np.array(face["position_m"])
view /= np.linalg.norm(view)

map_height, map_width = 200, 400
longitude = np.pi - (np.arange(map_width) + 0.5) / map_width * 2 * np.pi
latitude = np.pi / 2 - (np.arange(map_height) + 0.5) / map_height * np.pi
lon, lat = np.meshgrid(longitude, latitude)
towards = np.stack([np.sin(lon) * np.cos(lat), np.sin(lat), np.cos(lon) * np.cos(lat)], -1)


def highlight_row(normal, roughness, albedo):
    n_l, n_v = towards @ normal, view @ normal
    half = towards + view
    half /= np.maximum(np.linalg.norm(half, axis=-1, keepdims=True), 1e-6)
    n_h, v_h = np.maximum(half @ normal, 1e-4), np.maximum(half @ view, 1e-4)
    fresnel = 0.028 + 0.972 * (1 - v_h) ** 5
    spread = np.exp(-(1 - n_h ** 2) / (n_h * roughness) ** 2) / (roughness ** 2 * n_h ** 4)
    hidden = np.minimum(1, np.minimum(2 * n_h * n_v / v_h, 2 * n_h * n_l / v_h))
    return np.where(n_l > 0, albedo * fresnel * spread * hidden / (np.pi * n_v), 0)


photo = Image.open("a/sum.png").convert("RGB")
dots = np.asarray(photo).copy()
rows = []
for (x, y), (roughness, albedo), colour in patches:
    column, line = int(x * width), int(y * height)
    around = normals[line - 4:line + 5, column - 4:column + 5].reshape(-1, 3).mean(0)
    normal = around / np.linalg.norm(around)
    rows.append((highlight_row(normal, roughness, albedo), np.maximum(towards @ normal, 0) / np.pi, colour))
    px, py, side = int(x * photo.width), int(y * photo.height), max(5, photo.width // 45)
    dots[py - side - 2:py + side + 3, px - side - 2:px + side + 3] = 20
    dots[py - side:py + side + 1, px - side:px + side + 1] = colour
Image.fromarray(dots).save("patches.png")
for name, which in (("rows_highlight.png", 0), ("rows_shading.png", 1)):
    figure = plt.figure(figsize=(4, 2), dpi=100, facecolor="#18191c")
    axes = figure.add_axes((0, 0, 1, 1), facecolor="#101114")
    sum_of_all = np.zeros((map_height, map_width, 3))
    for row in rows:
        sum_of_all += (row[which] / row[which].max())[..., None] ** (1 / 1.6) * np.array(row[2]) * (0.8 if which == 0 else 0.4)
    axes.imshow(np.uint8(np.clip(sum_of_all, 0, 255)), extent=(0, map_width, map_height, 0))
    for row in rows:
        axes.contour(np.arange(map_width) + 0.5, np.arange(map_height) + 0.5, row[which] / row[which].max(), levels=[0.5],
                     colors=[np.array(row[2]) / 255], linewidths=1.5)
    for at in (1, 2, 3):
        axes.axvline(at * map_width / 4, color="#ffffff30", linewidth=0.7)
        axes.axhline(at * map_height / 4, color="#ffffff30", linewidth=0.7)
    axes.axis("off")
    figure.savefig(name, facecolor="#18191c")
PY
"$python" rows.py

page file.jpg 4 300x300 "code values, as on a screen" codes.png "light: what is computed with" linear.png \
  "clipped: red, green, blue, or all" clipped.png "from code value to light" curve.png
page rows.jpg 3 400x240 "three patches" patches.png "their highlight rows: where light is mirrored from" rows_highlight.png \
  "their shading rows: which side they face" rows_shading.png
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
