#!/usr/bin/env bash
# How heavy and how quick the page of `faceprobe serve` is: what there is to fetch, when something is to be seen, and how long it takes from a
# dropped photo to the map of its light. Prints Markdown.
#
#   bench/page.sh [--runs N] FACEPROBE PHOTOS
#
# FACEPROBE is the built command, whose page is in ../share/faceprobe/web beside it; PHOTOS has the sample photos (.deps/data/samples). Needs
# chromium, or CHROMIUM that names one, and web/node_modules.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
runs=5
arguments=()
while [ $# -gt 0 ]; do
  case $1 in
    --runs) runs=${2:?--runs takes a number}; shift ;;
    -*) echo "unknown option $1; there is --runs." >&2; exit 2 ;;
    *) arguments+=("$1") ;;
  esac
  shift
done
[ ${#arguments[@]} = 2 ] || { echo "page.sh [--runs N] FACEPROBE PHOTOS: the built command, and the folder of the sample photos." >&2; exit 2; }
faceprobe=${arguments[0]} photo=${arguments[1]}/grace_hopper.jpg
page=$(dirname "$faceprobe")/../share/faceprobe/web
CHROMIUM=${CHROMIUM:-$(command -v chromium || true)}
export CHROMIUM
[ -x "$faceprobe" ] || { echo "There is no $faceprobe; scripts/build.sh makes it." >&2; exit 1; }
[ -f "$photo" ] || { echo "There is no $photo; scripts/setup.sh gets it." >&2; exit 1; }
[ -f "$page/index.html" ] || { echo "There is no page in $page; it is built where npm is (scripts/setup.sh)." >&2; exit 1; }
[ -n "$CHROMIUM" ] || { echo "chromium is missing; apt-get install chromium gets it." >&2; exit 1; }
[ -d "$root/web/node_modules/playwright-core" ] || { echo "web/node_modules is missing; npm ci in web gets it." >&2; exit 1; }
unset FACEPROBE_DATA_DIR

node "$root/web/e2e/measure.mjs" "$faceprobe" "$photo" "$page" "$runs"
