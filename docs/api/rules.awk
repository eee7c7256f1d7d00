# What a public declaration has to say; a fault is a line on stderr. Read beside docs/api/comments.awk.
#
# - A header opens with a comment that shows how it is used.
# - A comment belongs to the declaration below it, without a blank line between them.
# - A function says what it gives, but for validate(), operators and what is written out behind its name without arguments.
# - A picture, a map, a matrix or a vector says its shape, and its frame where it has one.
# - A number that is not whole says its unit or its range, or its name does.
# - An enumeration says what it chooses among, itself or at its values.

# The comment at the head is lines n .. end.
function check_opening(n, end,   k) {
  for (k = n; k <= end; k++) if (line[k] ~ /^\/\/   /) return
  fault(1, line[1], "and shows how it is used")
}

# Line n is a comment that nothing follows.
function check_alone(n) { printf "%s:%d: this comment belongs to no declaration\n", FILENAME, n > "/dev/stderr" }

# `code` is a declaration from line n on, of the kind `kind`; `told` is whether a comment goes with it.
function check(n, code, told) {
  if (told) return
  if (kind == "function") {
    if (code !~ /validate\(\)|operator|\(\) (const )?(noexcept )?[{]|\(\) = default;/) fault(n, code, "what it gives")
  } else if (kind == "" && code !~ /^(using|friend) /) {
    if (code ~ /(^|[ <:])(Image|ByteImage|EnvMap)[ >]|Eigen::/) fault(n, code, "its shape, and its frame where it has one")
    else if (code ~ /^(inline |static )*(constexpr )?(float|double) / && code !~ /_(px|m|m2|deg|rad|sr|share|per_second)( = [^,]*)?;/)
      fault(n, code, "its unit or its range")
  } else if (kind == "values" && line[n + 1] !~ /\/\//) fault(n, code, "what it chooses among")
}

function fault(n, code, what) {
  sub(/ *[{].*/, "", code)
  gsub(/  +/, " ", code)
  printf "%s:%d: %s: no comment says %s\n", FILENAME, n, code, what > "/dev/stderr"
}
