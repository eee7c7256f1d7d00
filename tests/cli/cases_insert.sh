# A virtual object in a photo.

few_rays=("${quick[@]}" --samples 4 --noise 0)

# expect_difference A B LEFT TOP RIGHT BOTTOM   B has A's size, and is another picture in a box that lies in this one and fills half of its
# width and height at least.
expect_difference() {
  local a=$1 b=$2 width height left top right bottom
  "$picture_tool" difference "$a" "$b" >"$work/number" 2>"$work/stderr" || fail "$a and $b cannot be compared"
  read -r width height left top right bottom <"$work/number"
  [ "$right" -gt 0 ] || fail "$b is $a"
  if [ "$left" -lt "$3" ] || [ "$top" -lt "$4" ] || [ "$right" -gt "$5" ] || [ "$bottom" -gt "$6" ] ||
    [ $((2 * (right - left))) -lt $(($5 - $3)) ] || [ $((2 * (bottom - top))) -lt $(($6 - $4)) ]; then
    fail "of $width x $height px $left $top $right $bottom differ instead of $3 $4 $5 $6"
  fi
}

case_insert() {
  # 50 mm on the diagonal of 512 x 600 px are 911 px: .08 m at .6 m are 121 px, here from row 429 to 550, and with its corners in front 145 px
  # across. 10 px more for perspective and blur.
  local cube=(insert "$photo" --object cube --at 400 550 --distance 0.6 --height 0.08 "${few_rays[@]}")
  expect_exit 0 "${cube[@]}" -o floating.png --no-ground --horizon 300 --json
  expect_files "$work" stdout stderr floating.png
  expect_json faceprobe-insert/1 "$work/stdout" schema
  expect_json "$photo" "$work/stdout" photo
  expect_json cube "$work/stdout" object
  expect_json "" "$work/stdout" ground
  expect_json ON "$work/stdout" complete  # CMake's word for true
  expect_difference "$photo" floating.png 317 419 482 580
  # On a ground the shadow may reach three of its longest sides further, here to the picture's edges; nothing changes above it.
  expect_exit 0 -q "${cube[@]}" -o standing.exr --deterministic --threads 1
  expect_quiet
  [ ! -s "$work/stdout" ] || fail "without --json nothing is printed"
  expect_difference "$photo" standing.exr 0 419 512 600
  expect_exit 0 "${cube[@]}" -o again.exr --deterministic --threads 3
  cmp standing.exr again.exr || fail "the picture depends on --threads"
  rm again.exr
  # A folder holds everything; and what --json prints is in it.
  expect_exit 0 "${cube[@]}" -o "not/there yet" --material gold --matte floating.png --json
  expect_files "not/there yet" composite.png composite.exr object.png object.exr shadow.exr depth.exr normal.exr insert.json
  cmp "$work/stdout" "not/there yet/insert.json" || fail "--json prints something else than insert.json holds"
}

# Colour, kind, roughness and index of refraction; and a place by metres.
case_insert_materials() {
  local ball=(insert "$photo" --object sphere --height 0.08 --no-ground "${few_rays[@]}")
  expect_exit 0 "${ball[@]}" --at 400 550 -o own.png
  # .08 m at three quarters of .72 m, focal length 911 px, are 135 px.
  for change in "--colour #c01010" "--colour 0,0.5,0" "--kind metal --roughness 0.4" "--material glass --ior 1.1"; do
    # shellcheck disable=SC2086  # options and their values
    expect_exit 0 "${ball[@]}" --at 400 550 $change -o changed.png
    expect_difference own.png changed.png 317 400 484 565
  done
  # The same by two ways.
  expect_exit 0 "${ball[@]}" --at 400 550 --material diffuse --colour '#ffffff' --deterministic -o white.png
  expect_exit 0 "${ball[@]}" --at 400 550 --colour 1,1,1 --kind diffuse --deterministic -o again.png
  cmp white.png again.png || fail "white is not white"
  expect_exit 0 "${ball[@]}" --beside -0.15 -o beside.png
  expect_difference "$photo" beside.png 0 415 150 560  # 101 px large, 182 px to the left of the face's middle
}

case_insert_preview() {
  "$picture_tool" enlarge "$photo" large.png
  expect_exit 0 insert large.png -o look.png --preview --noise 0 --object cube --at 800 1100 "${quick[@]}"
  # 1024 x 1200 px became 546 x 640.
  expect_exit 0 info look.png
  expect_stdout "546 x 640 px"
  # What is no larger keeps its size.
  expect_exit 0 insert "$photo" -o small.png --preview --noise 0 --object cube "${quick[@]}"
  expect_exit 0 info small.png
  expect_stdout "512 x 600 px"
}

