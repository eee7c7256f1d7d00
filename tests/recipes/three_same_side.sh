#!/usr/bin/env bash
# Does three.js light a sphere from the side that report.json names? By the lines that docs/recipes.md shows, in Debian's chromium, for a photo
# with its lamp at camera right and for the same photo mirrored. Skipped (77) without the browser, what npm fetches, or the photo.
#   three_same_side.sh FACEPROBE DATA_FOLDER
set -euo pipefail

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
web=$here/../../web faceprobe=$1 photo=$2/samples/grace_hopper.jpg
skip() { echo "$*"; exit 77; }
CHROMIUM=${CHROMIUM:-$(command -v chromium || true)}
export CHROMIUM
[ -n "$CHROMIUM" ] || skip "there is no chromium"
command -v node >/dev/null || skip "there is no node"
for package in three playwright-core; do
  [ -d "$web/node_modules/$package" ] || skip "there is no web/node_modules/$package; npm ci in web gets it"
done
[ -f "$photo" ] || skip "there is no $photo"

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
node "$here/three_same_side.mjs" "$faceprobe" "$photo" "$work"
