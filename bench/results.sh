#!/usr/bin/env bash
# Brings docs/results.json, docs/results.md and the figures of README.md to what a whole run of `faceprobe eval paper` measured. The two pages are
# made from docs/results.json alone, and a test holds them to it.
#
#   bench/results.sh REPORT_DIR [BUILD_DIR]     takes REPORT_DIR/report.json; BUILD_DIR (build/test) has the command with FACEPROBE_TRAIN=ON
#   bench/results.sh --again [BUILD_DIR]        writes the pages again from docs/results.json
#   bench/results.sh --check [BUILD_DIR]        writes nothing; ends with 1 where a page is another than that
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
[ $# -ge 1 ] || { echo "usage: bench/results.sh REPORT_DIR|--again|--check [BUILD_DIR]" >&2; exit 2; }
what=$1
faceprobe=${2:-$root/build/test}/bin/faceprobe
[ -x "$faceprobe" ] || { echo "there is no $faceprobe; scripts/test.sh builds it." >&2; exit 2; }
json=$root/docs/results.json
case $what in
  --again | --check) ;;
  *)
    [ -f "$what/report.json" ] || { echo "there is no report.json in $what; \`faceprobe eval paper\` writes one." >&2; exit 2; }
    cp "$what/report.json" "$json"
    ;;
esac

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
{
  printf '%s\n\n' "<!-- Written by bench/results.sh from results.json, which \`faceprobe eval paper\` wrote; edit neither. -->"
  "$faceprobe" eval results "$json"
} >"$work/results.md"
"$faceprobe" eval results --headlines "$json" >"$work/headlines"
grep -q '^<!-- begin figures -->$' "$root/README.md" || { echo "README.md has no place for the figures." >&2; exit 1; }
awk -v figures="$work/headlines" '
  $0 == "<!-- end figures -->" {skipped = 0}
  !skipped {print}
  $0 == "<!-- begin figures -->" {while ((getline line <figures) > 0) print line; skipped = 1}' "$root/README.md" >"$work/README.md"

if [ "$what" = --check ]; then
  status=0
  for page in docs/results.md README.md; do
    diff -u "$root/$page" "$work/$(basename "$page")" || status=1
  done
  [ $status = 0 ] || echo "These pages do not say what docs/results.json holds; bench/results.sh --again writes them." >&2
  exit $status
fi
cp "$work/results.md" "$root/docs/results.md"
cp "$work/README.md" "$root/README.md"