# expect_no_picture CODE TEXT ARGUMENT...   refused, and no file is left.
expect_no_picture() {
  local code=$1 text=$2
  shift 2
  expect_refused "$code" "$text" insert -o out.png "${few_rays[@]}" "$@"
  [ ! -e out.png ] || fail "a refusal left out.png: insert $*"
}

case_insert_refusals() {
  local plain=(--object cube)
  expect_no_picture 2 "pot, robot, spheres" "$photo" --object conjured
  expect_no_picture 2 "silver" "$photo" "${plain[@]}" --material conjured
  expect_no_picture 2 "R,G,B" "$photo" "${plain[@]}" --colour crimson
  expect_no_picture 2 "colour must be from 0 to 1" "$photo" "${plain[@]}" --colour 2,0,0
  expect_no_picture 2 "diffuse, metal, plastic, glass" "$photo" "${plain[@]}" --kind wood
  expect_no_picture 2 "roughness must be from 0 to 1" "$photo" "${plain[@]}" --kind metal --roughness 1.5
  expect_no_picture 2 "metal and plastic" "$photo" "${plain[@]}" --material glass --roughness 0.5
  expect_no_picture 2 "from 1 to 3" "$photo" "${plain[@]}" --kind glass --ior 0.5
  expect_no_picture 2 "plastic and glass" "$photo" "${plain[@]}" --material gold --ior 1.4
  expect_no_picture 2 "beside" "$photo" "${plain[@]}" --beside 1000
  expect_no_picture 2 "twice" "$photo" "${plain[@]}" --beside 0.2 --at 30 40
  expect_no_picture 2 "one photo, found 2" "$photo" "$photo" "${plain[@]}"
  expect_no_picture 2 "height" "$photo" "${plain[@]}" --height 0
  expect_no_picture 2 "height" "$photo" "${plain[@]}" --height nan
  expect_no_picture 2 "distance" "$photo" "${plain[@]}" --distance -1
  expect_no_picture 2 "turn" "$photo" "${plain[@]}" --turn inf
  expect_no_picture 2 "horizon" "$photo" "${plain[@]}" --horizon nan
  expect_no_picture 2 "place" "$photo" "${plain[@]}" --at nan 3
  expect_no_picture 2 "--at" "$photo" "${plain[@]}" --at 3
  expect_no_picture 2 "--samples" "$photo" "${plain[@]}" --samples 0
  expect_no_picture 2 "noise" "$photo" "${plain[@]}" --noise -1
  expect_no_picture 2 "in the picture" "$photo" "${plain[@]}" --at 5000 300
  expect_no_picture 3 "missing.jpg" missing.jpg "${plain[@]}"
  expect_no_picture 3 "missing.png" "$photo" "${plain[@]}" --matte missing.png
  write_blank_picture blank.hdr
  expect_no_picture 4 "120 x 100" blank.hdr "${plain[@]}"
  expect_no_picture 2 "512 x 600, found 120 x 100" "$photo" "${plain[@]}" --matte blank.hdr
  expect_refused 2 "in the picture" insert "$photo" "${plain[@]}" --at 5000 300 -o out "${few_rays[@]}"  # no folder either
  expect_refused 6 "nowhere" insert "$photo" "${plain[@]}" -o nowhere/out.png "${few_rays[@]}"
  expect_refused 2 "out.jpg" insert "$photo" "${plain[@]}" -o out.jpg "${few_rays[@]}"
  echo "a file where the folder should be" >taken
  expect_refused 6 "taken" insert "$photo" "${plain[@]}" -o taken "${few_rays[@]}"
  expect_files "$work" stdout stderr blank.hdr taken
  [ ! -e out ] || fail "a refusal left a folder"
}

# A coordinate that is no number; a header that promises more than there is; a texture that is not there.
case_insert_hostile_models() {
  printf 'v 0 0 0\nv 1 nan 0\nv 0 1 0\nf 1 2 3\n' >nan.obj
  printf 'ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n' >huge.ply
  printf 'element face 50000000\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n' >>huge.ply
  printf 'mtllib bare.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl paint\nf 1/1 2/2 3/3\n' >bare.obj
  printf 'newmtl paint\nmap_Kd lost.png\n' >bare.mtl
  echo "not a model" >text.glb
  expect_no_picture 3 "nan.obj" "$photo" --object nan.obj
  expect_no_picture 3 "50000000" "$photo" --object huge.ply
  expect_no_picture 3 "lost.png" "$photo" --object bare.obj
  expect_no_picture 3 "text.glb" "$photo" --object text.glb
  expect_no_picture 3 "missing.obj" "$photo" --object missing.obj
  expect_no_picture 3 ".glb" "$photo" --object "$photo"
  expect_files "$work" stdout stderr nan.obj huge.ply bare.obj bare.mtl text.glb
}

