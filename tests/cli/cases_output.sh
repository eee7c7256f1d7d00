# Where files end up, and what happens when they cannot.

quick_face_files() {
  local file
  for file in "${one_face_files[@]}"; do echo "$1/$file"; done
}

case_several_photos() {
  cp "$photo" first.jpg
  cp "$photo" second.jpg
  echo "not a photo" >broken.jpg
  expect_exit 0 estimate first.jpg second.jpg -o all "${quick[@]}"
  mapfile -t wanted < <(quick_face_files first; quick_face_files second)
  expect_files all "${wanted[@]}"
  # One bad photo does not cost the others theirs.
  expect_exit 8 estimate first.jpg broken.jpg missing.jpg second.jpg -o some "${quick[@]}"
  expect_stderr "broken.jpg"
  expect_stderr "missing.jpg"
  expect_files some "${wanted[@]}"
  # One light for both, beside their own or alone.
  expect_exit 0 estimate first.jpg second.jpg --same-light -o same "${quick[@]}"
  expect_files same "${wanted[@]}" joint/environment.{exr,hdr,png} joint/{confidence.exr,environment_rest.exr,light.usda,light.gltf,blender.py,report.json}
  expect_json faceprobe-joint-report/1 same/joint/report.json schema
  expect_json second.jpg same/joint/report.json photos 1 source
  expect_json 1 same/joint/report.json photos 0 faces
  expect_json "$(json same/first/report.json photo sha256)" same/joint/report.json photos 0 sha256
  json same/joint/report.json light spherical_harmonics rgb 8 2 >/dev/null || fail "no nine harmonics of the joint light"
  json same/joint/report.json light ambient_rgb 2 >/dev/null || fail "no surround of the joint light"
  json same/joint/report.json light main_lights >/dev/null || fail "no main lights of the joint light"
  # One report a photo, then that of their one light, which is of the photos that could be read.
  expect_exit 8 estimate first.jpg broken.jpg second.jpg --same-light -o same.exr --json "${quick[@]}"
  [ -s same.exr ] || fail "no joint map"
  [ "$(grep -c '^{$' "$work/stdout")" = 3 ] || fail "two photos and their light are three reports"
  awk '$0 == "{" { text = "" } { text = text $0 "\n" } END { printf "%s", text }' "$work/stdout" >last.json
  expect_json faceprobe-joint-report/1 last.json schema
  expect_json first.jpg last.json photos 0 source
  expect_json second.jpg last.json photos 1 source
  expect_refused 2 "several photos" estimate first.jpg --same-light -o alone
}

# One skin in several photos, each of which keeps its own light.
case_same_person() {
  cp "$photo" first.jpg
  cp "$photo" second.jpg
  echo "not a photo" >broken.jpg
  expect_exit 0 relight first.jpg --exposure -0.5 -o dim.png
  expect_exit 0 estimate first.jpg second.jpg -o apart --deterministic "${quick[@]}"
  expect_exit 0 estimate first.jpg second.jpg --same-person -o same --deterministic "${quick[@]}"
  mapfile -t wanted < <(quick_face_files first; quick_face_files second)
  expect_files same "${wanted[@]}"
  expect_json 2 same/first/report.json faces 0 same_person photos
  expect_json 2 same/second/report.json faces 0 same_person photos
  # Photos that agree have nothing to correct.
  cmp apart/first/environment.exr same/first/environment.exr || fail "the same photo twice has another light"
  cmp same/first/environment.exr same/second/environment.exr || fail "the same photo twice has two lights"
  # The skin of photos that differ is one all the same; a bad photo does not cost the others theirs.
  expect_exit 8 estimate first.jpg broken.jpg dim.png --same-person -o some --json "${quick[@]}"
  expect_stderr "2 of 3 photos share one person's skin"
  expect_stderr "broken.jpg"
  [ "$(grep -c '^{$' "$work/stdout")" = 2 ] || fail "two photos are two reports"
  expect_json 2 some/dim/report.json faces 0 same_person photos
  expect_json "$(json some/first/report.json faces 0 same_person albedo_rgb 1)" some/dim/report.json faces 0 same_person albedo_rgb 1
  expect_json "$(json some/first/report.json faces 0 light highlight_gain)" some/dim/report.json faces 0 light highlight_gain
  # With one photo left there is nothing to share.
  expect_exit 8 estimate first.jpg broken.jpg --same-person -o one "${quick[@]}"
  expect_stderr "fewer than two photos"
  expect_refused 2 "--same-person is for several photos" estimate first.jpg --same-person -o alone
  expect_refused 2 "leave one out" estimate first.jpg second.jpg --same-person --same-light -o both
  expect_refused 2 "2 photos" estimate first.jpg second.jpg --same-person -o light.exr
}

