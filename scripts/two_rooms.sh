#!/bin/sh
# Writes two_rooms.obj and two_rooms.mtl into the current folder: two sealed cubes of 96 quads each,
# whose floors shine. In the first one, of reflectance 0.05, the floor emits 1 W/m2; in the second
# one, of reflectance 0.95, the floor emits FAINT.
#   two_rooms.sh FAINT
set -eu
[ $# -eq 1 ] || { sed -n '2,5s/^# \{0,1\}//p' "$0" >&2; exit 1; }
material() { printf 'newmtl %s\nKd %s %s %s\nKe %s %s %s\n' "$1" "$2" "$2" "$2" "$3" "$3" "$3"; }
{
    material lamp 0.05 1
    material wall 0.05 0
    material faint_lamp 0.95 "$1"
    material faint_wall 0.95 0
} >two_rooms.mtl
awk '
# A side of 4 x 4 quads on the axis k at height h, fronts towards the middle.
function side(k, h, left, material,    i, j) {
    print "usemtl " material
    for (i = 0; i < 4; ++i)
        for (j = 0; j < 4; ++j) {
            corner(k, h, left, i, j); corner(k, h, left, i + 1, j)
            corner(k, h, left, i + 1, j + 1); corner(k, h, left, i, j + 1)
            print h == 0 ? "f -4 -3 -2 -1" : "f -1 -2 -3 -4"
        }
}
function corner(k, h, left, i, j,    p) {
    p[k] = h; p[(k + 1) % 3] = i / 4; p[(k + 2) % 3] = j / 4
    print "v", left + p[0], p[1], p[2]
}
function room(left, prefix,    k) {
    print "g " prefix "room"
    for (k = 0; k < 3; ++k) {
        side(k, 0, left, prefix (k == 1 ? "lamp" : "wall")) # axis 1 is up: the floor
        side(k, 1, left, prefix "wall")
    }
}
BEGIN { print "mtllib two_rooms.mtl"; room(0, ""); room(2, "faint_") }' >two_rooms.obj
