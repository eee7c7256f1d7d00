#!/usr/bin/env bash
# Builds the command and estimates the light of a sample photo.
#
#   scripts/demo.sh                 writes into out/demo
#   scripts/demo.sh FOLDER          writes into FOLDER
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
folder=${1:-$root/out/demo}
photo=$root/.deps/data/samples/grace_hopper.jpg

program=$("$root/scripts/build.sh" | tail -n 1)
if [ ! -f "$photo" ]; then
  echo "demo: the sample photo is not there (see the setup messages above). With a photo of your own:" >&2
  echo "  $program estimate PHOTO -o $folder" >&2
  exit 1
fi
mkdir -p "$folder"
"$program" estimate "$photo" -o "$folder"
echo "Results in $folder:"
(cd "$folder" && find . -type f | sed 's|^\./|  |' | sort)
