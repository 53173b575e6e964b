#!/bin/sh
# The first program (cmake/FirstProgram.cmake) gives the bytes of the whole one, and says how to come by what it lacks.
#
#   scripts/check_first_program.sh build/release/first/hemilux build/release/hemilux
set -eu
first=$(realpath "$1") whole=$(realpath "$2")
scene=$(realpath "$(dirname "$0")/../examples/scenes/cornell_box.obj")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# results FOLDER PROGRAM
results() {
    mkdir "$work/$1"
    cd "$work/$1"
    "$2" solve "$scene" -q --size 80x60 --error 20% -o picture.png -o table.csv -o mesh.glb
    "$2" bake "$scene" -q --lightmap 256 --error 20% -o baked.obj
    "$2" info "$scene" >info.txt
}
results first "$first"
results whole "$whole"
diff -r "$work/first" "$work/whole"

# asks_for_the_rest ARGUMENT...
asks_for_the_rest() {
    code=0
    "$first" "$@" 2>"$work/message" || code=$?
    [ "$code" -eq 1 ] && grep -q "demo.sh builds the whole" "$work/message"
}
asks_for_the_rest compare "$scene"
asks_for_the_rest solve "$scene" --method matrix
echo "the first program gives the bytes of the whole one"
