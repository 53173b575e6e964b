#!/bin/sh
# Builds hemilux and shows what it is about: the paper's method with its true error, a divided
# hemisphere, error against rays for three methods, and the default solve with its picture.
# Installs missing Debian packages first. Run it from any folder.
set -eu
cd "$(dirname "$0")"

scripts/install_packages.sh
cmake --preset release >/dev/null
cmake --build --preset release --target hemilux_program

scene=examples/scenes/room_1002.obj
out=out/demo
hemilux=build/release/hemilux
mkdir -p "$out"

echo
echo "1. The room by the paper's method, and how far it is from a reference"
$hemilux solve "$scene" --method matrix --error 0.002 -q -o "$out/reference.csv"
$hemilux solve "$scene" --method hemisphere --steps 32 --reference "$out/reference.csv" \
    -o "$out/paper.csv" -o "$out/paper.png"
echo
echo "2. The hemisphere of one patch: surfaces counted in each direction, divided where there are many"
$hemilux density "$scene" -o "$out/hemisphere.svg"
echo
echo "3. Error against rays and run time: the paper's method, random directions, and the default method"
$hemilux compare "$scene" --methods hemisphere,progressive-monte-carlo,stored-transport \
    --reference "$out/reference.csv" --budget-rays 500000 -q -o "$out/compare"
echo
echo "4. The default: as many patches and rays as an error of 5 % of the light on the surfaces takes"
$hemilux solve "$scene" -o "$out/picture.png" -o "$out/mesh.ply" --stats "$out/statistics.json"

cat <<END

Look at
    $PWD/$out/picture.png         the room, lit
    $PWD/$out/hemisphere.svg      a divided hemisphere with its counts
    $PWD/$out/compare/error.svg   error against rays and against time
    $PWD/$out/paper.csv           a row per patch: radiosity and its standard error
    $PWD/$out/mesh.ply            the mesh with its radiosity as vertex colours
    $PWD/$out/statistics.json     rays, seconds, bytes, energy balance
Go on with docs/use/tutorial.md (your own model), docs/paper/reading-guide.md (the paper), $hemilux solve --help
END
