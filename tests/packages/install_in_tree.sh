#!/usr/bin/env bash
# Installs a package into a fresh Debian 12, runs what it brought as a user without rights or network, and removes it again. Takes minutes and
# needs root and a Debian mirror, so that it is not among the tests that ctest runs; without them it exits with 77.
#
#   tests/packages/install_in_tree.sh FACEPROBE.deb
#   tests/packages/install_in_tree.sh FACEPROBE.deb LIBFACEPROBE_DEV.deb      also builds tests/consumer on the second, with CMake and pkg-config
#   TREE=FOLDER tests/packages/install_in_tree.sh ...                         keeps the fresh Debian there, and takes it from there the next time
#   PHOTO=FILE tests/packages/install_in_tree.sh ...                          a photo of a face; else the sample of scripts/setup.sh
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
suite=bookworm
photo=${PHOTO:-$root/.deps/data/samples/grace_hopper.jpg}

skip() { echo "skipped: $*" >&2; exit 77; }
die() { echo "FAILED: $*" >&2; exit 1; }
step() { printf '== %s\n' "$*"; }

[ $# = 1 ] || [ $# = 2 ] || { sed -n '2,/^set /{/^#/s/^# \{0,1\}//p}' "${BASH_SOURCE[0]}" >&2; exit 2; }
for file in "$@" "$photo"; do [ -f "$file" ] || { echo "there is no file $file." >&2; exit 2; }; done
[ "$(id -u)" = 0 ] || skip "this needs root"
for program in debootstrap unshare; do command -v $program >/dev/null || skip "$program is not installed"; done

# What is mounted below goes away with this process, however it ends.
if [ -z "${FACEPROBE_IN_NAMESPACE:-}" ]; then
  unshare --mount true 2>/dev/null || skip "mount namespaces are not allowed here"
  FACEPROBE_IN_NAMESPACE=1 exec unshare --mount --propagation private bash "${BASH_SOURCE[0]}" "$@"
fi

# The mirror of this machine's own apt.
mirror=$(apt-get indextargets --format '$(SITE) $(CODENAME) $(CREATED_BY)' 2>/dev/null |
         awk -v suite=$suite '$2 == suite && $3 == "Packages" { print $1; exit }')
[ -n "$mirror" ] || skip "apt knows no mirror of Debian $suite; apt-get update may help"

folder=$(mktemp -d)
trap 'umount "$folder/tree/proc" "$folder/tree/dev" 2>/dev/null || true; rm -rf --one-file-system "$folder"' EXIT
fresh=${TREE:-$folder/fresh}
if [ ! -f "$fresh/etc/debian_version" ]; then
  step "a fresh Debian $suite from $mirror"
  debootstrap --variant=minbase $suite "$fresh" "$mirror" >"$folder/debootstrap.log" 2>&1 || {
    tail -n 5 "$folder/debootstrap.log" >&2
    rm -rf --one-file-system "$fresh"
    skip "debootstrap found no Debian $suite at $mirror"
  }
fi

tree=$folder/tree
cp -a "$fresh" "$tree"
[ ! -f /etc/resolv.conf ] || cp -L /etc/resolv.conf "$tree/etc/resolv.conf"
[ ! -f /etc/hosts ] || cp -L /etc/hosts "$tree/etc/hosts"
mount -t proc proc "$tree/proc"
mount --bind /dev "$tree/dev"
inside() { chroot "$tree" /usr/bin/env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin LC_ALL=C.UTF-8 DEBIAN_FRONTEND=noninteractive HOME=/nowhere "$@"; }
quietly() { "$@" >"$folder/log" 2>&1 || { tail -n 30 "$folder/log" >&2; die "$*"; }; }

# As a user without rights, in a network namespace that has not even a loopback.
as_user() {
  unshare --net chroot --userspec=65534:65534 "$tree" /usr/bin/env -i PATH=/usr/bin:/bin LC_ALL=C.UTF-8 HOME=/photos/home "$@"
}
# expect CODE COMMAND...
expect() {
  local wanted=$1 code=0
  shift
  as_user "$@" >"$folder/stdout" 2>"$folder/stderr" || code=$?
  [ $code = "$wanted" ] || { cat "$folder/stdout" "$folder/stderr" >&2; die "'$*' ended with $code, not $wanted"; }
}

mkdir -p "$tree/packages" "$tree/photos/home"
cp "$@" "$tree/packages/"
cp "$photo" "$tree/photos/face.jpg"
chmod 755 "$tree/packages" "$tree/photos"
chmod 644 "$tree"/packages/* "$tree/photos/face.jpg"
chown -R 65534:65534 "$tree/photos"
main=/packages/$(basename "$1")

step "apt-get install $(basename "$1")"
quietly inside apt-get update
quietly inside apt-get install -y --no-install-recommends "$main"
inside dpkg-query -L faceprobe >"$folder/listed"
inside dpkg-query -W -f '${Package} ${Version} ${Installed-Size} KiB\n' faceprobe
echo "packages that came along: $(inside sh -c "dpkg-query -W | wc -l" | awk -v before="$(chroot "$fresh" dpkg-query -W | wc -l)" '{print $1 - before - 1}')"
if inside ldd /usr/bin/faceprobe | grep "not found"; then die "a library is missing"; fi
quietly inside dpkg --verify faceprobe

step "what is in it"
for path in /usr/bin/faceprobe /usr/share/doc/faceprobe/copyright /usr/share/man/man1/faceprobe.1.gz; do
  grep -qxF "$path" "$folder/listed" || die "the package has no $path"
done
gzip -dc "$tree/usr/share/man/man1/faceprobe.1.gz" >"$folder/page"
grep -q '^\.TH ' "$folder/page" || die "the manual page is none"
if awk '/\.so(\.|$)/' "$folder/listed" | grep -v '/faceprobe/'; then die "a private library lies in a public folder"; fi

step "what it does"
expect 0 faceprobe --version
version=$(cat "$folder/stdout")
[[ $(inside dpkg-query -W -f '${Version}' faceprobe) == "$version"-* ]] || die "the package's version is not the command's, $version"
expect 0 faceprobe doctor
cat "$folder/stdout"
start=$SECONDS
expect 0 faceprobe estimate /photos/face.jpg -o /photos/light
echo "estimate: $((SECONDS - start)) s"
for name in environment.exr environment.hdr environment.png report.json overview.png; do
  [ -s "$tree/photos/light/$name" ] || die "estimate wrote no $name"
done
expect 3 faceprobe estimate /photos/light/report.json -o /photos/none
grep -qxF /usr/share/faceprobe/web/index.html "$folder/listed" || die "the page of faceprobe serve is not there"
grep -q '^ok .*page: /usr/share/faceprobe/web/index.html' <(as_user faceprobe doctor) || die "faceprobe doctor does not find the page"
for verb in estimate insert serve; do
  grep -qxF "/usr/share/man/man1/faceprobe-$verb.1.gz" "$folder/listed" || die "there is no manual page of $verb"
done

if [ $# = 2 ]; then
  step "apt-get install $(basename "$2")"
  quietly inside apt-get install -y --no-install-recommends "/packages/$(basename "$2")" g++ cmake make
  cp -r "$root/tests/consumer/project" "$tree/photos/project"
  chown -R 65534:65534 "$tree/photos/project"
  step "a project by CMake"
  expect 0 cmake -S /photos/project -B /photos/cmake -DCMAKE_BUILD_TYPE=Release
  expect 0 cmake --build /photos/cmake
  expect 0 /usr/bin/env FACEPROBE_DATA_DIR=/usr/share/faceprobe /photos/cmake/consumer /photos/face.jpg
  cat "$folder/stdout"
  step "a project by pkg-config"
  expect 0 sh -c 'g++ -std=c++20 /photos/project/main.cpp $(pkg-config --cflags --libs faceprobe) -o /photos/by_pkg_config'
  expect 0 /usr/bin/env FACEPROBE_DATA_DIR=/usr/share/faceprobe /photos/by_pkg_config /photos/face.jpg
  cat "$folder/stdout"
  quietly inside apt-get purge -y libfaceprobe-dev
fi

step "apt-get purge faceprobe"
quietly inside apt-get purge -y faceprobe
if inside dpkg-query -W -f '${db:Status-Status}' faceprobe 2>/dev/null | grep .; then die "dpkg still knows it"; fi
# Folders that are shared with others stay; files and folders of ours may not.
left=$(cd "$tree" && find . -xdev -path ./photos -prune -o -path ./packages -prune -o -path ./proc -prune -o -path ./dev -prune -o \
       -path ./var/log -prune -o -iname '*faceprobe*' -print)
[ -z "$left" ] || die "purge left: $left"
while IFS= read -r path; do
  if [ -e "$tree$path" ] && [ ! -d "$tree$path" ]; then die "purge left $path"; fi
done <"$folder/listed"
echo "installed, used and removed"
