#!/usr/bin/env bash
# Runs the commands of docs/tutorial.md as they are written there: every block that opens with ```sh, in order, in one temporary folder that
# holds the two sample photos, with the command on the PATH. A block must end with 0 and may take 10 seconds of processor time, which is what an
# idle machine needs at most and a busy one hardly changes. One that says
# ```sh needs=PROGRAM, or needs=python3:MODULE, is skipped where that is missing. Skipped as a whole (77) without the photos.
#
#   tutorial_test.sh FACEPROBE SAMPLES [PYTHONPATH]     SAMPLES: .deps/data/samples; PYTHONPATH: a build's python folder
#   PYTHON=/usr/bin/python3 names the Python to use, else python3.
set -euo pipefail

[ $# -ge 2 ] || { sed -n '7,8p' "$0" | cut -c3- >&2; exit 2; }
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
tutorial=$here/../../docs/tutorial.md
command=$(realpath "$1") samples=$(realpath -m "$2")
limit_s=${TUTORIAL_LIMIT_S:-10}
hung_s=120
least_blocks=10  # fewer: blocks are no longer found
[ "$(basename "$command")" = faceprobe ] || { echo "the command must be called faceprobe, as in the tutorial: $command"; exit 2; }
for photo in grace_hopper.jpg astronaut.png; do
  [ -f "$samples/$photo" ] || { echo "there is no $samples/$photo"; exit 77; }
done

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir "$work/bin" "$work/blocks" "$work/first-light"
cp "$samples/grace_hopper.jpg" "$samples/astronaut.png" "$work/first-light"
if python=$(command -v "${PYTHON:-python3}"); then
  printf '#!/bin/sh\nexec "%s" "$@"\n' "$python" >"$work/bin/python3"
  chmod +x "$work/bin/python3"
fi
PATH=$work/bin:$(dirname "$command"):$PATH
export PATH
[ -z "${3:-}" ] || PYTHONPATH=$(realpath -m "$3")${PYTHONPATH:+:$PYTHONPATH}
export PYTHONPATH=${PYTHONPATH:-}

# One file a block; the first line says where it stands and what it needs.
awk -v folder="$work/blocks" '
  /^[ \t]+```sh/ { print "line " NR ": an indented block is not run" > "/dev/stderr"; bad = 1 }
  !inside && /^```sh( |$)/ { inside = 1; file = sprintf("%s/%03d", folder, ++count); print "# " NR " " substr($0, 7) > file; next }
  inside && /^```$/ { inside = 0; close(file); next }
  inside { print > file }
  END { if (inside) { print "the last block has no end" > "/dev/stderr"; bad = 1 } exit bad }' "$tutorial"

# The missing part of what a block needs, or nothing.
missing() {
  local need
  for need in "$@"; do
    need=${need#needs=}
    command -v "${need%%:*}" >/dev/null || { echo "${need%%:*}"; return; }
    # Some systems have another program of this name.
    [ "$need" != convert ] || [[ $(convert -version 2>/dev/null) == *ImageMagick* ]] || { echo "ImageMagick's convert"; return; }
    if [ "$need" != "${need%%:*}" ]; then
      "${need%%:*}" -c "import ${need#*:}" 2>/dev/null || { echo "the module ${need#*:} of ${need%%:*}"; return; }
    fi
  done
}

cd "$work/first-light"
TIMEFORMAT="%3R %3U %3S" LC_NUMERIC=C
failed=0 ran=0 found=0
for block in "$work"/blocks/*; do
  found=$((found + 1))
  read -r _ line needs <"$block"
  # shellcheck disable=SC2086  # several needs are several words
  lacking=$(missing $needs)
  title="line $line: $(sed -n 2p "$block")"
  if [ -n "$lacking" ]; then
    echo "--      $title: skipped, without $lacking"
    continue
  fi
  ran=$((ran + 1)) code=0
  { time timeout --kill-after=5 $hung_s bash -euo pipefail "$block" >"$work/log" 2>&1 </dev/null || code=$?; } 2>"$work/times"
  read -r wall user system <"$work/times"
  ms=$((10#${user/./} + 10#${system/./}))
  seconds="$((ms / 1000)).$((ms % 1000 / 100)) s of processor time ($wall s on the clock)"
  # `... || echo` would hide that there is no such program.
  if [ $code = 0 ] && grep -q ': command not found$' "$work/log"; then code=127; fi
  if [ $code != 0 ]; then
    echo "FAILED  $title: exit code $code"
    sed 's/^/        /' "$work/log"
    failed=$((failed + 1))
  elif [ $ms -gt $((1000 * limit_s)) ]; then
    echo "FAILED  $title: $seconds, allowed $limit_s s"
    failed=$((failed + 1))
  else
    echo "ok      $title: $seconds"
  fi
done
echo "$found blocks, $ran run, $failed failed"
[ $found -ge $least_blocks ] || { echo "FAILED  there should be $least_blocks blocks at least"; exit 1; }
[ $failed = 0 ]