# Every kind of report against docs/schema/report.schema.json, and broken ones; skipped without python3-jsonschema.
case_report_schema() {
  local python=${PYTHON:-python3} check=("$here/../docs/check_report.py" "$here/../../docs/schema/report.schema.json")
  "$python" -c "from jsonschema import Draft202012Validator" 2>/dev/null || { echo "there is no python3-jsonschema"; exit 77; }
  cp "$photo" first.jpg
  expect_exit 0 relight first.jpg --exposure -0.5 -o dim.png
  expect_exit 0 estimate first.jpg dim.png --same-light -o net --json "${quick[@]}"
  cp "$work/stdout" several.json
  expect_exit 0 estimate first.jpg dim.png --same-person -o person "${quick[@]}"
  expect_exit 0 estimate first.jpg -o paper --solver paper --separator tan "${quick[@]}"
  expect_exit 0 estimate first.jpg -o regions --shading regions --geometry mesh --prior smooth "${quick[@]}"
  "$python" "${check[@]}" several.json net/joint/report.json {person/first,person/dim,paper,regions}/report.json ||
    fail "the schema and the reports differ"
  # What a careless writer would leave; the place is named.
  local kind
  for kind in 's|faceprobe-report/1|faceprobe-report/2| schema' 's|"yaw_deg": [-0-9.e]*|"yaw_deg": "left"| yaw_deg' '/"patches":/d patches'; do
    sed "${kind% *}" regions/report.json >broken.json
    ! cmp -s broken.json regions/report.json || fail "nothing was broken by ${kind% *}"
    ! "$python" "${check[@]}" broken.json >problems || fail "a broken report passes: ${kind% *}"
    grep -qF "${kind##* }" problems || fail "the problem is not named: ${kind##* }"
  done
}

case_several_photos_of_one_name() {
  mkdir one two
  cp "$photo" one/a.jpg
  cp "$photo" two/a.jpg
  cp "$photo" a_1.jpg
  cp "$photo" ...jpg
  expect_exit 0 separate one/a.jpg two/a.jpg a_1.jpg ...jpg -o deep/all
  expect_files deep all/{a_1_1,a_2,a_1,photo}/{highlight,diffuse}.exr
}

case_same_bytes_for_any_threads() {
  expect_exit 0 estimate "$photo" -o one --deterministic --threads 1
  sleep 1  # a date in a file would differ from here on
  expect_exit 0 estimate "$photo" -o three --deterministic --threads 3
  local file
  for file in "${one_face_files[@]}"; do
    if [ "$file" = report.json ]; then continue; fi  # holds the times taken
    cmp "one/$file" "three/$file" || fail "$file depends on --threads"
  done
}

