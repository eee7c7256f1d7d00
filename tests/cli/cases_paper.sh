# `faceprobe eval paper`: the whole evaluation as a report.

case_eval_paper() {
  local limit_s=200  # a score of estimators, each with its models, and twice all of it
  expect_refused 3 "faces/ict_facekit" eval paper --data nowhere -o report
  [ ! -e report/report.html ] || fail "a report of nothing"
  expect_refused 2 "stage" eval
  expect_refused 2 "--data" eval highlight

  # One photo of each kind is too few to say anything, and enough for every part to run.
  expect_exit 0 synth --count 1 --size 64 --views 1 --lights 1 --skins-per-person 1 --seed 4 -o faces
  expect_exit 0 synth --count 1 --size 192 --views 1 --lights 1 --multi-face --seed 4 -o groups
  expect_exit 0 synth --count 1 --size 192 --views 1 --lights 1 --multi-face --people 2 --lamps 0 --seed 4 -o distant
  local arguments=(eval paper --data . --quick --faces faces --light faces --groups groups --distant distant -o report)
  expect_exit 0 "${arguments[@]}"
  local file part
  for file in html json csv md; do [ -s "report/report.$file" ] || fail "no report.$file"; done
  for part in "Highlight layers of synthetic faces" "An object in the light that was found" "Lamps from several faces" "What each part is worth"; do
    grep -qF "## $part" report/report.md || fail "no section '$part'"
  done
  grep -qF "under distant light alone with a lamp that is not there" report/report.md || fail "no invented lamps are told of"
  expect_exit 0 eval triangulate --data distant --samples 1
  expect_stdout "No photo has a near lamp"
  # What there is no data for is said.
  grep -qF "mscr.safetensors" report/report.html || fail "missing rivals are not named"
  json report/report.json sections >/dev/null
  # The same again, from what is known, to the last byte; and measured again, to the last digit.
  cp report/report.html first.html
  cp report/report.json first.json
  expect_exit 0 "${arguments[@]}"
  cmp first.html report/report.html || fail "what is kept reads otherwise"
  rm report/cache/{highlights,relighting,triangulation}-*.json
  expect_exit 0 "${arguments[@]}"
  cmp first.json report/report.json || fail "the second time it measures something else"

  # Rows of an earlier report, where its photos were the same.
  sed 's/"name": "li 2017, lite"/"name": "somebody"/' first.json >earlier.json
  expect_exit 0 "${arguments[@]}" --earlier earlier.json
  grep -q "^| somebody (.*earlier) |" report/report.md || fail "no row from the earlier report"
  expect_exit 0 "${arguments[@]}" --earlier first.json
  cmp first.json report/report.json || fail "a report of the same rows changes something"
  expect_refused 3 "not what faceprobe wrote" "${arguments[@]}" --earlier report/report.csv
  # One part, and the rest from before.
  expect_exit 0 eval paper --data . --quick --faces faces --parts highlights --earlier first.json -o part
  grep -q "These figures are an earlier version's" part/report.md || fail "parts that were not measured are not named"
  grep -q "^## Lamps from several faces" part/report.md || fail "a part of the earlier report is lost"
  expect_refused 2 "--parts" "${arguments[@]}" --parts everything
  expect_exit 0 "${arguments[@]}"

  # Its figures as a page, from the JSON alone.
  expect_exit 0 eval results report/report.json
  cmp "$work/stdout" report/report.md || fail "the page is another than the report's"
  expect_exit 0 eval results --headlines report/report.json
  grep -q "^| Highlight layer" "$work/stdout" || fail "no headline of the highlights"
  expect_refused 3 "not what faceprobe wrote" eval results report/report.csv
}

