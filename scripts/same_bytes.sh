#!/bin/sh
# Whether two builds of the program find the same bytes: the patch tables of all methods in the
# example scenes, seed 1, a few rays. For changes that should change no result.
#
#   scripts/same_bytes.sh OLD NEW [SCENE.obj ...]
#
# OLD and NEW are programs. Ends with 1 where a table differs, and names method and scene.
set -eu
[ $# -ge 2 ] || { sed -n '2,7s/^# \{0,1\}//p' "$0" >&2; exit 1; }
old_program=$(command -v "$1") new_program=$(command -v "$2")
shift 2
here=$(cd "$(dirname "$0")/.." && pwd)
[ $# -gt 0 ] || set -- "$here"/examples/scenes/*.obj
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
methods=$("$old_program" solve --help | sed -n '/^Methods/,/^$/s/^  \([a-z0-9 -]*\)$/\1/p')

differ=0
for scene in "$@"; do
    for method in $methods; do
        case $method in
        matrix) size="--rays 16 --steps 1" ;;
        *) size="--rays 32 --steps 3" ;;
        esac
        for build in old new; do
            program=$old_program
            [ $build = old ] || program=$new_program
            # shellcheck disable=SC2086  # the list is meant to be split
            "$program" solve "$scene" --method "$method" --seed 1 $size -o "$folder/$build.csv" \
                2>"$folder/$build.txt" || echo "exit code $?" >"$folder/$build.csv"
        done
        if ! cmp -s "$folder/old.csv" "$folder/new.csv"; then
            echo "$method differs in $(basename "$scene")"
            differ=1
        fi
    done
done
[ $differ = 1 ] || echo "the same bytes for $(echo "$methods" | wc -w) methods in $# scenes"
exit $differ