case_odd_file_names() {
  local stem stems=("with space" "-dash" "Größe 顔" $'new\nline' '"quoted" $HOME `x`;' $'not utf8 \xff' "two.dots")
  local photos=("./no extension")
  cp "$photo" "no extension"
  for stem in "${stems[@]}"; do
    cp "$photo" "./$stem.jpg"
    photos+=("./$stem.jpg")
  done
  expect_exit 0 estimate "${photos[@]}" -o out "${quick[@]}"
  for stem in "no extension" "${stems[@]}"; do
    expect_files "out/$stem" "${one_face_files[@]}"
    expect_json faceprobe-report/1 "out/$stem/report.json" schema
  done
  expect_json "./Größe 顔.jpg" "out/Größe 顔/report.json" photo source
  expect_exit 0 estimate "./Größe 顔.jpg" -o $'Größe\n.exr' "${quick[@]}"
  [ -f $'Größe\n.exr' ] || fail "no map of that name"
}

case_closed_streams() {
  "$faceprobe" -q estimate "$photo" -o "open" --deterministic </dev/null
  "$faceprobe" estimate "$photo" -o closed --deterministic <&- >&- 2>&- || fail "exit $? with closed streams"
  local file
  for file in "${one_face_files[@]}"; do
    if [ "$file" = report.json ]; then continue; fi
    cmp "open/$file" "closed/$file" || fail "$file got what was meant for a closed stream"
  done
  # A report that nobody got is a failure.
  local code=0
  "$faceprobe" info --json "$photo" >&- 2>"$work/stderr" || code=$?
  [ "$code" = 6 ] || fail "exit $code with a closed stdout"
  if [ -c /dev/full ]; then
    code=0
    "$faceprobe" info --json "$photo" >/dev/full 2>"$work/stderr" || code=$?
    [ "$code" = 6 ] || fail "exit $code with a full stdout"
  fi
}

case_output_cannot_be_written() {
  echo "old" >file
  mkdir light.exr
  expect_refused 6 "file" estimate "$photo" -o file "${quick[@]}"
  expect_refused 6 "file/below" estimate "$photo" -o file/below "${quick[@]}"
  expect_refused 6 "file/light.exr" estimate "$photo" -o file/light.exr "${quick[@]}"
  expect_refused 6 "light.exr" estimate "$photo" -o light.exr "${quick[@]}"
  expect_refused 6 "nowhere" estimate "$photo" -o nowhere/light.exr "${quick[@]}"
  expect_refused 6 "file" separate "$photo" -o file
  expect_refused 6 "" estimate "$photo" -o "$(printf 'x%.0s' {1..300})" "${quick[@]}"
  [ "$(cat file)" = old ] || fail "the old file was touched"
  expect_files "$work" stdout stderr file
}

case_full_disk_leaves_the_old_file() {
  # The shell's limit on file sizes stands in for a full disk: write() fails half-way through a file. 8 KiB are enough for a
  # message, not for a map.
  expect_exit 0 estimate "$photo" -o out --size 256
  cp -r out before
  (
    trap '' XFSZ  # otherwise the signal kills, before write() can fail
    ulimit -f 8
    expect_refused 6 "cannot be written" estimate "$photo" -o out --size 256 --solver paper
    expect_refused 6 "cannot be written" estimate "$photo" -o fresh.hdr --size 512
  )
  [ ! -e fresh.hdr ] || fail "half a map was left"
  expect_files out "${one_face_files[@]}"
  local file changed=0
  for file in "${one_face_files[@]}"; do
    if cmp -s "before/$file" "out/$file"; then continue; fi
    changed=$((changed + 1))
    [ "$(stat -c %s "out/$file")" -le 8192 ] || fail "$file is neither the old one nor small enough to be whole"
  done
  cmp before/environment.exr out/environment.exr || fail "the old map was touched"
}

case_doctor() {
  expect_exit 0 doctor --json
  expect_json faceprobe-doctor/1 "$work/stdout" schema
  expect_json ON "$work/stdout" ok
  expect_exit 0 doctor
  expect_stdout "ok   light: a known lamp"
  expect_stdout "ok   version: "
  expect_stdout "ok   photos: jpeg, png"
  expect_stdout "ok   device: the processor"
}
