# Cases and methods of anybody's: docs/cases.md.

# Two cases in the folder cases, a method that copies the truth and counts its runs, and what others do.
write_cases_and_methods() {
  expect_exit 0 synth --count 2 --size 64 --views 1 --lights 2 --skins-per-person 1 --seed 4 -o faces
  expect_exit 0 eval export-cases --data faces -o cases
  expect_files cases CARD.md {000000,000001}/{photo.png,highlight.exr,diffuse.exr,normal.exr,mask.png,gt.hdr,pose.txt,case.json}
  cat >copy.sh <<'END'
#!/bin/sh
cp -- "$1/gt.hdr" "$2/map.hdr" && cp -- "$1/highlight.exr" "$2" && echo run >>runs
END
  printf '#!/bin/sh\necho "no idea" >&2\nexit 3\n' >fails.sh
  # What it starts must not outlive it.
  printf '#!/bin/sh\nsleep 300 &\necho $! >child\nsleep 300\n' >sleeps.sh
  printf '#!/bin/sh\nexit 0\n' >silent.sh
  chmod +x ./*.sh
}

runs() { wc -l <runs; }

# expect_ended PID: a child without a parent may stay as a zombie, which is no running process.
expect_ended() {
  local i
  for ((i = 0; i < 50; ++i)); do
    grep -q '^State:.*[RSD] (' "/proc/$1/status" 2>/dev/null || return 0
    sleep 0.1
  done
  fail "process $1 was left behind"
}

# Nothing but training and the networks that it alone runs pays for libtorch.
case_libtorch_on_demand() {
  LD_TRACE_LOADED_OBJECTS=1 "$faceprobe" >libraries
  grep -q libdnnl libraries || fail "the libraries were not listed"
  ! grep -qE "libtorch|libc10" libraries || fail "libtorch is loaded at every start"
  # A program that was taken away from its module does the rest, and says what it lacks.
  mkdir bin
  cp "$faceprobe" bin/faceprobe
  local faceprobe=$work/bin/faceprobe
  expect_exit 0 info "$photo"
  expect_refused 7 "needs libtorch" train light --data nowhere -o run
  expect_stderr "faceprobe_torch_side.so"
  expect_refused 7 "needs libtorch" estimate "$photo" -o run --shading-weights nowhere.safetensors
  [ ! -e run ] || fail "a refusal left a folder"
}

case_eval_cases() {
  write_cases_and_methods
  # Names that a shell would take for commands, options or lines, and that are placeholders themselves.
  local odd=$'-rf $(touch pwned); "x" \'y\' {out}|*\nz'
  mv cases/000001 "cases/$odd"
  local arguments=(eval cases --data cases --method "my method=./copy.sh {case} {out}" --threads 1 -o out)
  expect_exit 0 "${arguments[@]}"
  expect_stdout "2 of 2 cases of cases."
  [ "$(grep -cF '| my method | 2 of 1 person | 0.0 | [-, -] | 0.0 | 0.0 |' stdout)" = 2 ] || fail "the truth has an error under light"
  expect_stdout "| my method | 2 of 1 person | 0.00 | [-, -] | 0.00 | 0.00 |"
  expect_stdout "| my method | 2 of 1 person | 1.000 |"
  expect_stdout "| ambient | 2 of 1 person |"
  expect_stdout "| faceprobe |"
  [ ! -e pwned ] || fail "a case's name was run"
  local file
  for file in cases_light.csv cases_light.json cases_highlight.csv cases_highlight.json cases_runs.csv; do
    [ -s "out/$file" ] || fail "no $file"
  done
  json out/cases_light.json rows >/dev/null
  for file in "my method" ambient; do grep -qF "<th scope=\"row\">$file" out/cases.html || fail "no row of $file on the page"; done
  [ "$(grep -c '<img alt=.* src="data:image/png' out/cases.html)" = 2 ] || fail "other pictures than objects and layers on the page"
  grep -qF '"-rf $(touch pwned); ""x""' out/cases_runs.csv || fail "the odd name is not in the table"
  [ "$(runs)" = 2 ] || fail "$(runs) runs of two cases"
  cp stdout first
  # Everything is known.
  expect_exit 0 "${arguments[@]}"
  [ "$(runs)" = 2 ] || fail "what was known was run again"
  # Times of what failed, as finding a face in such a picture may, are not kept.
  cmp <(sed '/^### Seconds/,$d' first) <(sed '/^### Seconds/,$d' stdout) || fail "the second time it says something else"
  # A new name for the same case and method changes nothing; a changed script does.
  mv "cases/$odd" "cases/plain"
  expect_exit 0 eval cases --data cases --method "other=./copy.sh {case} {out}" -o out
  [ "$(runs)" = 2 ] || fail "another name is no other run"
  echo "# changed" >>copy.sh
  expect_exit 0 "${arguments[@]}"
  [ "$(runs)" = 4 ] || fail "a changed script was not run again"
  expect_exit 0 eval cases --data cases --samples 1 -o out
  expect_stdout "1 of 2 cases of cases."
}

case_eval_cases_failures() {
  write_cases_and_methods
  rm -r cases/000001
  expect_exit 0 eval cases --data cases --method "copy=./copy.sh {case} {out}" --method "fails=./fails.sh {case} {out}" \
    --method "sleeps=./sleeps.sh {case} {out}" --method "silent=./silent.sh {case} {out}" --seconds 1 -o out
  local method
  for method in fails sleeps silent; do expect_stdout "| $method | 0 (1 missing) | - |"; done
  expect_stdout "| copy | 1 | 0.0 |"
  expect_stdout "| fails | 000000 | exit code 3 |"
  expect_stdout "| sleeps | 000000 | over the limit of 1 s |"
  expect_stdout "| silent | 000000 | Neither map.hdr, map.exr nor highlight.exr was written"
  expect_stderr "results are missing"
  expect_ended "$(cat child)"
  grep -q "no idea" "$(sed -n 's/^| fails |.*| exit code 3 | \(.*\) |$/\1/p' stdout)/log.txt" || fail "what the method said was not kept"
  grep -q '^fails,000000,,exit code 3,' out/cases_runs.csv || fail "the reason is not in the table"
  # A failure is no result: it is tried again, and what was known is not.
  printf '#!/bin/sh\ncp "$1/gt.hdr" "$2/map.hdr"\n' >fails.sh
  expect_exit 0 eval cases --data cases --method "copy=./copy.sh {case} {out}" --method "fails=./fails.sh {case} {out}" -o out
  expect_stdout "| fails | 1 | 0.0 |"
  [ "$(runs)" = 1 ] || fail "what was known was run again"
  # Who ends the command ends the program.
  rm child
  "$faceprobe" eval cases --data cases --method "sleeps=./sleeps.sh {case} {out}" -o out >stdout 2>stderr &
  local command=$! i
  for ((i = 0; i < 300; ++i)); do
    if [ -s child ]; then break; fi
    sleep 0.1
  done
  [ -s child ] || fail "the program was not started"
  kill -TERM "$command"
  local code=0
  wait "$command" || code=$?
  [ "$code" = 143 ] || fail "exit $code after SIGTERM"
  expect_ended "$(cat child)"
}

case_eval_cases_refusals() {
  write_cases_and_methods
  local plain=(eval cases --data cases -o out)
  expect_refused 2 "-o" eval cases --data cases
  expect_refused 2 "-o" eval export-cases --data faces
  expect_refused 3 "nowhere" eval cases --data nowhere -o out
  expect_refused 3 "nowhere" eval export-cases --data nowhere -o out
  expect_refused 2 "no name" "${plain[@]}" --method "./copy.sh {case} {out}"
  expect_refused 2 "no name" "${plain[@]}" --method "=./copy.sh {case} {out}"
  expect_refused 2 "{case}" "${plain[@]}" --method "mine=./copy.sh {out}"
  expect_refused 2 "{out}" "${plain[@]}" --method "mine=./copy.sh {case}"
  expect_refused 2 "two methods called 'ambient'" "${plain[@]}" --method "ambient=./copy.sh {case} {out}"
  expect_refused 2 "--seconds" "${plain[@]}" --seconds 0
  expect_refused 3 "nowhere.obj" "${plain[@]}" --object nowhere.obj
  expect_refused 2 "./nowhere.sh cannot be started" "${plain[@]}" --method "mine=./nowhere.sh {case} {out}"
  echo "800" >cases/000001/pose.txt
  expect_refused 3 "cases/000001/pose.txt" "${plain[@]}" --method "mine=./copy.sh {case} {out}"
  [ ! -e runs ] || fail "a method was run on cases that are not in order"
  rm cases/000001/photo.png
  expect_refused 3 "cases/000001/photo.png is missing" "${plain[@]}"
}
