#!/usr/bin/env bash
# Measures what `faceprobe eval paper` does not and writes docs/measurements.md. Each section stands between HTML comments, so that one can be
# measured again without touching the others.
#
#   bench/measurements.sh --data DIR [BUILD_DIR]
#   bench/measurements.sh --data DIR --only robustness [BUILD_DIR]   one of: best_case separation highlight_makehuman highlight_photos
#                                                                    highlight_people highlight_net geometry shading one_lamp
#                                                                    direction region_photos surface_photos rerender robustness
#                                                                    speed solve page readme insert insert_cycles synth_cycles
#                                                                    synth_speed synth_rate
#   bench/measurements.sh --data DIR --faces FACES ...      for highlight_people, geometry and shading: the dev faces of docs/training.md;
#                                                           they are left as they are without them
#   bench/measurements.sh --data DIR --training FACES ...   for highlight_people: the training faces, likewise
#   bench/measurements.sh --data DIR --light FACES ...      for insert: the faces for it, likewise
#
# BUILD_DIR (build/test) is built with FACEPROBE_BUILD_BENCH=ON, and FACEPROBE_TRAIN=ON for those of highlight layers; speed, page
# and synth_rate measure the command of build/release, which scripts/build.sh makes. Ends with 1 when a benchmark misses its bar; its section is
# written all the same.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
sections=(best_case separation highlight_makehuman highlight_photos highlight_people highlight_net geometry shading
          one_lamp direction region_photos surface_photos rerender robustness speed solve page readme insert insert_cycles synth_cycles synth_speed synth_rate)
data=
faces=
training=
light=
only=
build=$root/build/test
while [ $# -gt 0 ]; do
  case $1 in
    --data) data=${2:?--data takes a folder}; shift ;;
    --faces) faces=${2:?--faces takes a folder}; shift ;;
    --training) training=${2:?--training takes a folder}; shift ;;
    --light) light=${2:?--light takes a folder}; shift ;;
    --only) only=${2:?--only takes a section}; shift ;;
    -*) echo "unknown option $1; there are --data, --faces, --training, --light and --only." >&2; exit 2 ;;
    *) build=$1 ;;
  esac
  shift
done
[ -d "$data" ] || { echo "--data must name the data folder that docs/data.md describes." >&2; exit 2; }
if [ -n "$only" ] && [[ " ${sections[*]} " != *" $only "* ]]; then
  echo "--only takes one of: ${sections[*]}; found '$only'." >&2
  exit 2
fi
data=$(cd "$data" && pwd)
build=$(cd "$build" && pwd)
page=$root/docs/measurements.md

title_of() {
  case $1 in
    best_case) echo "Light, with everything else known" ;;
    separation) echo "Highlight separation on objects" ;;
    highlight_makehuman) echo "Layers of another model's heads" ;;
    highlight_photos) echo "Highlight layers of photos" ;;
    highlight_people) echo "Finetuning on photos of people" ;;
    highlight_net) echo "What the network costs" ;;
    geometry) echo "Normals and regions of synthetic faces" ;;
    shading) echo "Albedo and shading of synthetic faces" ;;
    one_lamp) echo "What better normals are worth: synthetic faces under one lamp" ;;
    direction) echo "What better normals are worth: photos under known lights" ;;
    region_photos) echo "Regions of photos" ;;
    surface_photos) echo "Albedo of photos" ;;
    rerender) echo "Photos made again from their layers" ;;
    robustness) echo "Many kinds of photo" ;;
    speed) echo "Time and memory" ;;
    solve) echo "Solving for the light: against the same products elsewhere, by patches and by cells" ;;
    page) echo "The page" ;;
    readme) echo "From a clone to a lit object in Blender" ;;
    insert) echo "Inserted objects against the same in the true light" ;;
    insert_cycles) echo "Drawn objects against Blender's Cycles" ;;
    synth_cycles) echo "Synthetic faces against Blender's Cycles" ;;
    synth_speed) echo "Light on synthetic faces: cost by number of maps" ;;
    synth_rate) echo "Synthetic faces: samples a second" ;;
  esac
}

# As a reader would type it.
command_of() {
  case $1 in
    geometry)
      echo "BUILD/bin/faceprobe eval geometry --data FACES --weights net=models/face.safetensors --head DIR/faces/ict_facekit --samples 200" ;;
    shading) echo "BUILD/bin/faceprobe eval shading --data FACES --weights net=models/face.safetensors --samples 200" ;;
    direction)
      echo "BUILD/bin/faceprobe eval direction --data DIR --every 3 --normals mesh,3dmm,net --head DIR/faces/ict_facekit" ;;
    highlight_makehuman) echo "bench/makehuman.sh --data DIR" ;;
    highlight_people) echo "bench/people.sh --data DIR --faces FACES --training TRAINING" ;;
    speed) echo "bench/speed.sh" ;;
    solve) echo "BUILD/bin/bench_solve" ;;
    page) echo "bench/page.sh build/release/bin/faceprobe .deps/data/samples" ;;
    readme) echo "bench/readme.sh" ;;
    insert) echo "BUILD/bin/faceprobe eval insert --data LIGHT --samples 50" ;;
    insert_cycles) echo "BUILD/bin/bench_insert_cycles --object DIR/objects/stanford-bunny.obj --maps DIR/hdri/dev --map-count 1 --size 128 --samples 1024 --our-samples 2048" ;;
    synth_speed) echo "BUILD/bin/bench_synth_speed" ;;
    synth_rate) echo "bench/synth_rate.sh --data DIR" ;;
    *) echo "BUILD/bin/bench_$1 --data DIR" ;;
  esac
}

