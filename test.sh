#!/bin/sh
# Builds hemilux with warnings as errors and runs its tests: the fast ones, then the slow ones.
# Installs missing Debian packages first. Run it from any folder.
#
#   ./test.sh           all tests: optimised build with assertions
#   ./test.sh --fast    without the slow tests
#   ./test.sh --asan    fast tests under the address and undefined-behaviour sanitizers
#   ./test.sh --tsan    fast tests that use threads under the thread sanitizer
#   ./test.sh --clang   fast tests of a build by clang++
#   ./test.sh --lesson  the lesson alone: built by emscripten, walked through in headless Chromium, and compared
#                       with the program
#   ./test.sh --lint    no tests: the format (.clang-format), and clang-tidy over src/ (.clang-tidy)
set -eu
cd "$(dirname "$0")"

usage() {
    sed -n '2,13s/^# \{0,1\}//p' "$0"
}
preset=dev
slow=yes
packages="catch2 libopenmpi-dev openmpi-bin libwebp-dev"
# The Python module is tested where these are; they are not asked for where apt-get does not install them.
python_packages="python3-dev pybind11-dev python3-numpy python3-scipy python3-pytest"
[ $# -le 1 ] || { usage >&2; exit 1; }
case ${1-} in
'') ;;
--fast) slow=no ;;
--asan) preset=asan slow=no ;;
--tsan) preset=tsan slow=no ;;
--clang) preset=clang slow=no packages="catch2 clang" ;;
--lesson) packages="" ;;
--lint) preset=tidy packages="clang clang-format clang-tidy" ;;
-h | --help) usage; exit 0 ;;
*) usage >&2; exit 1 ;;
esac

# The module is tested by a Python that has what the tests import: the first of these, or none.
python_for_tests() {
    for python in python3 /usr/bin/python3; do
        if "$python" -c 'import numpy, scipy.sparse, pytest' 2>/dev/null; then
            command -v "$python"
            return
        fi
    done
}

# Other versions of clang-format lay some lines out in another way: 14 where there are several.
lint() {
    format=$(command -v clang-format-14 || command -v clang-format)
    tidy=$(command -v clang-tidy-14 || command -v clang-tidy)
    find src tests bench examples lesson python \( -name '*.cpp' -o -name '*.h' \) -print0 |
        xargs -0 "$format" --dry-run -Werror
    echo "the format is right"
    cmake --preset tidy >/dev/null
    if sed -n 's/^ *"file": "\(.*\/\(src\|Unity\)\/.*\)",\{0,1\}$/\1/p' build/tidy/compile_commands.json |
        tr '\n' '\0' | xargs -0 -P "$cores" -n 1 "$tidy" -p build/tidy --quiet 2>build/tidy/counts.txt
    then
        echo "clang-tidy finds nothing"
    else
        grep -av 'warnings\{0,1\} generated\|treated as error' build/tidy/counts.txt >&2
        exit 1
    fi
}

if [ $preset != dev ] || [ "${1-}" = --lesson ] || ! command -v apt-get >/dev/null; then
    python_packages=
fi
# shellcheck disable=SC2086  # the lists are meant to be split
scripts/install_packages.sh $packages
if [ -n "$python_packages" ]; then
    # shellcheck disable=SC2086
    scripts/install_packages.sh $python_packages || echo "The Python module is not tested."
fi
cores=$(nproc 2>/dev/null || echo 2)
if [ $preset = tidy ]; then
    lint
    exit 0
fi
if [ "${1-}" = --lesson ]; then
    missing=
    for program in em++ node chromium; do
        command -v $program >/dev/null || missing="$missing $program"
    done
    if [ -n "$missing" ]; then
        echo "the lesson is not tested, as these are not found:$missing" >&2
        echo "on Debian: apt install emscripten chromium" >&2
        exit 77
    fi
    scripts/lesson.sh
    cmake --preset "$preset" >/dev/null
    cmake --build --preset "$preset" --parallel "$cores" --target hemilux_program
    exec scripts/check_lesson.sh "build/$preset/hemilux" build/lesson/site
fi
python=
[ $preset != dev ] || python=$(python_for_tests)
cmake --preset "$preset" ${python:+-D HEMILUX_PYTHON=ON -D Python_EXECUTABLE="$python"} >/dev/null
cmake --build --preset "$preset" --parallel "$cores"

if [ $slow = yes ]; then
    # Programs that measure have no tests, but they must not fall behind what they measure.
    cmake --build --preset "$preset" --parallel "$cores" --target bench
    ctest --preset "$preset" --parallel "$cores"
else
    ctest --preset "$preset" --label-exclude slow --parallel "$cores"
fi
