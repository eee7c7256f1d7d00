# Doxygen's input filter: turns the plain comments of our public headers into ones that Doxygen reads, so that the headers need not be
# written for a tool. POSIX awk (Debian's is mawk).
#
#   awk -f docs/api/comments.awk -f docs/api/rules.awk include/faceprobe/core/env_map.h
#
# - The comment that a header opens with becomes the page of that header, in its room's group. Lines with three blanks or more after the
#   slashes are code, or formulas.
# - A comment above a declaration or behind it becomes that declaration's. Functions that follow each other without a blank line share the
#   comment above the first. A comment with a blank line below belongs to nothing and is left out.
# - "room/name.h" in prose becomes a link to that header's page.
# - Copies, moves and destructors are left out: they are what they always are.

{ line[NR] = $0 }

END {
  root = FILENAME
  if (!sub(/faceprobe\/[a-z]+\/[^\/]+$/, "faceprobe/", root)) sub(/[^\/]+$/, "", root)
  header = substr(FILENAME, length(root) + 1)
  page = page_of(header)

  depth = 0           # of braces that opened one of the following
  scope[0] = "names"  # names (a namespace), members (a class), values (an enum)
  above = ""          # the comment above, as it is to be printed
  shared = ""         # the one that the next function shares

  for (last = 1; last < NR && line[last + 1] ~ /^\/\//; last++) {}
  opening(2, last)
  check_opening(2, last)
  for (i = last + 1; i <= NR; i++) {
    if (line[i] ~ /^[ \t]*$/) { above = shared = ""; print ""; }
    else if (line[i] ~ /^[ \t]*\/\//) i = comment(i)
    else if (line[i] ~ /^#/) print line[i]
    else if (line[i] ~ /^ *(public|protected|private):/) { hidden[depth] = line[i] !~ /public/; print line[i] }
    else if (line[i] ~ /^ *}/) closing(line[i])
    else if (scope[depth] == "values") value(line[i])
    else i = declaration(i)
  }
}

# --- the parts of a header, each from line n on

# The comment at the head, lines n .. end: what the file is in a sentence, and a page of its own.
function opening(n, end) {
  print line[1]
  print "/// \\file " header
  print "/// \\brief " prose(first_sentence(paragraph(n, end)))
  print "///"
  print "/// What it says and declares: \\ref " page ".\n"
  print "/// \\defgroup " page " " header
  if (header ~ /\//) print "/// \\ingroup " substr(header, 1, index(header, "/") - 1)
  print "///"
  print block(n, end)
}

# A comment on lines of its own. Returns its last line.
function comment(n,   end) {
  for (end = n; end < NR && line[end + 1] ~ /^[ \t]*\/\//; end++) {}
  shared = ""
  above = line[end + 1] ~ /^[ \t]*$|^ *}|^#|^ *(public|protected|private):/ ? "" : block(n, end)
  if (above == "") check_alone(n)
  return end
}

function closing(text) {
  if (scope[depth] == "names" && depth > 0) print "/// @}"
  print without_comment(text)
  depth--
  above = shared = ""
}

function value(text) { print (above == "" ? "" : above "\n") documented(text); above = "" }

# A declaration, which may take several lines. Returns its last line.
function declaration(n,   end, text, own, k) {
  kind = ""
  end = end_of_declaration(n)
  own = comment_of(line[end])
  text = statement  # the code of it
  if (text ~ /^(struct|class) [A-Za-z]+;/ || is_always_there(text)) {
    above = ""
    return end
  }
  if (kind == "function" && above == "") above = shared
  if (!hidden[depth]) check(n, text, above != "" || own != "")
  if (kind != "" && kind != "function" && own != "") {  # behind an opening brace
    above = above (above == "" ? "" : "\n") "///" prose(own)
    own = ""
  }
  if (above != "") print above
  for (k = n; k < end; k++) print line[k]
  print own == "" ? without_comment(line[end]) : documented(line[end])
  if (kind == "names") print "/// \\addtogroup " page "\n/// @{"
  if (kind == "names" || kind == "members" || kind == "values") { scope[++depth] = kind; hidden[depth] = text ~ /^(template <[^>]*> *)?class / }
  shared = kind == "function" ? above : ""
  above = ""
  return end
}

# Finds the end of a declaration; leaves its code in `statement` and what it is in `kind`.
function end_of_declaration(n,   k, c, at, text, braces, parentheses) {
  statement = ""
  braces = parentheses = 0
  for (k = n; k <= NR; k++) {
    text = without_literals(without_comment(line[k]))
    for (at = 1; at <= length(text); at++) {
      c = substr(text, at, 1)
      if (c == "(") parentheses++
      if (c == ")") parentheses--
      if (parentheses == 0 && c == "{") {
        kind = opens(statement)
        if (braces == 0 && kind != "function" && kind != "" && index(substr(text, at), "}") == 0) return k
        braces++
      }
      if (parentheses == 0 && c == "}") {
        braces--
        if (braces == 0 && opens(statement) == "function" && substr(text, at + 1) !~ /^ *[;,]/) { kind = "function"; return k }
      }
      if (braces == 0 && parentheses == 0 && c == ";") { kind = opens(statement) == "function" ? "function" : ""; statement = statement c; return k }
      if (!(braces == 0 && c == " " && statement == "")) statement = statement c
    }
    statement = statement " "
  }
  return NR
}

# What a brace after this code opens, or what the code is.
function opens(code) {
  sub(/^template <[^>]*> */, "", code)
  gsub(/std::function<[^;=]*> /, "std::function ", code)
  if (code ~ /^(inline )?namespace /) return "names"
  if (code ~ /^(struct|class) /) return "members"
  if (code ~ /^enum /) return "values"
  return code ~ /^[^=]*[A-Za-z_=\])]\(/ && code !~ /^(using|typedef) / ? "function" : ""
}

# Copies, moves, destructors.
function is_always_there(code,   name) {
  if (code ~ /^~|operator=\(/) return 1
  name = code
  sub(/\(.*/, "", name)
  return code == name "(const " name "&) = delete;" || code == name "(const " name "&);" || code == name "(" name "&&) noexcept;"
}

# --- text

function comment_of(text,   bare) {
  bare = without_comment(text)
  return substr(text, length(bare) + 1) == "" ? "" : substr(text, match_comment(text) + 2)
}

# Where a line's comment begins; 0 where it has none.
function match_comment(text,   at, c, quote) {
  quote = ""
  for (at = 1; at <= length(text); at++) {
    c = substr(text, at, 1)
    if (quote != "") {
      if (c == "\\") at++
      else if (c == quote) quote = ""
    } else if (c == "\"" || (c == "'" && substr(text, at - 1, 1) !~ /[0-9]/)) quote = c
    else if (substr(text, at, 2) == "//") return at
  }
  return 0
}

function without_comment(text,   at) {
  at = match_comment(text)
  if (at > 0) text = substr(text, 1, at - 1)
  sub(/[ \t]+$/, "", text)
  return text
}

function without_literals(text) {
  gsub(/"([^"\\]|\\.)*"/, "\"\"", text)
  gsub(/'[{}();]'/, "' '", text)
  return text
}

# Code with its comment as Doxygen takes it from behind.
function documented(text) { return match_comment(text) ? without_comment(text) "  ///<" prose(comment_of(text)) : text }

# Lines n .. end of a comment: the first sentence in brief, then the rest.
function block(n, end,   k, text, out, in_code) {
  text = paragraph(n, end)
  out = "/// \\brief " prose(first_sentence(text)) "\n///"
  text = substr(text, length(first_sentence(text)) + 2)
  if (text != "") out = out "\n/// " prose(text)
  for (k = n + paragraph_lines; k <= end; k++) {
    text = bare_comment(line[k])
    if (text ~ /^   / && !in_code) { in_code = 1; out = out "\n/// \\code{.cpp}" }
    if (text !~ /^   / && text != "" && in_code) { in_code = 0; out = out "\n/// \\endcode" }
    out = out "\n///" (in_code ? text : prose(text))
  }
  return out (in_code ? "\n/// \\endcode" : "")
}

# The first paragraph on one line; leaves how many lines it had.
function paragraph(n, end,   k, text) {
  for (k = n; k <= end && bare_comment(line[k]) !~ /^(   .*)?$/; k++) text = text (k > n ? " " : "") substr(bare_comment(line[k]), 2)
  paragraph_lines = k - n
  return text
}

function first_sentence(text,   at, rest) {
  at = 0
  for (rest = text; match(rest, /\. [A-Z0-9"`+#]/); rest = substr(rest, RSTART + 1)) {
    at += RSTART
    # These end no sentence: et al. 2006, Sec. 4, (R . L), 0 .. 1
    if (substr(text, 1, at) !~ /( |^)(al|Sec|Eq|Eqs|Int|J|e\.g|i\.e|\.)?\.$/) return substr(text, 1, at)
  }
  return text
}

function bare_comment(text) {
  sub(/^[ \t]*\/\//, "", text)
  return text
}

# Text that Doxygen is to take as it is, but for `code` and links to headers.
function prose(text,   piece, count, k, out) {
  count = split(text, piece, "`")
  for (k = 1; k <= count; k++) out = out (k > 1 ? "`" : "") (k % 2 == 1 ? linked(piece[k]) : piece[k])
  return out
}

function linked(text,   out, path) {
  while (match(text, /[a-z]+\/[a-z_0-9]+\.h/)) {
    path = substr(text, RSTART, RLENGTH)
    out = out escaped(substr(text, 1, RSTART - 1)) (is_there(path) ? "\\ref " page_of(path) " \"" path "\"" : path)
    text = substr(text, RSTART + RLENGTH)
  }
  return out escaped(text)
}

function escaped(text) {
  gsub(/\\/, "\\\\", text)
  gsub(/[#<>@%&$*~|]/, "\\\\&", text)
  return text
}

function page_of(path) {
  gsub(/[\/.]/, "_", path)
  sub(/_h$/, "", path)
  return path == "faceprobe" ? "umbrella" : path
}

function is_there(path,   first) {
  if (!(path in known)) {
    known[path] = (getline first < (root path)) > 0
    close(root path)
  }
  return known[path]
}