# Other people's programs as rows, through case folders.
case_eval_paper_programs() {
  local limit_s=100  # the rows of our own are measured, too
  expect_exit 0 synth --count 1 --size 64 --views 1 --lights 1 --skins-per-person 1 --seed 4 -o faces
  printf '#!/bin/sh\ncp -- "$1/gt.hdr" "$2/map.hdr" && echo run >>runs\n' >copy.sh
  printf '#!/bin/sh\nexit 3\n' >fails.sh
  chmod +x ./*.sh
  local plain=(eval paper --data . --quick --light faces --parts relighting -o report)
  expect_refused 2 "{out}" "${plain[@]}" --method "mine=./copy.sh {case}"
  expect_refused 2 "two methods called 'mine'" "${plain[@]}" --method "mine=./copy.sh {case} {out}" --method "mine=./fails.sh {case} {out}"
  [ ! -e report ] || fail "a refusal left a folder"
  local arguments=("${plain[@]}" --method "mine=./copy.sh {case} {out}" --method "theirs=./fails.sh {case} {out}")
  expect_exit 0 "${arguments[@]}"
  # Below 1 of 255: the map is stored in RGBE.
  awk -F, '$1 == "relighting" && $2 == "Diffuse object" && $3 == "mine" && $4 == "mean" {found = $5 != "" && $5 < 1} END {exit !found}' \
    report/report.csv || fail "the truth has an error under light"
  grep -qF "theirs has no result for 1 photo: exit code 3." report/report.md || fail "no reason for what is missing"
  # What is known is not run again; another program is.
  expect_exit 0 "${arguments[@]}"
  [ "$(wc -l <runs)" = 1 ] || fail "what was known was run again"
  rm report/cache/relighting-*.json
  expect_exit 0 "${arguments[@]}"
  [ "$(wc -l <runs)" = 1 ] || fail "what a program wrote was not kept"
  expect_refused 2 "two methods called 'transport'" "${plain[@]}" --method "transport=./copy.sh {case} {out}"
}

# Directions of known lights, on photos whose light nobody has measured: what is printed, not how well.
case_eval_direction() {
  local limit_s=200
  [ -f "$photo" ] || exit 77
  expect_refused 3 "neither real/yaleB" eval direction --data .
  mkdir -p real/yaleB/images real/portraits/london/{neutral_front,smiling_front}
  expect_exit 0 synth --count 1 --size 192 --views 1 --lights 1 --seed 4 -o faces --preview real/yaleB/images/a.png --preview-count 1
  printf 'file,subject,azimuth_deg,elevation_deg\na.png,a,10,20\n' >real/yaleB/lights.csv
  printf '{"lights": [{"direction_x_right_y_up_z_to_camera": [0.5, 0.5, 0.7]}]}' >real/portraits/london/lights_from_catchlights.json
  cp "$photo" real/portraits/london/neutral_front/001_03.jpg
  cp "$photo" real/portraits/london/smiling_front/001_08.jpg
  expect_refused 2 "--head" eval direction --data . --normals mesh,3dmm
  expect_refused 2 "--normals" eval direction --data . --normals guessed
  expect_refused 2 "--every" eval direction --data . --every 0
  expect_exit 0 eval direction --data . -o scores
  expect_files scores direction.csv direction.html direction.json
  local text
  for text in "## One flash on a real face" "## Three studio lights on many people" "| lombardi and nishino, lite |" \
    "| harmonics of order 2 from the shading |" "No row of legendre" "Gardner's and Hold-Geoffroy's networks have no row"; do
    expect_stdout "$text"
  done
  # Twice the same photo: a smile that is none turns no light.
  # The table's title has a comma, so its row is the fourth.
  awk -F, '$1 == "direction_london" && $4 ~ /^harmonics/ && $5 == "by a smile" {found = $6 != "" && $6 < 0.01} END {exit !found}' scores/direction.csv ||
    fail "the same photo has two lights"
  expect_exit 0 eval direction --data . --set london --normals mesh,net
  expect_stdout "| normals of the mesh |"
  expect_stdout "| normals of the net, without the prior |"
  ! grep -qF "One flash" "$work/stdout" || fail "a set that was not asked for"
  ! grep -qF "lombardi" "$work/stdout" || fail "rivals among the rows by normals"
}

# bench/rivals.sh, with a program in the place of ours that trains nothing: what is done in which order, and what a stop leaves.
case_rivals() {
  local script=$here/../../bench/rivals.sh name
  mkdir -p data/hdri/train data/hdri/dev data/faces/ict_facekit data/faces/london_uv_textures build/bin
  touch data/hdri/{train,dev}.csv data/hdri/train/{hall,open3d_room}.hdr data/hdri/dev/field.hdr
  cat >build/bin/faceprobe <<'END'
#!/usr/bin/env bash
# Leaves half weights where FAILS says so, and stops where STOPS does.
echo "$*" >>calls
while [ $# -gt 0 ]; do
  if [ "$1" = -o ]; then out=$2; fi
  shift
done
[ -n "${out:-}" ] || exit 0
mkdir -p "$out"
touch "$out/index.json"
echo half >"$out/weights.safetensors"
name=$(basename "$out")
[ "$name" != "${FAILS:-}" ] || exit 4
if [ "$name" = "${STOPS:-}" ]; then echo '{"finished":false,"steps":3}'; exit 0; fi
echo "$name" >"$out/weights.safetensors"
echo '{"finished":true,"steps":4}'
END
  chmod +x build/bin/faceprobe
  # expect_rivals CODE ARGUMENT...
  expect_rivals() {
    local wanted=$1 found=0
    shift
    "$script" "$@" --build "$work/build" >"$work/stdout" 2>"$work/stderr" </dev/null || found=$?
    [ "$found" = "$wanted" ] || fail "exit $found instead of $wanted: rivals.sh $*"
  }
  expect_rivals 2 data
  expect_stderr "usage"
  expect_rivals 2 nowhere weights
  expect_stderr "nowhere/hdri/train"
  expect_rivals 2 data weights nofaces
  expect_stderr "nofaces/train"
  [ ! -e calls ] || fail "something was run"

  # One fails, and a later one is stopped: what is whole is there, and nothing else.
  FAILS=sky STOPS=mscr expect_rivals 1 data weights
  expect_stderr "sky failed"
  expect_stderr "mscr was stopped"
  [ "$(cd weights && echo *.safetensors)" = "gardner.safetensors legendre.safetensors" ] || fail "other weights: $(ls weights)"
  grep -q "^synth .*--split train --count 20000" calls || fail "no training faces"
  [ "$(ls weights/work/maps)" = hall.hdr ] || fail "maps whose terms are not known were taken"
  grep -q "^train gardner .*--scenes .*train.csv .*dev.csv -o weights/work/gardner" calls || fail "gardner was not told what is indoor"
  # The same again makes what is missing, and no more.
  rm calls
  expect_rivals 0 data weights
  ! grep -qE "^synth|gardner|legendre" calls || fail "what was there was made again"
  for name in gardner sky legendre mscr shi albedo_shading; do
    [ "$(cat "weights/$name.safetensors")" = "$name" ] || fail "the weights of $name are others"
  done
  rm calls
  expect_rivals 0 data weights
  ! grep -q "^train" calls || fail "what was there was trained again"
  # Faces that somebody has.
  rm calls
  expect_rivals 0 data others weights/faces
  ! grep -qE "^(synth|mesh)" calls || fail "given faces were made"
  grep -q "^train legendre --data weights/faces/train --validation weights/faces/dev" calls || fail "given faces were not taken"
}