run_section() {
  case $1 in
    geometry)
      "$build/bin/faceprobe" eval geometry --data "$faces" --weights net="$root/models/face.safetensors" --head "$data/faces/ict_facekit" \
        --samples 200 ;;
    shading) "$build/bin/faceprobe" eval shading --data "$faces" --weights net="$root/models/face.safetensors" --samples 200 ;;
    direction)  # its headings go below the section's
      "$build/bin/faceprobe" eval direction --data "$data" --every 3 --normals mesh,3dmm,net --head "$data/faces/ict_facekit" |
        sed 's/^##/###/' ;;
    highlight_makehuman) "$root/bench/makehuman.sh" --data "$data" "$build" ;;
    highlight_people) "$root/bench/people.sh" --data "$data" --faces "$faces" --training "$training" "$build" ;;
    speed) "$root/bench/speed.sh" ;;
    solve) "$build/bin/bench_solve" ;;
    page) "$root/bench/page.sh" "$root/build/release/bin/faceprobe" "$root/.deps/data/samples" ;;
    readme) "$root/bench/readme.sh" ;;
    insert) "$build/bin/faceprobe" eval insert --data "$light" --samples 50 ;;
    insert_cycles) "$build/bin/bench_insert_cycles" --object "$data/objects/stanford-bunny.obj" --maps "$data/hdri/dev" --map-count 1 --size 128 --samples 1024 \
        --our-samples 2048 ;;
    synth_speed) "$build/bin/bench_synth_speed" ;;
    synth_rate) "$root/bench/synth_rate.sh" --data "$data" ;;
    *) "$build/bin/bench_$1" --data "$data" ;;
  esac
}

# What speed depends on, without naming anybody's machine.
machine() {
  local level= v
  for v in "2 sse4_2" "3 avx2" "4 avx512vl"; do
    if grep -qw "${v#* }" /proc/cpuinfo; then level=", x86-64-v${v% *}"; fi
  done
  echo "$(nproc) cores$level"
}

# The section as the file has it now, without its markers; empty when there is none.
kept_section() {
  [ -f "$page" ] || return 0
  awk -v begin="<!-- begin $1 -->" -v end="<!-- end $1 -->" '$0 == end {on = 0} on {print} $0 == begin {on = 1}' "$page"
}

status=0
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
for section in "${sections[@]}"; do
  kept_section "$section" >"$work/$section"
  if [ -n "$only" ] && [ "$only" != "$section" ]; then continue; fi
  if [[ $section =~ ^(geometry|shading)$ ]] && [ -z "$faces" ]; then
    echo "measurements: $section is left as it is; --faces names the synthetic faces to measure on." >&2
    continue
  fi
  if [ "$section" = highlight_people ] && { [ -z "$faces" ] || [ -z "$training" ]; }; then
    echo "measurements: highlight_people is left as it is; --faces and --training name the synthetic faces of docs/training.md." >&2
    continue
  fi
  if [ "$section" = insert ] && [ -z "$light" ]; then
    echo "measurements: insert is left as it is; --light names the synthetic faces of docs/training.md." >&2
    continue
  fi
  echo "measurements: $section" >&2
  code=0
  run_section "$section" >"$work/output" || code=$?
  # Only robustness has a bar, and says so with 1; any other failure leaves half a table.
  if { [ "$code" -ne 0 ] && [ "$section:$code" != robustness:1 ]; } || [ ! -s "$work/output" ]; then
    echo "measurements: $section ended with $code; its section stays as it was." >&2
    status=1
    continue
  fi
  [ "$code" -eq 0 ] || { echo "measurements: $section missed its bar." >&2; status=1; }
  {
    printf '## %s\n\n`%s`, on %s.\n\n' "$(title_of "$section")" "$(command_of "$section")" "$(machine)"
    # Nobody's folders are published.
    sed -e "s|$data|DIR|g" -e "s|$build|BUILD|g" ${faces:+-e "s|$faces|FACES|g"} ${training:+-e "s|$training|TRAINING|g"} ${light:+-e "s|$light|LIGHT|g"} \
      -e "s|$root/||g" "$work/output"
  } | cat -s >"$work/$section"
done

target=$(mktemp "$page.XXXXXX")
{
  cat <<'END'
# Measurements

What [results.md](results.md), the paper's evaluation, does not hold: other people's renderers and heads, photos without a known answer, time and memory.
Written by `bench/measurements.sh --data DIR [BUILD]`; edit the benchmarks, not this page. DIR is the data folder that
[data.md](data.md) describes, BUILD a build with benchmarks and training (`scripts/test.sh` makes one), FACES the dev faces of
[training.md](training.md), LIGHT those for light. Every section names the command that printed it.
END
  for section in "${sections[@]}"; do
    [ -s "$work/$section" ] || continue
    printf '\n<!-- begin %s -->\n' "$section"
    cat "$work/$section"
    printf '<!-- end %s -->\n' "$section"
  done
} >"$target"
chmod 644 "$target"
mv "$target" "$page"
exit "$status"
