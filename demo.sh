#!/bin/sh
# Builds hemilux, solves a Cornell box of about 1000 patches and says where the results are.
# Installs missing Debian packages first. Run it from any folder.
set -eu
cd "$(dirname "$0")"

scripts/install_packages.sh
cmake --preset release >/dev/null
cmake --build --preset release --target hemilux_program

scene=examples/scenes/cornell_box.obj
out=out/demo
mkdir -p "$out"
echo
echo "Solving $scene"
build/release/hemilux solve "$scene" --error .005 \
    -o "$out/picture.png" -o "$out/patches.csv" -o "$out/mesh.ply" \
    --stats "$out/statistics.json" --steps-log "$out/steps.csv"

cat <<END

Look at
    $PWD/$out/picture.png       the room, lit
    $PWD/$out/mesh.ply          the mesh with its radiosity as vertex colours
    $PWD/$out/patches.csv       a row per patch: radiosity and its standard error
    $PWD/$out/steps.csv         how the error fell from step to step
    $PWD/$out/statistics.json   rays, seconds, bytes, energy balance
Go on with: build/release/hemilux solve --help
END
