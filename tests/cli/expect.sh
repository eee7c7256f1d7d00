# What the cases are written with. Every check that fails says what it saw and ends the case.

fail() {
  echo "FAILED: $*"
  if [ -s "$work/stderr" ]; then sed 's/^/  stderr: /' "$work/stderr"; fi
  exit 1
}

# expect_exit CODE ARGUMENT...   runs the command, limit_s (60) seconds at most; its output is in $work/stdout and $work/stderr.
expect_exit() {
  local wanted=$1 found=0
  shift
  timeout "${limit_s:-60}" "$faceprobe" "$@" >"$work/stdout" 2>"$work/stderr" </dev/null || found=$?
  [ "$found" = "$wanted" ] || fail "exit $found instead of $wanted: faceprobe $*"
}

expect_stderr() { grep -qF -e "$1" "$work/stderr" || fail "no \"$1\" on stderr"; }
expect_stdout() { grep -qF -e "$1" "$work/stdout" || fail "no \"$1\" on stdout"; }
expect_quiet() { [ ! -s "$work/stderr" ] || fail "stderr should be empty"; }

# expect_refused CODE TEXT ARGUMENT...   exit code, one sentence on stderr that holds TEXT, nothing on stdout.
expect_refused() {
  local code=$1 text=$2
  shift 2
  expect_exit "$code" "$@"
  expect_stderr "$text"
  [ ! -s "$work/stdout" ] || fail "a refusal belongs on stderr: faceprobe $*"
}

# expect_files FOLDER NAME...   these files and no others, at any depth.
expect_files() {
  local folder=$1 found wanted
  shift
  found=$(cd "$folder" && find . -type f | sed 's|^\./||' | LC_ALL=C sort)
  wanted=$(printf '%s\n' "$@" | LC_ALL=C sort)
  [ "$found" = "$wanted" ] || fail "in $folder are"$'\n'"$found"$'\n'"instead of"$'\n'"$wanted"
}

# json FILE KEY...   prints the value at that path; fails when FILE is not JSON or has no such path.
json() {
  local file=$1
  shift
  cp "$file" "$work/json"  # CMake would split a name at its semicolons
  "$cmake" -D FILE="$work/json" -D KEYS="$(IFS=,; echo "$*")" -P "$here/json_value.cmake"
}

expect_json() {
  local wanted=$1 found
  shift
  found=$(json "$@") || fail "no JSON value at $*"
  [ "$found" = "$wanted" ] || fail "$* is $found instead of $wanted"
}

# The files that outputs.h lists for a photo with one face.
one_face_files=(environment.exr environment.hdr environment.png confidence.exr environment_rest.exr light.usda light.gltf blender.py
  regions.png overview.png report.json)
for layer in highlight diffuse albedo shading normals; do one_face_files+=("$layer.exr" "$layer.png"); done
