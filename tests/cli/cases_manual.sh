# The manual and the shells' completions: that they know what --help knows, and nothing else.

# help_section TITLE FILE: the lines of a section of --help, each entry's first line alone.
help_section() { awk -v title="$1:" '$0 == title { inside = 1; next } /^$/ { inside = 0 } inside && /^  [^ ]/' "$2"; }

# Writes --help of the program and all its verbs to help/faceprobe, help/faceprobe_synth_unwrap, ...
write_helps() {
  mkdir help
  local waiting=("") words below
  while [ ${#waiting[@]} -gt 0 ]; do
    words=${waiting[0]}
    waiting=("${waiting[@]:1}")
    # shellcheck disable=SC2086  # one argument a verb
    expect_exit 0 $words --help
    cp "$work/stdout" "help/faceprobe${words// /_}"
    for below in $(help_section Subcommands "$work/stdout" | awk '{ print $1 }'); do waiting+=("$words $below"); done
  done
}

help_options() { help_section Options "$1" | awk '{ print $1 }' | tr ',' '\n' | grep '^-' | LC_ALL=C sort; }

# What stands behind each .TP of OPTIONS.
page_options() {
  awk '/^\.SH / { inside = $2 == "OPTIONS" } inside && /^\.TP/ { getline; print }' "$1" | sed 's/\\-/-/g' |
    grep -oE '\\fB--?[a-z-]+\\fR' | sed -E 's/^\\fB|\\fR$//g' | LC_ALL=C sort
}

zsh_options() {
  awk -v start="_$1() {" '$0 == start { inside = 1 } /^}/ { inside = 0 } inside' completion.zsh |
    sed -nE "s/^    '(\([^)]*\))?\*?(--?[a-z-]+)[=+]?\[.*/\2/p" | LC_ALL=C sort
}

fish_options() {
  grep -F -e "'__faceprobe_at ${1//_/ }'" completion.fish | sed "s/ -d '.*//" | grep -oE ' -[sl] [a-z-]+' |
    sed -E 's/^ -s /-/; s/^ -l /--/' | LC_ALL=C sort
}

# bash_completes WORD...: what a tab behind these words of `faceprobe WORD...` offers.
bash_completes() {
  (
    set +eu
    source completion.bash
    COMP_WORDS=(faceprobe "$@")
    COMP_CWORD=$#
    _faceprobe
    if [ ${#COMPREPLY[@]} -gt 0 ]; then printf '%s\n' "${COMPREPLY[@]}" | LC_ALL=C sort; fi
  )
}

# expect_completed WANTED WORD...   WANTED: all that is offered, sorted, a space between.
expect_completed() {
  local wanted=$1 found
  shift
  found=$(bash_completes "$@" | paste -sd ' ')
  [ "$found" = "$wanted" ] || fail "faceprobe $* offers \"$found\" instead of \"$wanted\""
}

write_completions() {
  local shell
  for shell in bash zsh fish; do
    expect_exit 0 completion $shell
    expect_quiet
    cp "$work/stdout" completion.$shell
  done
}

expect_same() { [ "$2" = "$3" ] || fail "$1: "$'\n'"$3"$'\n'"instead of"$'\n'"$2"; }

case_manual_has_every_option() {
  write_helps
  write_completions
  expect_exit 0 -q manual --folder pages
  expect_quiet
  local name wanted words files=()
  for name in $(cd help && echo *); do files+=("${name//_/-}.1"); done
  expect_files pages "${files[@]}"
  for name in $(cd help && echo *); do
    wanted=$(help_options "help/$name")
    grep -qx -e --help <<<"$wanted" || fail "no options were read from --help of $name"
    expect_same "page of $name" "$wanted" "$(page_options "pages/${name//_/-}.1")"
    read -ra words <<<"${name//_/ }"
    expect_same "bash, $name" "$wanted" "$(bash_completes "${words[@]:1}" -)"
    expect_same "zsh, $name" "$wanted" "$(zsh_options "$name")"
    expect_same "fish, $name" "$wanted" "$(fish_options "$name")"
  done
}

# page_exit_codes, conventions_exit_codes: "0 Done." and so on.
page_exit_codes() {
  awk '/^\.SH / { inside = $0 == ".SH EXIT STATUS" } inside && /^\.TP/ { getline code; getline text; print code, text }' "$1" |
    sed -E 's/\\fB|\\fR//g; s/\\-/-/g'
}
conventions_exit_codes() {
  sed -n '/^## Errors and exit codes/,$p' "$here/../../CONVENTIONS.md" | sed -nE 's/^\| ([0-9]) \| (.*) \|$/\1 \u\2./p'
}

case_manual_pages() {
  expect_exit 0 manual --folder pages
  local codes page warnings
  codes=$(conventions_exit_codes)
  [ "$(wc -l <<<"$codes")" = 9 ] || fail "CONVENTIONS.md has other exit codes: $codes"
  for page in pages/*.1; do
    grep -qx '\.SH EXAMPLES' "$page" || fail "$page has no examples"
    grep -q '^faceprobe ' <(sed -n '/^\.SH EXAMPLES/,/^\.EE/p' "$page") || fail "no example of $page calls faceprobe"
    expect_same "exit codes of $page" "$codes" "$(page_exit_codes "$page")"
    # An option with a value that need not be given says what holds without it.
    awk '/^\.SH / { inside = $2 == "OPTIONS" }
         inside && /^\.TP/ { if (open != "") print open; getline; open = /\\fI/ ? $0 : "" }
         inside && (/[Dd]efault:/ || /^Required/) { open = "" }
         END { if (open != "") print open }' "$page" >silent
    [ ! -s silent ] || fail "in $page nothing is said of the default of $(cat silent)"
    if command -v groff >/dev/null; then
      warnings=$(groff -man -ww -z "$page" 2>&1)
      [ -z "$warnings" ] || fail "groff of $page: $warnings"
    fi
    if command -v man >/dev/null; then
      warnings=$(MANWIDTH=80 man --warnings -l "$page" 2>&1 >/dev/null)
      [ -z "$warnings" ] || fail "man of $page: $warnings"
    fi
  done
  # What is printed is what is written, and the same each time.
  expect_exit 0 manual
  cmp "$work/stdout" pages/faceprobe.1 || fail "the printed page is another"
  expect_exit 0 manual insert
  cmp "$work/stdout" pages/faceprobe-insert.1 || fail "the printed page of insert is another"
  if command -v groff >/dev/null; then
    # Dashes, dots and quotes come out as they went in.
    groff -man -Tascii -P -cbou -rLL=200n pages/faceprobe-insert.1 >text
    grep -qF -e "--material silver --height 0.15 --preview -o look.png" text || fail "an example of insert got lost"
    grep -qF -e "the object's own" text || fail "an apostrophe got lost"
    grep -qF -e "One of sphere, cube, pot, robot, spheres, or a file." text || fail "the shapes are not in the page"
    grep -qE -e '^ +-o, --output PATH$' text || fail "no -o, --output PATH in the page"
  fi
}

case_manual_refusals() {
  expect_refused 2 "no verb 'conjure'" manual conjure
  expect_stderr "estimate, separate"
  expect_refused 2 "no verb 'more' of faceprobe info" manual info more
  expect_refused 2 "--folder" manual info --folder pages
  expect_exit 2 completion
  expect_refused 2 "{bash,zsh,fish}" completion csh
  echo "old" >file
  expect_refused 6 "file" manual --folder file
  expect_files "$work" stdout stderr file
}

case_completion_in_bash() {
  write_completions
  bash -n completion.bash || fail "bash does not read its script"
  mkdir sub
  touch "b c.jpg" such.jpg
  expect_completed "insert" ins
  expect_completed "insert" -q ins
  expect_completed "" conj
  expect_completed "--material --matte" insert --mat
  expect_completed "--material --matte" insert "b c.jpg" --mat
  expect_completed "clay diffuse glass gold mirror plastic red silver" insert --material ""
  expect_completed "silver" insert --material si
  expect_completed "silver" insert --material = si   # as readline splits --material=si
  expect_completed "clay diffuse glass gold mirror plastic red silver" insert --material =
  expect_completed "--material=silver" insert --material=si  # as it does where "=" breaks no words
  # A value is not what comes behind it, whether there is one, two or one that looks like an option.
  expect_completed "--material" insert --turn -30 --mate
  expect_completed "--material" insert --at 3 4 --mate
  expect_completed "" insert --at 3 ""
  expect_completed "silver" insert -o estimate --material si
  # Paths where paths are taken, folders alone where folders are.
  expect_completed "b c.jpg" estimate b
  expect_completed "sub such.jpg" estimate such.jpg su
  expect_completed "sub" separate -o su
  expect_completed "sphere spheres" insert --object sp
  expect_completed "sub such.jpg" insert --object su
  expect_completed "" doctor ""
  # Words in the place of an argument.
  expect_completed "bash fish zsh" completion ""
  expect_completed "estimate" manual est
  # Verbs that not every build has.
  expect_exit 0 --help
  if grep -q '^  synth ' "$work/stdout"; then
    expect_completed "unwrap" synth u
    expect_completed "--coverage" synth unwrap --c
    expect_completed "--count" synth --heads sub such.jpg --c
    expect_completed "default paper" synth --mode ""
  fi
  if grep -q '^  eval ' "$work/stdout"; then expect_completed "relight results" eval --samples 3 re; fi
}

case_completion_in_zsh_and_fish() {
  write_completions
  local tried=0 line wanted found
  if command -v zsh >/dev/null; then
    tried=1
    zsh -n completion.zsh || fail "zsh does not read its script"
  fi
  if command -v fish >/dev/null; then
    tried=1
    fish -n completion.fish || fail "fish does not read its script"
    while IFS='|' read -r line wanted; do
      found=$(HOME=$work fish --no-config -c "source completion.fish; complete -C '$line'" | cut -f1 | LC_ALL=C sort | paste -sd ' ')
      [ "$found" = "$wanted" ] || fail "fish, $line: \"$found\" instead of \"$wanted\""
    done <<'LINES'
faceprobe ins|insert
faceprobe insert --mat|--material --matte
faceprobe insert --material s|silver
faceprobe -q completion |bash fish zsh
LINES
  fi
  [ $tried = 1 ] || exit 77
}

# offered FILE OPTION: the words that --help shows in braces behind the option.
offered() { grep -E -e "^  (-.,)?$2 " "$1" | grep -oE '\{[a-z0-9,]+\}' | tr -d '{}' | tr ',' ' '; }

case_offered_values_are_taken() {
  expect_exit 0 estimate --help
  cp "$work/stdout" help
  local option values round arguments
  # Several at a time: the first of each, then the second, and so on; of those with fewer the last again.
  for round in 0 1 2 3; do
    arguments=()
    for option in separator orient solver geometry shading prior device; do
      read -ra values <<<"$(offered help "--$option")"
      [ ${#values[@]} -ge 2 ] || fail "nothing is offered for --$option"
      arguments+=("--$option" "${values[round < ${#values[@]} ? round : ${#values[@]} - 1]}")
      if [ "${arguments[-1]}" = 3dmm ]; then arguments+=(--head missing.jpg); fi  # which names its model
    done
    # What the photo is like is asked after the options.
    expect_refused 3 "missing.jpg" estimate missing.jpg "${arguments[@]}"
  done
  expect_exit 0 insert --help
  cp "$work/stdout" help
  local shapes
  read -ra shapes <<<"$(offered help --object)"
  read -ra values <<<"$(offered help --material)"
  [ ${#shapes[@]} -ge 2 ] || fail "nothing is offered for --object"
  [ ${#values[@]} -ge ${#shapes[@]} ] || fail "fewer materials than shapes: not every shape would be tried"
  for round in "${!values[@]}"; do
    expect_refused 3 "missing.jpg" insert missing.jpg --material "${values[round]}" --object "${shapes[round % ${#shapes[@]}]}"
  done
}
