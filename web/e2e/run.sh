#!/usr/bin/env bash
# Runs the page's tests in a browser: run.sh FACEPROBE PHOTOS, the built command and the folder of the sample photos (.deps/data/samples).
# 77 where the browser or what npm fetches is missing. Pictures of every state, and of what failed, go to PAGE_TEST_OUTPUT (default: .test/e2e).
set -euo pipefail

if [ $# != 2 ]; then
  echo "run.sh FACEPROBE PHOTOS: the command that serves the page, and the folder of the sample photos." >&2
  exit 2
fi
FACEPROBE=$(realpath "$1")
FACEPROBE_PHOTOS=$(realpath "$2")
export FACEPROBE FACEPROBE_PHOTOS
unset FACEPROBE_DATA_DIR
cd "$(dirname "${BASH_SOURCE[0]}")/.."

skip() {
  echo "The page is not tested in a browser: $*" >&2
  exit 77
}

CHROMIUM=${CHROMIUM:-$(command -v chromium || true)}
[ -n "$CHROMIUM" ] || skip "chromium is missing; apt-get install chromium gets it, or CHROMIUM names one."
export CHROMIUM
[ -d node_modules/@playwright/test ] || skip "web/node_modules is missing; npm ci in web gets it."
[ -f "$FACEPROBE_PHOTOS/grace_hopper.jpg" ] || skip "the sample photos are missing; scripts/setup.sh gets them."
npm run --silent e2e
