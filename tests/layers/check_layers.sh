#!/usr/bin/env bash
# Fails when an include goes up or sideways in the house, and on what else keeps it tidy. Reads the tree named as $1.
#   - A room includes only rooms below it:
#       core < io < net render < face highlight lighting insert synth < assets pipeline eval train < batch < apps bindings
#   - A public header includes no internal one, because only public ones are installed.
#   - Torch is seen only by src/net/torch and src/train.
#   - No file is longer than 600 lines.
set -euo pipefail

cd "$1"
folders=()
for folder in include src apps bindings tests bench fuzz; do
  if [ -d "$folder" ]; then folders+=("$folder"); fi
done
mapfile -d '' -t sources < <(find "${folders[@]}" -type f \( -name '*.h' -o -name '*.cpp' \) -print0 | sort -z)
[ ${#sources[@]} -gt 0 ] || { echo "no sources under $1"; exit 1; }

# The program is POSIX awk: Debian's is mawk.
awk '
  function fault(text) { print FILENAME ":" FNR ": " text; faults++ }
  function storey(room) { return (room in floor) ? floor[room] : -1 }

  BEGIN {
    split("core:0 io:1 net:2 render:2 face:3 highlight:3 lighting:3 insert:3 synth:3 assets:4 pipeline:4 eval:4 train:4 batch:5 faceprobe.h:5 apps:6 bindings:6",
          plan, " ")
    for (i in plan) { split(plan[i], pair, ":"); floor[pair[1]] = pair[2] + 0 }
  }

  FNR == 1 {
    split(FILENAME, part, "/")
    in_house = part[1] == "include" || part[1] == "src" || part[1] == "apps" || part[1] == "bindings"
    public_header = part[1] == "include"
    room = part[1] == "apps" || part[1] == "bindings" ? part[1] : (public_header ? part[3] : part[2])
    if (in_house && storey(room) < 0) fault("\"" room "\" is not a room of the house")
  }

  FNR == 601 { fault("longer than 600 lines") }

  in_house && /^[ \t]*#[ \t]*include[ \t]*["<]/ {
    target = $0
    sub(/^[ \t]*#[ \t]*include[ \t]*["<]/, "", target)
    quoted = $0 ~ /^[ \t]*#[ \t]*include[ \t]*"/
    sub(/[">].*$/, "", target)

    if (target ~ /^(torch|ATen|c10)\// && FILENAME !~ /^src\/(net\/torch|train)\//)
      fault("torch outside src/net/torch and src/train")
    if (quoted && target ~ /(^|\/)net\/torch(\/|_)/ && FILENAME !~ /^(include\/faceprobe\/net|src\/net\/torch|src\/train|apps|tests|bench)\//)
      fault("what stands on torch outside src/net/torch, src/train and apps")
    if (target ~ /(^|\/)\.\.?\//) fault("a relative include; write \"room/name.h\"")

    count = split(target, step, "/")
    if (step[1] == "faceprobe") {
      other = step[2]
      if (storey(other) < 0) { fault("\"" other "\" is not a room of the house"); next }
    } else if (quoted && count > 1 && storey(step[1]) >= 0) {
      other = step[1]
      if (public_header) fault("public header includes the internal \"" target "\"")
    } else {
      next
    }
    if (other != room && storey(other) >= storey(room)) fault(room " may not include " other " (" target ")")
  }

  END { if (faults) { print faults " fault(s)"; exit 1 } }
' "${sources[@]}"
echo "${#sources[@]} files in order"
