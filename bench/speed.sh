#!/usr/bin/env bash
# How long one 12-megapixel portrait takes, and how much memory: runs the command on an enlarged photo several times and prints
# the median of every stage, of the wall clock and of the peak memory as Markdown; then how long an object takes to be put into it.
#
#   bench/speed.sh [--photo FILE] [--runs N] [BUILD_DIR]
#
# BUILD_DIR (build/release) holds bin/faceprobe; bench_enlarge may also be in build/test.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
photo=$root/.deps/data/samples/grace_hopper.jpg
runs=5
build=$root/build/release
while [ $# -gt 0 ]; do
  case $1 in
    --photo) photo=${2:?--photo takes a file}; shift ;;
    --runs) runs=${2:?--runs takes a number}; shift ;;
    -*) echo "unknown option $1; there are --photo and --runs." >&2; exit 2 ;;
    *) build=$1 ;;
  esac
  shift
done
enlarge=$build/bin/bench_enlarge
[ -x "$enlarge" ] || enlarge=$root/build/test/bin/bench_enlarge
for program in "$build/bin/faceprobe" "$enlarge"; do
  [ -x "$program" ] || { echo "There is no $program; scripts/build.sh and scripts/test.sh build what is needed." >&2; exit 1; }
done
[ -f "$photo" ] || { echo "There is no photo to enlarge; name one with --photo, or run scripts/setup.sh." >&2; exit 1; }

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$enlarge" "$photo" "$work/large.jpg"
for ((i = 1; i <= runs; ++i)); do
  /usr/bin/time -f '%e %M' -o "$work/time.$i" \
    "$build/bin/faceprobe" estimate "$work/large.jpg" -o "$work/out" --timings >/dev/null 2>"$work/log.$i" ||
    { cat "$work/log.$i" >&2; exit 1; }
done

median() { sort -n | awk '{v[NR] = $1} END {print (v[int((NR + 1) / 2)] + v[int(NR / 2) + 1]) / 2}'; }

echo "Median of $runs runs of \`faceprobe estimate\` on a 12-megapixel JPEG portrait, one process each:"
echo
echo "| | |"
echo "| --- | ---: |"
echo "| wall time | $(awk '{print $1}' "$work"/time.* | median | xargs printf '%.2f') s |"
echo "| peak memory | $(awk '{print $2 / 1024}' "$work"/time.* | median | xargs printf '%.0f') MiB |"
echo
echo "| stage | ms |"
echo "| --- | ---: |"
# The table of --timings: from the line after its heading to the total; a stage's name may have blanks.
stages() { awk 'on {ms = $NF; $NF = ""; sub(/ +$/, ""); print $0 "\t" ms} $1 == "stage" {on = 1} $1 == "total" {on = 0}' "$@"; }
stages "$work/log.1" | cut -f1 | awk '!seen[$0]++' | while IFS= read -r stage; do
  for ((i = 1; i <= runs; ++i)); do
    stages "$work/log.$i" | awk -F'\t' -v stage="$stage" '$1 == stage {sum += $2} END {print sum + 0}'
  done | median | xargs printf "| $stage | %.0f |\n"
done

# seconds FILE ARGUMENT...: the median wall time of putting the pot into a photo.
seconds() {
  local input=$1 i
  shift
  for ((i = 1; i <= runs; ++i)); do
    /usr/bin/time -f '%e' -o "$work/insert.$i" "$build/bin/faceprobe" -q insert "$input" -o "$work/out.png" "$@"
  done
  cat "$work"/insert.* | median | xargs printf '%.1f'
}
echo
echo "And of \`faceprobe insert\`, the pot:"
echo
echo "| | s |"
echo "| --- | ---: |"
echo "| \`--preview\` of the same photo | $(seconds "$work/large.jpg" --preview) |"
echo "| the photo before it was enlarged | $(seconds "$photo") |"
