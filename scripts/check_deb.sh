#!/bin/sh
# Makes the Debian package of a build folder, installs it in a root that holds the packages that it
# depends on and nothing else, and runs the program there. Needs Debian's packages and root's rights.
#
#   scripts/check_deb.sh [build/release]
set -eu
cd "$(dirname "$0")/.."
build=$(realpath "${1-build/release}")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
root=$work/root

cmake --build "$build" >"$work/log" || { cat "$work/log" >&2; exit 1; }
(cd "$build" && cpack -B "$work" >"$work/log") || { cat "$work/log" >&2; exit 1; }
package=$(ls "$work"/hemilux_*.deb)
dpkg-deb --info "$package"
dpkg-deb --contents "$package"

# The packages that it names, and those that they name.
depends=$(dpkg-deb -f "$package" Depends | sed 's/([^)]*)//g; s/,/ /g; s/|[^ ]*//g')
# shellcheck disable=SC2086  # a list
all=$(apt-cache depends --recurse --no-recommends --no-suggests --no-conflicts --no-breaks \
    --no-replaces --no-enhances $depends | grep '^[a-z]')
mkdir -p "$root/var/lib/dpkg/info" "$root/var/lib/dpkg/updates" "$root/tmp"
: >"$root/var/lib/dpkg/status"
# shellcheck disable=SC2086
(cd "$work" && apt-get download -qq $all)
for file in "$work"/*.deb; do
    [ "$file" = "$package" ] || dpkg-deb --extract "$file" "$root"
done

# Their scripts were not run, so dpkg does not know them.
dpkg --root="$root" --force-depends --install "$package"
cp examples/scenes/cornell_box.obj examples/scenes/cornell_box.mtl "$root/tmp"
chroot "$root" /usr/bin/hemilux --version
chroot "$root" /usr/bin/hemilux solve /tmp/cornell_box.obj -q -o /tmp/a.png -o /tmp/a.csv --size 80x60
[ -s "$root/tmp/a.png" ] && [ -s "$root/tmp/a.csv" ]
for file in man/man1/hemilux.1 bash-completion/completions/hemilux zsh/site-functions/_hemilux \
    fish/vendor_completions.d/hemilux.fish; do
    [ -s "$root/usr/share/$file" ] || { echo "missing: /usr/share/$file" >&2; exit 1; }
done
dpkg --root="$root" --remove hemilux
[ ! -e "$root/usr/bin/hemilux" ]
echo "$(basename "$package") installs, runs and is removed in a clean root"
