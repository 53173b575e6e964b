#!/bin/sh
# Shows what hemilux is about: a room lit by the default method, then the paper's method with its true
# error, a divided hemisphere, and error against rays for three methods. Run it from any folder.
#
# Where an archive of cpack is unpacked here or beside this folder, it takes hemilux-*/bin/hemilux. Else it
# compiles what a picture needs, draws the room, and compiles the rest: build/release/hemilux. Installs
# missing Debian packages first.
set -eu
cd "$(dirname "$0")"

scene=examples/scenes/room_1002.obj
out=out/demo
hemilux=
for packaged in hemilux-*/bin/hemilux ../hemilux-*/bin/hemilux; do
    [ ! -x "$packaged" ] || hemilux=$packaged
done
mkdir -p "$out"

# compile WHAT SECONDS FILE TARGET: compiles a target, and says before how long it takes where FILE, which comes of it,
# is not there. SECONDS are of a processor.
compile() {
    cores=$(nproc 2>/dev/null || echo 2)
    [ -e "build/release/$3" ] || echo "Compiling $1: about $(($2 / cores)) s where $cores cores have nothing else to do"
    cmake --build --preset release --parallel "$cores" --target "$4"
}

if [ -n "$hemilux" ]; then
    echo "Taking $hemilux, so nothing is compiled"
    first=$hemilux
else
    scripts/install_packages.sh
    cmake --preset release >/dev/null
    compile "what a picture needs" 160 first/hemilux hemilux_first
    hemilux=build/release/hemilux
    first=build/release/first/hemilux
    # Until the rest is there.
    [ -e $hemilux ] || cp $first $hemilux
fi

echo
echo "1. A model, lit, and how far the light of its picture is off: hemilux MODEL"
$first "$scene" -o "$out/picture.png" --stats "$out/statistics.json"
echo
echo "The room, lit: $PWD/$out/picture.png"
echo
if [ "$first" != "$hemilux" ]; then
    compile "the rest" 90 libhemilux_app.a hemilux_program
    echo
fi
echo "2. The room by the paper's method, and how far it is from a reference"
$hemilux solve "$scene" --method matrix --error 0.002 -q -o "$out/reference.csv"
$hemilux solve "$scene" --method hemisphere --steps 32 --reference "$out/reference.csv" \
    -o "$out/paper.csv" -o "$out/paper.png"
echo
echo "3. The hemisphere of one patch: surfaces counted in each direction, divided where there are many"
$hemilux density "$scene" -o "$out/hemisphere.svg"
echo
echo "4. Error against rays and run time: the paper's method, random directions, and the default method"
$hemilux compare "$scene" --methods hemisphere,progressive-monte-carlo,stored-transport \
    --reference "$out/reference.csv" --budget-rays 500000 -q -o "$out/compare"

cat <<END

Look at
    $PWD/$out/picture.png         the room, lit
    $PWD/$out/hemisphere.svg      a divided hemisphere with its counts
    $PWD/$out/compare/error.svg   error against rays and against time
    $PWD/$out/paper.csv           a row per patch: radiosity and its standard error
    $PWD/$out/statistics.json     rays, seconds, bytes, energy balance
Go on with docs/use/tutorial.md (your own model), docs/paper/reading-guide.md (the paper), $hemilux solve --help
END
