#!/usr/bin/env bash
# Shows that check_containerfile.sh can fail: each fault is planted alone in a small right file and has to be found there.
set -euo pipefail

check=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)/check_containerfile.sh
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
failures=0
touch "$folder/there"

right='FROM debian:12-slim AS build
COPY there /src/
RUN apt-get update && apt-get install -y \
    g++ && rm -rf /var/lib/apt/lists/*
FROM debian:12-slim
COPY --from=build /src/a.deb /tmp/
USER somebody
WORKDIR /photos
ENTRYPOINT ["faceprobe"]'

# expect NAME SED_EXPRESSION PATTERN
expect() {
  local output
  sed -e "$2" <<<"$right" >"$folder/Containerfile"
  if cmp -s "$folder/Containerfile" <(echo "$right"); then echo "FAILED: $1 was not planted"; failures=$((failures + 1)); return; fi
  if output=$(bash "$check" "$folder/Containerfile" "$folder"); then
    echo "FAILED: $1 was not found"
    failures=$((failures + 1))
  elif ! grep -q "$3" <<<"$output"; then
    echo "FAILED: $1 gave another message: $output"
    failures=$((failures + 1))
  fi
}

echo "$right" >"$folder/Containerfile"
bash "$check" "$folder/Containerfile" "$folder" || { echo "FAILED: the right file has a fault"; failures=$((failures + 1)); }
expect "a misspelt instruction" 's/^WORKDIR/WORKDR/' "WORKDR is no instruction"
expect "the tag latest" '1s/12-slim/latest/' "tag latest"
expect "no tag" '1s/:12-slim//' "has no tag"
expect "a stage that is not there" 's/--from=build/--from=builder/' "no stage builder"
expect "a file that is not there" 's/COPY there/COPY nowhere/' "there is no nowhere"
expect "lists left behind" 's/ && rm -rf .*//' "package lists stay"
expect "no update" 's/apt-get update && //' "without update"
expect "a question" 's/ -y / /' "would ask"
expect "root" '/^USER/d' "runs as root"
expect "an entry for a shell" 's/\["faceprobe"\]/faceprobe/' "no list of strings"
expect "no entry" '/^ENTRYPOINT/d' "no ENTRYPOINT"
expect "a relative folder" 's|^WORKDIR /photos|WORKDIR photos|' "not absolute"
expect "a line that goes on" 's/\["faceprobe"\]/& \\/' "goes on after the end"
[ $failures = 0 ] && echo "each of 13 faults was found"
