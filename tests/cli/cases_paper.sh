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
  local arguments=(eval paper --data . --quick --faces faces --light faces --groups groups -o report)
  expect_exit 0 "${arguments[@]}"
  local file part
  for file in html json csv md; do [ -s "report/report.$file" ] || fail "no report.$file"; done
  for part in "Highlight layers of synthetic faces" "An object in the light that was found" "Lamps from several faces" "What each part is worth"; do
    grep -qF "## $part" report/report.md || fail "no section '$part'"
  done
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
