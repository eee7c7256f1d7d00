# Doxygen's filter for rooms.dox, a list of rooms in the order of the reference: a group and a namespace for each, told by the table of
# ARCHITECTURE.md. Run from the repository's root.
#
#   awk -f docs/api/rooms.awk docs/api/rooms.dox

BEGIN {
  while ((getline row < "ARCHITECTURE.md") > 0) {
    if (row !~ /^\| `[a-z]+` \| /) continue
    split(row, cell, / \| /)
    room = cell[1]
    gsub(/[|` ]/, "", room)
    does[room] = cell[2]
    sub(/ \|$/, "", cell[3])
    must_not[room] = cell[3]
  }
}

{
  for (i = 1; i <= NF; i++) {
    room = $i
    if (!(room in does)) { printf "%s:%d: ARCHITECTURE.md has no room %s\n", FILENAME, FNR, room > "/dev/stderr"; continue }
    text = toupper(substr(does[room], 1, 1)) substr(does[room], 2)
    gsub(/[<>]/, "\\\\&", text)
    sub(/\.$/, "", text)
    sub(/\. /, ".\n///\n/// ", text)  # the first sentence is the brief one
    printf "/// \\defgroup %s %s\n/// \\brief %s.\n///\n/// It knows nothing of: %s.\n\n", room, room, text, must_not[room]
    if (room != "core") printf "/// \\namespace faceprobe::%s\n/// The room \\ref %s \"%s\".\n\n", room, room, room
  }
}

END {
  print "/// \\namespace faceprobe\n/// The room \\ref core \"core\"; each other room has a namespace of its own in it.\n"
  print "/// \\namespace faceprobe::sh\n/// Spherical harmonics, \\ref core_sh \"core/sh.h\".\n"
}
