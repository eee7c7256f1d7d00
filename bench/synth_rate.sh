#!/usr/bin/env bash
# What synthetic faces cost from end to end: real head, hair and clothes, every layer made and written. Prints Markdown.
#
#   bench/synth_rate.sh --data DIR [BUILD_DIR]
#
# "once transport is there" is the time for light, layers, camera and file alone; "transport" is that of one head in one pose on all
# processors, its hair, clothes and the ray tracer's tree included.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
data=
build=$root/build/release
while [ $# -gt 0 ]; do
  case $1 in
    --data) data=${2:?--data takes a folder}; shift ;;
    -*) echo "unknown option $1; there is --data." >&2; exit 2 ;;
    *) build=$1 ;;
  esac
  shift
done
[ -d "$data" ] || { echo "--data must name the data folder that docs/data.md describes." >&2; exit 2; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

threads=$(nproc)
synth() {  # COUNT VIEWS LIGHTS SIZE; the report in $work/report, the memory in kB in $work/memory
  rm -rf "$work/faces"
  /usr/bin/time -f %M -o "$work/memory" "$build/bin/faceprobe" -q synth --heads "$data/faces/ict_facekit" \
    --skins "$data/faces/london_uv_textures" --maps "$data/hdri/train" --seed 7 --count "$1" --views "$2" --lights "$3" --size "$4" \
    -o "$work/faces" --json >"$work/report"
}
# Numbers out of the one line of JSON.
value() { sed -n "s/.*\"$1\":\([0-9.eE+-]*\).*/\1/p" "$work/report"; }

printf '%s threads. Samples a second, all layers written:\n\n' "$threads"
printf '| px | maps a view | once transport is there | with transport, %s heads | memory, MiB |\n|---|---|---|---|---|\n' "$threads"
for size in 128 256; do
  for lights in 64 256; do
    synth $((threads * lights)) 1 "$lights" "$size"
    awk -v n=$((threads * lights)) -v t="$threads" -v shade="$(value shade)" -v compose="$(value compose)" -v write="$(value write)" \
      -v wall="$(value seconds)" -v kb="$(cat "$work/memory")" -v px="$size" -v lights="$lights" \
      'BEGIN {printf "| %d | %d | %.0f | %.0f | %.0f |\n", px, lights, n * t / (shade + compose + write), n / wall, kb / 1024}'
  done
done
printf '\n| px | transport of one head, s |\n|---|---|\n'
for size in 128 256; do
  synth 1 1 1 "$size"
  # One person: all threads work on it, and its time is wall time.
  awk -v px="$size" -v scene="$(value scene)" -v transport="$(value transport)" \
    'BEGIN {printf "| %d | %.1f |\n", px, scene + transport}'
done
