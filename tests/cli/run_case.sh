#!/usr/bin/env bash
# Runs one case of the command's tests in a fresh folder; the cases are the functions case_* of the files beside this one.
#   run_case.sh CASE FACEPROBE CMAKE DATA_FOLDER PICTURE_TOOL
set -euo pipefail

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
name=$1 faceprobe=$2 cmake=$3 data=$4 picture_tool=$5
photo=$data/samples/grace_hopper.jpg  # public domain, one face
# What the maps look like is tested elsewhere; here small ones do.
quick=(--layer-px 64 --size 16 --iterations 2)
unset FACEPROBE_DATA_DIR

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

source "$here/expect.sh"
source "$here/cases_refusals.sh"
source "$here/cases_results.sh"
source "$here/cases_output.sh"
source "$here/cases_synth.sh"
source "$here/cases_eval.sh"
source "$here/cases_paper.sh"
source "$here/cases_insert.sh"
source "$here/cases_manual.sh"
source "$here/cases_serve.sh"

declare -F "case_$name" >/dev/null || { echo "there is no case $name"; exit 2; }
"case_$name"
