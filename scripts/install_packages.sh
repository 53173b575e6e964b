#!/bin/sh
# Installs what building hemilux needs and is missing, then the packages named as arguments.
# On Debian and its derivatives by apt-get, with sudo where the user is not root; elsewhere it
# names what is missing and exits with 1.
set -eu

# What a package brings, so that a system without dpkg can be looked through as well.
brings() {
    case $1 in
    g++) command -v g++ ;;
    cmake) command -v cmake ;;
    ninja-build) command -v ninja ;;
    clang) command -v clang++ ;;
    clang-format) command -v clang-format-14 || command -v clang-format ;;
    clang-tidy) command -v clang-tidy-14 || command -v clang-tidy ;;
    libglm-dev) header glm/glm.hpp ;;
    libstb-dev) header stb/stb_image_write.h || header stb_image_write.h ;;
    libcli11-dev) header CLI/CLI.hpp ;;
    nlohmann-json3-dev) header nlohmann/json.hpp ;;
    libwebp-dev) header webp/decode.h ;;
    libopenmpi-dev) command -v mpicxx ;;
    openmpi-bin) command -v mpirun ;;
    catch2) header catch2/catch.hpp || header catch2/catch_test_macros.hpp ;;
    python3-dev) any_header 'python3*/Python.h' ;;
    pybind11-dev) header pybind11/pybind11.h ;;
    python3-numpy) module numpy ;;
    python3-scipy) module scipy.sparse ;;
    python3-pytest) module pytest ;;
    *) return 1 ;;
    esac
}
any_header() { for file in /usr/include/$1 /usr/local/include/$1; do [ ! -e "$file" ] || return 0; done; return 1; }
module() { python3 -c "import $1" || /usr/bin/python3 -c "import $1"; }
header() { [ -e "/usr/include/$1" ] || [ -e "/usr/local/include/$1" ] || [ -e "/opt/homebrew/include/$1" ]; }

missing=""
for package in g++ cmake ninja-build libglm-dev libstb-dev libcli11-dev nlohmann-json3-dev "$@"; do
    brings "$package" >/dev/null 2>&1 || missing="$missing $package"
done
[ -n "$missing" ] || exit 0

if ! command -v apt-get >/dev/null 2>&1; then
    echo "missing (named as Debian's packages):$missing" >&2
    echo "Please install them with your system's package manager and run this again." >&2
    exit 1
fi
as_root=""
if [ "$(id -u)" -ne 0 ]; then
    if ! command -v sudo >/dev/null 2>&1; then
        echo "missing packages:$missing; as root run: apt-get install$missing" >&2
        exit 1
    fi
    as_root=sudo
fi
echo "installing$missing" >&2
# shellcheck disable=SC2086  # the lists are meant to be split
{
    $as_root apt-get update -qq
    $as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends $missing
} </dev/null >&2
