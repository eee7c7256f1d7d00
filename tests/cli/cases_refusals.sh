# What the command refuses, with which code and in which words.

case_help_and_version() {
  expect_exit 0 --help
  expect_stdout "estimate"
  expect_stdout "Exit codes"
  local verb
  for verb in estimate separate info; do
    expect_exit 0 "$verb" --help
    expect_stdout "PHOTO"
  done
  expect_exit 0 --version
  grep -qxE '[0-9]+\.[0-9]+\.[0-9]+' "$work/stdout" || fail "--version printed $(cat "$work/stdout")"
}

case_bad_options() {
  expect_exit 2
  expect_exit 2 conjure
  expect_exit 2 estimate
  expect_refused 2 "--conjure" estimate "$photo" --conjure
  expect_refused 2 "tan, yang, shen" estimate "$photo" --separator magic
  expect_refused 2 "tan, yang, shen" separate "$photo" --separator magic
  expect_refused 2 "transport" estimate "$photo" --solver magic
  expect_refused 2 "5 or 68 points" estimate "$photo" --landmarks 1,2,3
  expect_refused 2 "'x'" estimate "$photo" --landmarks 1,2,x
  expect_refused 2 "'nan'" estimate "$photo" --landmarks 1,2,nan
  expect_refused 2 "multiple of 4" estimate "$photo" --size 255
  expect_refused 2 "twice as wide" estimate "$photo" --size 256x256
  expect_refused 2 "twice as wide" estimate "$photo" --size 256x2147483647
  expect_refused 2 "'large'" estimate "$photo" --size large
  expect_refused 2 "cpu or cuda" estimate "$photo" --device gpu
  expect_refused 2 "openexr, three, blender or debevec" estimate "$photo" --orient mars
  expect_refused 2 "mesh" estimate "$photo" --geometry scan
  expect_refused 2 "--head" estimate "$photo" --geometry 3dmm
  expect_refused 2 "3dmm" estimate "$photo" --head heads
  expect_refused 3 "heads" estimate "$photo" --geometry 3dmm --head heads
  expect_refused 2 "smooth" estimate "$photo" --prior crystal
  expect_refused 2 "on or off" estimate "$photo" --compact-light maybe
  expect_refused 2 "iterations" estimate "$photo" --iterations 0
  expect_refused 2 "layer_px" estimate "$photo" --layer-px 5
  expect_refused 2 "focal" estimate "$photo" --focal-px -3
  expect_refused 2 "focal" estimate "$photo" --focal-px nan
  expect_refused 2 "--threads" estimate "$photo" --threads -1
  expect_refused 2 "pixels" estimate "$photo" --max-pixels 0
  expect_refused 2 "2 photos" estimate "$photo" "$photo" -o light.exr
  expect_refused 4 "two at least" triangulate "$photo" -o room
  expect_refused 2 "one photo" triangulate "$photo" "$photo" -o room
  # A device that was named and is not there is another matter than a word that is no device.
  expect_refused 7 "cuda" estimate "$photo" --device cuda
  expect_refused 7 "cuda:1" estimate "$photo" --device cuda:1
  expect_files "$work" stdout stderr
}

case_unreadable_photos() {
  mkdir folder
  echo "not a photo" >text.jpg
  : >empty.jpg
  head -c 20000 "$photo" >short.jpg
  expect_refused 3 "missing.jpg" estimate missing.jpg
  expect_refused 3 "folder" estimate folder
  expect_refused 3 "JPEG, PNG" estimate text.jpg
  expect_refused 3 "empty" estimate empty.jpg
  expect_refused 3 "cut short" estimate short.jpg
  expect_refused 3 "--max-pixels" estimate "$photo" --max-pixels 1000
  expect_refused 3 "--max-bytes" estimate "$photo" --max-bytes 1000
  local verb
  for verb in separate info; do
    expect_refused 3 "missing.jpg" "$verb" missing.jpg
    expect_refused 3 "JPEG, PNG" "$verb" text.jpg
  done
  expect_files "$work" stdout stderr text.jpg empty.jpg short.jpg
}

# 120 x 100 px of one grey. A Radiance file is a few lines of text and four bytes per pixel.
write_blank_picture() {
  printf '#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 100 +X 120\n' >"$1"
  local i
  for ((i = 0; i < 12000; ++i)); do printf '\200\200\200\200'; done >>"$1"
}

case_no_face() {
  write_blank_picture blank.hdr
  expect_refused 4 "120 x 100" estimate blank.hdr
  expect_refused 4 "give its landmarks" separate blank.hdr
  expect_files "$work" stdout stderr blank.hdr
  # To be without a face is an answer for info.
  expect_exit 0 info blank.hdr
  expect_stdout "no face"
}

case_missing_models() {
  mkdir nothing
  export FACEPROBE_DATA_DIR=$work/nothing
  local verb
  for verb in estimate separate info; do
    expect_refused 5 "scripts/setup.sh" "$verb" "$photo"
    expect_stderr "$work/nothing"
  done
  expect_exit 5 doctor
  expect_stdout "FAIL face_landmark.tflite"
  expect_stdout "ok   drawing"  # what needs no model is tested all the same
}

case_damaged_model() {
  mkdir damaged
  cp "$data"/*.tflite "$data"/*.obj damaged/
  head -c 100000 "$data/face_landmark.tflite" >damaged/face_landmark.tflite
  export FACEPROBE_DATA_DIR=$work/damaged
  expect_refused 5 "face_landmark.tflite" estimate "$photo"
  cp "$data/face_landmark.tflite" damaged/
  head -c 1000 "$data/canonical-face-model.obj" >damaged/canonical-face-model.obj
  expect_refused 5 "canonical-face-model.obj" estimate "$photo"
}
