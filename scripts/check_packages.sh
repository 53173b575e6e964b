#!/bin/sh
# Makes the packages of a build folder by cpack, unpacks the Debian package into an empty root and the archive into an
# empty folder, and lights a room by the program of each. The archive holds the lesson where it was built.
# scripts/check_deb.sh does the same in a root that has the packages it depends on and nothing else. Exit code 77
# without dpkg-shlibdeps, dpkg-deb or cpack.
#
#   scripts/check_packages.sh [build/release]
set -eu
cd "$(dirname "$0")/.."
for tool in dpkg-shlibdeps dpkg-deb cpack; do
    command -v $tool >/dev/null || exit 77
done
build=$(realpath "${1-build/release}")
scene=$PWD/examples/scenes/cornell_box.obj
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

(cd "$build" && cpack -B "$work" >"$work/log") || { cat "$work/log" >&2; exit 1; }
mkdir "$work/root" "$work/folder"
dpkg-deb --extract "$work"/hemilux_*.deb "$work/root"
tar -xf "$work"/hemilux-*.tar.gz -C "$work/folder"

# lights_a_room PREFIX: the program of a package does, with nothing in the environment.
lights_a_room() {
    (cd "$work" && env -i "$1/bin/hemilux" solve "$scene" -q --size 80x60 --error 20% -o picture.png)
    [ -s "$work/picture.png" ] && rm "$work/picture.png"
    if [ -e build/lesson/site/index.html ]; then
        cmp build/lesson/site/index.html "$1/share/doc/hemilux/lesson/index.html"
    fi
}
lights_a_room "$work/root/usr"
lights_a_room "$(dirname "$(dirname "$(ls "$work"/folder/hemilux-*/bin/hemilux)")")"
echo "the programs of the packages run"
