#!/bin/sh
# Builds the lesson, a site of pages that run the paper's methods in a browser, in build/lesson/site:
#
#   scripts/lesson.sh            Debian: apt install emscripten libglm-dev
#
# Open build/lesson/site/index.html: from the disk, or from any server of files. Exit code 77 where there
# is no emscripten.
set -eu
[ $# -eq 0 ] || { sed -n '2,7s/^# \{0,1\}//p' "$0" >&2; exit 1; }
cd "$(dirname "$0")/.."
if ! command -v em++ >/dev/null || ! command -v node >/dev/null; then
    echo "the lesson needs emscripten, to compile the library for browsers: apt install emscripten" >&2
    exit 77
fi
build=$PWD/build/lesson
glm=$(find /usr/lib /usr/share -name glmConfig.cmake 2>/dev/null | head -1)
[ -n "$glm" ] || { echo "the lesson needs GLM: apt install libglm-dev" >&2; exit 77; }
# GLM in a folder of its own: beside it in /usr/include lie headers of this system.
glm=$(dirname "$glm")
mkdir -p "$build/glm$glm" "$build/glm/usr/include"
cp "$glm"/*.cmake "$build/glm$glm"
cp -r /usr/include/glm "$build/glm/usr/include"
# em++ minifies with a module of Debian's, which no other node looks for there.
export NODE_PATH="${NODE_PATH:+$NODE_PATH:}/usr/share/nodejs"
launcher=
if command -v ccache >/dev/null; then launcher=-DCMAKE_CXX_COMPILER_LAUNCHER=ccache; fi
cmake -S lesson -B "$build" -DCMAKE_BUILD_TYPE=Release -Dglm_DIR="$build/glm$glm" $launcher \
    -DHEMILUX_WARNINGS_AS_ERRORS=ON \
    -DCMAKE_TOOLCHAIN_FILE="$(em-config EMSCRIPTEN_ROOT)/cmake/Modules/Platform/Emscripten.cmake" >/dev/null
cmake --build "$build" --parallel "$(nproc 2>/dev/null || echo 2)"
rm -rf "$build/site"
cp -r lesson/site "$build/site"
cp "$build/hemilux.js" "$build/site"
# A scene of the examples, in the form of a script, as a page from the disk can read no other file.
{
    printf 'rooms.files = { room_1002: { obj: `'
    cat examples/scenes/room_1002.obj
    printf '`, mtl: `'
    cat examples/scenes/room_1002.mtl
    printf '` } };\n'
} >"$build/site/examples.js"
# The page loads a script for each chapter that there is.
scripts=$(find lesson/site/chapters -name '*.js' | sed 's,.*/\(.*\)\.js,\1,' | sort -n |
    sed 's,.*,<script src="chapters/&.js"></script>,')
awk -v scripts="$scripts" '{ print $0 == "<!-- chapters -->" ? scripts : $0 }' lesson/site/index.html >"$build/site/index.html"
