#!/usr/bin/env bash
# How long it takes from a clone to a lit object in Blender, by the commands of README.md as they are written there: clones this repository as it
# was last committed, and takes the first block that has scripts/demo.sh and the one that runs Blender. What the machine has already is not
# installed again; on a new Debian 12 the packages come on top.
#
#   bench/readme.sh [FOLDER]        FOLDER: for the clone; default: one that is removed afterwards
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
folder=${1:-}
if [ -z "$folder" ]; then
  folder=$(mktemp -d)
  trap 'rm -rf "$folder"' EXIT
fi
# Lines of README's code blocks that begin so, without comments.
command_of() { awk '/^```/ {inside = !inside; next} inside' "$root/README.md" | sed 's/ *#.*//' | grep -m 1 -- "^$1"; }
demo=$(command_of './scripts/demo.sh')
draw=$(command_of 'blender ')

step() {
  local start=$SECONDS
  shift
  "$@" >&2 || { echo "readme: this failed: $*" >&2; exit 1; }
  took=$((SECONDS - start))
}
step clone git clone --quiet "$root" "$folder/faceprobe"
cloned=$took
cd "$folder/faceprobe"
step demo bash -c "$demo"
built=$took
step draw bash -c "$draw"
drawn=$took
[ -s out/demo/monkey.png ] || { echo "readme: there is no out/demo/monkey.png." >&2; exit 1; }
printf '| step | command | s |\n|---|---|---:|\n'
printf '| clone | `git clone` | %d |\n' "$cloned"
printf '| set up, build, estimate | `%s` | %d |\n' "$demo" "$built"
printf '| a lit object | `%s` | %d |\n' "$draw" "$drawn"
printf '| together | | %d |\n' $((cloned + built + drawn))
