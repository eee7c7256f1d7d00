#!/usr/bin/env bash
# Unpacks the tarball of scripts/package.sh into a folder of any name and runs what is in it, from there alone.
#
#   tests/packages/run_tarball.sh FACEPROBE.tar.gz [PHOTO]       PHOTO: else the sample of scripts/setup.sh
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
die() { echo "FAILED: $*" >&2; exit 1; }
[ $# = 1 ] || [ $# = 2 ] || { sed -n '2,/^set /{/^#/s/^# \{0,1\}//p}' "${BASH_SOURCE[0]}" >&2; exit 2; }
tarball=$(realpath "$1")
photo=$(realpath "${2:-$root/.deps/data/samples/grace_hopper.jpg}")

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mkdir "$folder/a place of its own"
tar -xzf "$tarball" -C "$folder/a place of its own" --strip-components=1
cd "$folder"
faceprobe="$folder/a place of its own/bin/faceprobe"
[ -x "$faceprobe" ] || die "the tarball has no bin/faceprobe at its top"
run() { env -i PATH=/usr/bin:/bin LC_ALL=C.UTF-8 HOME="$folder" "$faceprobe" "$@"; }

run doctor | tee doctor.txt
grep -q "page: $folder/a place of its own/" doctor.txt || die "the page that it finds is not its own"
run estimate "$photo" -o light
for name in environment.exr report.json overview.png; do [ -s "light/$name" ] || die "estimate wrote no $name"; done
echo "unpacked and used"
