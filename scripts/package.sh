#!/usr/bin/env bash
# Builds the product and makes its packages: for Debian 12 `faceprobe` and `libfaceprobe-dev`, and a tarball of the command that runs from any
# folder. They come into out/packages, beside SHA256SUMS; what is printed is their sizes and hashes. docs/install.md says what to do with them.
#
#   scripts/package.sh
#   scripts/package.sh --no-build          packs what build/package holds
#   FACEPROBE_PACKAGE_CONTACT="Name <mail@address>" FACEPROBE_PACKAGE_RELEASE=2 scripts/package.sh
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=$root/build/package
out=$root/out/packages
die() { echo "package: $*" >&2; exit 1; }

compile=1
case ${1:-} in
  "") ;;
  --no-build) compile=0 ;;
  -h | --help) sed -n '2,/^set /{/^#/s/^# \{0,1\}//p}' "${BASH_SOURCE[0]}"; exit 0 ;;
  *) echo "unknown option $1; there are --no-build and --help." >&2; exit 2 ;;
esac
for program in dpkg-shlibdeps file; do
  command -v $program >/dev/null || die "$program is not installed; run: apt-get install --no-install-recommends dpkg-dev file"
done

# The changelog's date is the last change's, so that the same sources have the same one.
if [ -z "${SOURCE_DATE_EPOCH:-}" ] && date=$(git -C "$root" log -1 --format=%ct 2>/dev/null); then
  export SOURCE_DATE_EPOCH=$date
fi

if [ $compile = 1 ]; then
  "$root/scripts/setup.sh"
  options=()
  [ -z "${FACEPROBE_PACKAGE_CONTACT:-}" ] || options+=("-DFACEPROBE_PACKAGE_CONTACT=$FACEPROBE_PACKAGE_CONTACT")
  [ -z "${FACEPROBE_PACKAGE_RELEASE:-}" ] || options+=("-DFACEPROBE_PACKAGE_RELEASE=$FACEPROBE_PACKAGE_RELEASE")
  # The prefix decides where Debian wants libraries (lib/x86_64-linux-gnu). The linker's flags are Debian's own: what the loader has resolved
  # cannot be overwritten.
  cmake -S "$root" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DFACEPROBE_UNITY=ON -DCMAKE_INSTALL_PREFIX=/usr \
    -DCMAKE_EXE_LINKER_FLAGS=-Wl,-z,relro,-z,now \
    -DFACEPROBE_BUILD_TESTS=OFF -DFACEPROBE_BUILD_BENCH=OFF -DFACEPROBE_SYNTH=ON -DFACEPROBE_SERVE=ON -DFACEPROBE_TRAIN=OFF \
    -DFACEPROBE_PYTHON=OFF -DFACEPROBE_NATIVE=OFF -DFACEPROBE_SANITIZE= "${options[@]}" >&2
  cmake --build "$build" >&2
fi

rm -rf "$out"
mkdir -p "$out"
cpack --config "$build/CPackConfig.cmake" -B "$out" >&2
rm -rf "$out/_CPack_Packages"

# What the linker asks for, in the package and in the page that tells it to those who take the tarball.
depends=$(dpkg-deb -f "$out"/faceprobe_*.deb Depends | sed 's/([^)]*)//g; s/,/ /g')
[[ $depends != *torch* ]] || die "the command is linked with libtorch: build/package was built for training."
[[ $depends == *libopenimageio* ]] || die "the package does not depend on OpenImageIO; dpkg-shlibdeps found nothing."
for package in $depends; do
  case $package in libc6 | libgcc-s1 | libstdc++6) continue ;; esac  # nobody is without them
  grep -qwF -- "$package" "$root/docs/install.md" || die "the command needs Debian's $package, and docs/install.md does not name it."
done
contents=$(dpkg-deb -c "$out"/faceprobe_*.deb)
[[ $contents == */share/faceprobe/web/index.html* ]] || echo "package: without the page of faceprobe serve." >&2

cd "$out"
sha256sum -- *.deb *.tar.gz >SHA256SUMS
while read -r hash file; do printf '%s  %9d bytes  %s\n' "$hash" "$(stat -c %s "$file")" "$file"; done <SHA256SUMS
