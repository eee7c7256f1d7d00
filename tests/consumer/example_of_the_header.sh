#!/usr/bin/env bash
# Fails when the program in the opening comment of faceprobe/faceprobe.h is not the one that tests/consumer/project builds and runs.
#   example_of_the_header.sh HEADER EXAMPLE
set -euo pipefail

header=$1 example=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# The code of the comment: from the first line that is indented by three, to the end of the comment.
awk 'NR > 1 && !/^\/\// { exit }
     /^\/\/   / { inside = 1 }
     inside { sub(/^\/\/(   )?/, ""); print }' "$header" >"$folder/shown.cpp"
[ "$(wc -l <"$folder/shown.cpp")" -gt 10 ] || { echo "$header shows no program"; exit 1; }
diff -u "$folder/shown.cpp" "$example" || { echo "$header (-) and $example (+) differ; make them the same"; exit 1; }
echo "$(wc -l <"$example") lines are the same"
