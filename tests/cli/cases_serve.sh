# The local web server. HTTP is spoken by bash itself: nothing else needs to be installed.

# start_server ARGUMENT...   sets $server (its process), $address (what it printed) and $port; its folders go below $TMPDIR.
start_server() {
  mkdir -p "$work/tmp"
  export TMPDIR=$work/tmp
  rm -f "$work/address"
  mkfifo "$work/address"
  "$faceprobe" serve --port 0 "$@" >"$work/address" 2>"$work/stderr" </dev/null &
  server=$!
  trap '[ -z "$server" ] || kill -KILL "$server" || true; rm -rf "$work"' EXIT
  address=
  read -r -t 60 address <"$work/address" || fail "no address was printed"
  [[ $address =~ ^http://127\.0\.0\.1:([0-9]+)/$ ]] || fail "stdout is \"$address\""
  port=${BASH_REMATCH[1]}
}

# stop_server SIGNAL   the server ends by itself with 0, and nothing of it is left in $TMPDIR.
stop_server() {
  local found=0
  kill -"$1" "$server"
  wait "$server" || found=$?
  server=
  [ "$found" = 0 ] || fail "exit $found after $1"
  [ -z "$(ls -A "$TMPDIR")" ] || fail "$(ls -A "$TMPDIR") is left in TMPDIR"
}

# http METHOD PATH [FILE]   sends FILE as bytes; prints the status; what was answered is in $work/body.
http() {
  local connection
  exec {connection}<>"/dev/tcp/127.0.0.1/$port"
  {
    printf '%s %s HTTP/1.1\r\nHost: 127.0.0.1:%s\r\nConnection: close\r\n' "$1" "$2" "$port"
    if [ $# = 3 ]; then
      printf 'Content-Type: application/octet-stream\r\nContent-Length: %s\r\n\r\n' "$(stat -c %s "$3")"
      cat "$3"
    else
      printf '\r\n'
    fi
  } >&"$connection"
  cat <&"$connection" >"$work/answer"
  exec {connection}>&-
  sed '1,/^\r$/d' "$work/answer" >"$work/body"
  head -n 1 "$work/answer" | cut -d ' ' -f 2
}

expect_http() {
  local wanted=$1 found
  shift
  found=$(http "$@")
  [ "$found" = "$wanted" ] || fail "$* was answered with $found instead of $wanted: $(cat "$work/body")"
}

case_serve() {
  start_server
  "$faceprobe" --version >version
  expect_http 200 GET /api/v1/info
  expect_json "$(cat version)" "$work/body" version
  expect_json sphere "$work/body" objects 0
  expect_http 200 GET /
  # What is uploaded lies in the server's own folder, which goes with it.
  echo "not a photo" >text.jpg
  expect_http 202 POST "/api/v1/estimates?name=text.jpg" text.jpg
  expect_json text.jpg "$work/body" name
  [ -n "$(find "$TMPDIR" -name photo)" ] || fail "the photo is not in TMPDIR"
  expect_stderr "$address"
  stop_server TERM
  # Nobody listens any more.
  if (exec 3<>"/dev/tcp/127.0.0.1/$port") 2>/dev/null; then fail "port $port is still open"; fi
  expect_files "$work" stderr version text.jpg answer body json
}

# However soon: it is not to be lost between the address and the first request.
case_serve_ends_at_once() {
  local signal
  for signal in TERM TERM TERM HUP; do
    start_server -q
    stop_server "$signal"
    expect_quiet
  done
}

case_serve_keeps_results() {
  local id
  start_server --folder results
  expect_http 202 POST "/api/v1/estimates?name=grace.jpg" "$photo"
  id=$(json "$work/body" id)
  expect_http 200 GET "/api/v1/estimates/$id/events"  # comes back when the estimate has ended
  grep -qF '"state":"done"' "$work/answer" || fail "the estimate did not end well: $(cat "$work/answer")"
  expect_http 200 GET "/api/v1/estimates/$id"
  expect_json grace.jpg "$work/body" report photo source
  # A photo that is refused leaves nothing to keep.
  : >empty.jpg
  expect_http 400 POST /api/v1/estimates empty.jpg
  stop_server TERM
  expect_files "results/$id/light" "${one_face_files[@]}"
  cmp "$photo" "results/$id/photo" || fail "the photo is another"
  [ "$(ls results)" = "$id" ] || fail "in results are $(ls results)"
}

case_serve_refusals() {
  start_server
  expect_refused 2 "Port $port is taken" serve --port "$port"
  expect_stderr "--port"
  [ "$(find "$TMPDIR" -mindepth 1 -maxdepth 1 | wc -l)" = 1 ] || fail "the refused one left its folder: $(ls "$TMPDIR")"
  expect_http 200 GET /api/v1/info
  expect_refused 2 "65535" serve --port 70000
  expect_refused 2 "--max-upload" serve --max-upload 0
  : >taken
  expect_refused 6 "taken" serve --port 0 --folder taken/below
  mkdir nothing
  FACEPROBE_DATA_DIR=$work/nothing expect_refused 5 "scripts/setup.sh" serve --port 0
  stop_server TERM
}
