# What the verbs leave.

case_estimate_folder() {
  expect_exit 0 estimate "$photo" -o "not/there yet" --timings
  expect_files "not/there yet" "${one_face_files[@]}"
  expect_stderr "wrote 21 files"
  expect_stderr "find faces"  # of --timings
  [ ! -s "$work/stdout" ] || fail "without --json nothing is printed"
  local report="not/there yet/report.json"
  expect_json faceprobe-report/1 "$report" schema
  expect_json "$photo" "$report" photo source
  expect_json "$(sha256sum <"$photo" | cut -d' ' -f1)" "$report" photo sha256
  expect_json 512 "$report" photo width_px
  json "$report" faces 0 light main_lights 0 direction 2 >"$work/number" || fail "the report names no light"
  # A second run into the same folder leaves the same files.
  expect_exit 0 -q estimate "$photo" -o "not/there yet"
  expect_quiet
  expect_files "not/there yet" "${one_face_files[@]}"
}

case_estimate_one_map() {
  local name
  for name in light.exr light.hdr light.PNG; do
    mkdir "only-$name"
    expect_exit 0 estimate "$photo" -o "only-$name/$name" "${quick[@]}"
    expect_files "only-$name" "$name"
  done
  # Magic numbers of OpenEXR, Radiance and PNG.
  [ "$(od -An -tx1 -N4 only-light.exr/light.exr)" = " 76 2f 31 01" ] || fail "no OpenEXR file"
  [ "$(head -c 10 only-light.hdr/light.hdr)" = "#?RADIANCE" ] || fail "no Radiance file"
  [ "$(od -An -tx1 -N4 only-light.PNG/light.PNG)" = " 89 50 4e 47" ] || fail "no PNG file"
  grep -aqF -- "-Y 8 +X 16" only-light.hdr/light.hdr || fail "--size 16 did not give a map of 16 x 8"
}

case_orientations() {
  local orientation
  for orientation in openexr three blender debevec; do
    expect_exit 0 estimate "$photo" -o "$orientation.hdr" --orient "$orientation" --deterministic "${quick[@]}"
  done
  cmp -s three.hdr blender.hdr || fail "three.js and Blender read maps alike"
  if cmp -s openexr.hdr three.hdr; then fail "--orient three changed nothing"; fi
  if cmp -s openexr.hdr debevec.hdr; then fail "--orient debevec changed nothing"; fi
}

case_estimate_json() {
  expect_exit 0 estimate "$photo" -o out --json "${quick[@]}"
  expect_json faceprobe-report/1 "$work/stdout" schema
  expect_json 16 "$work/stdout" options map_size_px 0
  cmp "$work/stdout" out/report.json || fail "--json prints something else than report.json holds"
  # With given landmarks (the eyes, nose and mouth as info's picture has them) the detector is not asked.
  expect_exit 0 estimate "$photo" -o given --json "${quick[@]}" --landmarks 222,214,301,212,262,262,229,288,300,287
  expect_json 0 "$work/stdout" largest_face
}

case_separate() {
  expect_exit 0 separate "$photo" -o layers --separator yang --json
  expect_json 512 "$work/stdout" width_px
  expect_json layers/highlight.exr "$work/stdout" highlight
  expect_files layers highlight.exr diffuse.exr
  grep -aqF "faceprobe:separator" layers/highlight.exr || fail "the file does not say what made it"
  # Two corners of 32-bit coordinates, the second (511, 599).
  LC_ALL=C grep -aqP 'dataWindow\x00box2i\x00\x10\x00\x00\x00\x00{8}\xff\x01\x00\x00\x57\x02\x00\x00' layers/diffuse.exr ||
    fail "the layers do not have the photo's size of 512 x 600"
}

case_info() {
  expect_exit 0 info "$photo"
  expect_stdout "512 x 600 px"
  expect_stdout "face "
  expect_exit 0 info --json "$photo" "$photo"
  [ "$(wc -l <"$work/stdout")" = 2 ] || fail "--json prints one line per photo"
  head -n 1 "$work/stdout" >one.json
  expect_json jpeg one.json format
  expect_json 600 one.json height_px
  json one.json faces 0 box_px width >"$work/number" || fail "info --json names no face"
  expect_exit 8 info "$photo" missing.jpg
  expect_stdout "512 x 600 px"
  # A reader that leaves early is no error worth a word.
  { "$faceprobe" info "$photo" "$photo" 2>"$work/stderr" || true; } | head -c 1 >/dev/null
  expect_quiet
}
