#!/bin/bash
# Draws the folders of src/ as an SVG: the files of each, the includes within it, and an arc for each
# pair of folders of which one includes the other. Arcs on the right lead up the list, to what comes
# before; those that lead down would stand on the left, in red.
#
#   scripts/tree_picture.sh [COMMIT] >docs/images/tree.svg
#
# Folders stand in the order of tests/repository/test_include_direction.cpp, those of a commit without such
# an order in that of the libraries. Kernels count to the folder around them.
set -euo pipefail
cd "$(dirname "$0")/.."
[ "${1-}" != -h ] || { sed -n '2,9s/^# \{0,1\}//p' "$0"; exit 1; }
commit=${1-HEAD}
order=$(git show "$commit:tests/repository/test_include_direction.cpp" | sed -n '/ rooms{/,/};/s/^ *"\(.*\)",$/\1/p')
[ -n "$order" ] || order="geometry bvh radiosity radiosity/strategies radiosity/solvers io app"

{
    git ls-tree -r --name-only "$commit" src | sed 's/^/file /'
    git grep '^ *# *include "' "$commit" -- src | sed 's/^[^:]*:\([^:]*\):[^"]*"\([^"]*\)".*/include \1 src\/\2/'
} | awk -v order="$order" '
function folder_of(path) {
    sub(/^src\//, "", path)
    while (sub(/\/[^\/]*$/, "", path))
        if (path in place) return place[path]
    return -1
}
# The longest way of an include down the list, in rows.
function upward_reach(    i, j, far) {
    for (i = 1; i <= folders; ++i)
        for (j = i + 1; j <= folders; ++j)
            if ((i, j) in includes && j - i > far) far = j - i
    return far + 0
}
BEGIN {
    folders = split(order, name, /[ \n]+/)
    for (i = 1; i <= folders; ++i) place[name[i]] = i
}
$1 == "file" && (i = folder_of($2)) > 0 { ++files[i] }
$1 == "include" && (i = folder_of($2)) > 0 && (j = folder_of($3)) > 0 { ++includes[i, j] }
END {
    row = 22; names = 30 + 8 * upward_reach(); arcs = names + 250
    for (i = 1; i <= folders; ++i) if (files[i] > most) most = files[i]
    printf "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%d\" height=\"%d\" font-family=\"sans-serif\" font-size=\"13\">\n", \
        arcs + 30 + 6 * folders, row * (folders + 2)
    print "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>"
    printf "<text x=\"%d\" y=\"16\" text-anchor=\"end\">files</text>", arcs - 60
    printf "<text x=\"%d\" y=\"16\" text-anchor=\"end\" fill=\"#777\">within</text>\n", arcs - 10
    for (i = 1; i <= folders; ++i) {
        y = row * (i + 1)
        printf "<rect x=\"%d\" y=\"%d\" width=\"%d\" height=\"14\" fill=\"#cfe0f0\"/>\n", names - 12, y - 11, 4 + 150 * files[i] / most
        printf "<text x=\"%d\" y=\"%d\">%s</text>", names - 8, y, name[i]
        printf "<text x=\"%d\" y=\"%d\" text-anchor=\"end\">%d</text>", arcs - 60, y, files[i]
        printf "<text x=\"%d\" y=\"%d\" text-anchor=\"end\" fill=\"#777\">%d</text>\n", arcs - 10, y, includes[i, i]
        for (j = 1; j <= folders; ++j) {
            if (i == j || !((i, j) in includes)) continue
            upward = j > i
            x = upward ? names - 16 : arcs; y2 = row * (j + 1)
            reach = 14 + 8 * (upward ? j - i : i - j)
            printf "<path d=\"M%d,%d C%d,%d %d,%d %d,%d\" fill=\"none\" stroke=\"%s\" stroke-opacity=\".55\" stroke-width=\"%.1f\">", \
                x, y - 4, upward ? x - reach : x + reach, y - 4, upward ? x - reach : x + reach, y2 - 4, x, y2 - 4, \
                upward ? "#c00" : "#358", 0.8 + log(includes[i, j]) / 2
            printf "<title>%s includes %s: %d</title></path>\n", name[i], name[j], includes[i, j]
        }
    }
    print "</svg>"
}'
