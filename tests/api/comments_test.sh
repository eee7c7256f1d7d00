#!/usr/bin/env bash
# What docs/api/comments.awk makes of a small header, line by line, and which declarations docs/api/rules.awk finds wanting.
#   comments_test.sh SOURCE_FOLDER
set -euo pipefail

api=$1/docs/api
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mkdir -p "$folder/faceprobe/io" "$folder/faceprobe/core"
echo '#pragma once' >"$folder/faceprobe/core/map.h"
failures=0

filter() { awk -f "$api/comments.awk" -f "$api/rules.awk" "$folder/faceprobe/io/$1"; }

cat >"$folder/faceprobe/io/thing.h" <<'END'
#pragma once
// Things of <io>, after Yi et al. 2018 and core/map.h, not core/none.h. For
// #things x 3.
//
//   Thing thing = read("a//b");   // a * b
//
// Not for others.

#include "faceprobe/core/map.h"

namespace faceprobe::io {

// What kind.
enum class Kind {
  kOne,  // the first
  kTwo,
};

struct Thing {  // plain

  Image picture;  // H x W x 3
  float size_m = 0;
  // Both ways.
  static Thing from(int a,
                    int b);
  static Thing to(int a) {
    // in a body nothing is turned
    return {.size_m = static_cast<float>(a)};  // nor here
  }
  Thing(const Thing&) = delete;
  ~Thing();

 private:
  Image hidden;
};

// Reads `a * b`, 0 .. 1. Throws Error(kInput).
Thing read(const std::string& name = "; // {");
Thing read(int number);  // too
void alone();

}  // namespace faceprobe::io
END
cat >"$folder/expected" <<'END'
#pragma once
/// \file io/thing.h
/// \brief Things of \<io\>, after Yi et al. 2018 and \ref core_map "core/map.h", not core/none.h.
///
/// What it says and declares: \ref io_thing.

/// \defgroup io_thing io/thing.h
/// \ingroup io
///
/// \brief Things of \<io\>, after Yi et al. 2018 and \ref core_map "core/map.h", not core/none.h.
///
/// For \#things x 3.
///
/// \code{.cpp}
///   Thing thing = read("a//b");   // a * b
///
/// \endcode
/// Not for others.

#include "faceprobe/core/map.h"

namespace faceprobe::io {
/// \addtogroup io_thing
/// @{

/// \brief What kind.
///
enum class Kind {
  kOne,  ///< the first
  kTwo,
};

/// plain
struct Thing {

  Image picture;  ///< H x W x 3
  float size_m = 0;
/// \brief Both ways.
///
  static Thing from(int a,
                    int b);
/// \brief Both ways.
///
  static Thing to(int a) {
    // in a body nothing is turned
    return {.size_m = static_cast<float>(a)};  // nor here
  }

 private:
  Image hidden;
};

/// \brief Reads `a * b`, 0 .. 1.
///
/// Throws Error(kInput).
Thing read(const std::string& name = "; // {");
/// \brief Reads `a * b`, 0 .. 1.
///
/// Throws Error(kInput).
Thing read(int number);  ///< too
/// \brief Reads `a * b`, 0 .. 1.
///
/// Throws Error(kInput).
void alone();

/// @}
}
END
filter thing.h >"$folder/found" 2>"$folder/faults"
diff -u "$folder/expected" "$folder/found" || { echo "FAILED: the header is turned into other comments"; failures=$((failures + 1)); }
[ ! -s "$folder/faults" ] || { echo "FAILED: a header that says all has faults:"; cat "$folder/faults"; failures=$((failures + 1)); }

# wanting WHAT LINE...: the declaration of these lines, without a comment, is told that it lacks WHAT; with one it is not.
wanting() {
  local what=$1 output
  shift
  local head=('#pragma once' '// A header.' '//' '//   int use;' '' 'namespace faceprobe {' '') tail=('' '}  // namespace')
  printf '%s\n' "${head[@]}" "$@" "${tail[@]}" >"$folder/faceprobe/io/bare.h"
  output=$(filter bare.h 2>&1 >/dev/null)
  grep -q "bare.h:[0-9]*: .*no comment says $what" <<<"$output" || { echo "FAILED: $* passes: $output"; failures=$((failures + 1)); }
  printf '%s\n' "${head[@]}" '// It is.' "$@" "${tail[@]}" >"$folder/faceprobe/io/bare.h"
  output=$(filter bare.h 2>&1 >/dev/null)
  [ -z "$output" ] || { echo "FAILED: $* with a comment does not pass: $output"; failures=$((failures + 1)); }
}
wanting "what it gives" 'int count(int from);'
wanting "what it gives" 'template <class T>' 'int count(const T& from) { return from.size(); }'
wanting "its shape" 'inline const Eigen::Vector3f kAxis;'
wanting "its unit" 'inline constexpr float kLimit = 3;'
wanting "what it chooses among" 'enum class Way {' '  kOne,' '};'

printf '%s\n' '#pragma once' '// A header.' '//' '//   int use;' '' '// Nothing follows.' '' 'int x;' >"$folder/faceprobe/io/bare.h"
filter bare.h 2>&1 >/dev/null | grep -q "bare.h:6: .*belongs to no declaration" ||
  { echo "FAILED: a comment that nothing follows passes"; failures=$((failures + 1)); }

printf '%s\n' '#pragma once' '// A header without an example.' >"$folder/faceprobe/io/bare.h"
filter bare.h 2>&1 >/dev/null | grep -q "bare.h:1: .*shows how it is used" ||
  { echo "FAILED: a header without an example passes"; failures=$((failures + 1)); }

[ $failures = 0 ] && echo "comments are turned as they should be, and every planted fault was found"