# What is odd, but no reason to ask for a report.
case_insert_odd_input() {
  local plain=(--object cube)
  expect_no_picture 2 "place" "$photo" "${plain[@]}" --at 1e300 0
  expect_no_picture 2 "horizon" "$photo" "${plain[@]}" --horizon 1e300
  printf 'v 0 0 0\nv 1 0 0\nv 0 0 1\nf 1 3 2\n' >flat.obj
  expect_no_picture 3 "height" "$photo" --object flat.obj
  # A sheet that stands upright is a thing like others.
  printf 'v -1 0 0\nv 1 0 0\nv 1 2 0\nv -1 2 0\nf 1 2 3 4\n' >sheet.obj
  expect_exit 0 insert "$photo" --object sheet.obj -o sheet.PNG "${few_rays[@]}"
  [ -f sheet.PNG ] || fail "sheet.PNG is no file"
  local odd=$'not utf8 \xff.jpg'
  cp "$photo" "$odd"
  expect_exit 0 insert "$odd" "${plain[@]}" -o odd "${few_rays[@]}"
  expect_json faceprobe-insert/1 odd/insert.json schema
}

case_relight() {
  expect_exit 0 relight "$photo" "${quick[@]}" --dim 1 -o dimmed.png
  expect_difference "$photo" dimmed.png 150 110 380 350  # the face, and nothing else
  expect_exit 0 relight "$photo" "${quick[@]}" --dim 1 -o dimmed.png --json
  expect_json 1 "$work/stdout" faces
  # The same light named with its share, and half of it.
  expect_exit 0 relight "$photo" "${quick[@]}" --deterministic --dim 1 -o dimmed.png
  expect_exit 0 relight --dim 1=1 "$photo" "${quick[@]}" --deterministic -o again.png
  cmp dimmed.png again.png || fail "--dim 1=1 is not --dim 1"
  expect_exit 0 relight "$photo" "${quick[@]}" --dim 1=0.5 -o again.png
  expect_difference dimmed.png again.png 150 110 380 350
  rm again.png
  expect_refused 2 "would stay as it is" relight "$photo" "${quick[@]}" -o same.png
  expect_exit 0 estimate "$photo" "${quick[@]}" -o light.exr
  expect_refused 2 "dim is for" relight "$photo" "${quick[@]}" --dim 1 --map light.exr -o both.png
  expect_refused 3 "no_such_map.exr" relight "$photo" "${quick[@]}" --map no_such_map.exr -o lost.png
  expect_files "$work" stdout stderr dimmed.png light.exr number json
}

case_relight_refusals() {
  local wrong
  for wrong in x 1=x 1= = 1.5 "1=0.5=2"; do
    expect_refused 2 "--dim" relight "$photo" --dim "$wrong" -o out.png
  done
  expect_refused 2 "numbered from 1" relight "$photo" --dim 0 -o out.png
  expect_refused 2 "found 6" relight "$photo" --dim 6 -o out.png
  expect_refused 2 "share of light 2" relight "$photo" --dim 2=1.5 -o out.png
  expect_refused 2 "twice" relight "$photo" --dim 2 --dim 2=0.5 -o out.png
  expect_files "$work" stdout stderr
}

# The same face twice: what it sees comes from the same directions, so from afar. A face with one main light: of a soft sky each copy, off the
# axis as it is in the pair, has another place for brightest.
case_triangulate() {
  "$picture_tool" double "$data/samples/astronaut.png" pair.png
  expect_exit 0 triangulate pair.png "${quick[@]}" -o "not/there yet" --json
  expect_files "not/there yet" room.json room.gltf room.png
  cmp "$work/stdout" "not/there yet/room.json" || fail "--json prints something else than room.json holds"
  expect_json faceprobe-room/1 "$work/stdout" schema
  expect_json pair.png "$work/stdout" photo
  local left right
  left=$(json "$work/stdout" faces 0 position_m 0)
  right=$(json "$work/stdout" faces 1 position_m 0)
  case $left in -*) ;; *) fail "the left face is at $left m" ;; esac
  case $right in -*) fail "the right face is at $right m" ;; esac
  json "$work/stdout" lamps 0 seen_by 1 face >/dev/null || fail "no light is seen by both"
  # The scene can be read: two masks, beside one another.
  expect_exit 0 insert "$photo" --object "not/there yet/room.gltf" --height 0.05 -o masks.png "${few_rays[@]}"
  expect_exit 0 info "not/there yet/room.png"
  expect_stdout "1280 x 640 px"
}
