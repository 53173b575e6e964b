#!/bin/sh
# Builds hemilux with warnings as errors and runs its tests: the fast ones, then the slow ones.
# Installs missing Debian packages first. Run it from any folder.
#
#   ./test.sh           all tests: optimised build with assertions
#   ./test.sh --fast    without the slow tests
#   ./test.sh --asan    fast tests under the address and undefined-behaviour sanitizers
#   ./test.sh --tsan    fast tests that use threads under the thread sanitizer
#   ./test.sh --clang   fast tests of a build by clang++
set -eu
cd "$(dirname "$0")"

usage() {
    sed -n '2,10s/^# \{0,1\}//p' "$0"
}
preset=dev
slow=yes
packages=catch2
[ $# -le 1 ] || { usage >&2; exit 1; }
case ${1-} in
'') ;;
--fast) slow=no ;;
--asan) preset=asan slow=no ;;
--tsan) preset=tsan slow=no ;;
--clang) preset=clang slow=no packages="catch2 clang" ;;
-h | --help) usage; exit 0 ;;
*) usage >&2; exit 1 ;;
esac

# shellcheck disable=SC2086  # the list is meant to be split
scripts/install_packages.sh $packages
cores=$(nproc 2>/dev/null || echo 2)
cmake --preset "$preset" >/dev/null
cmake --build --preset "$preset" --parallel "$cores"

if [ $slow = yes ]; then
    ctest --preset "$preset" --parallel "$cores"
else
    ctest --preset "$preset" --label-exclude slow --parallel "$cores"
fi
