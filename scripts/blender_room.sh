#!/bin/sh
# Writes room.obj and room.mtl into the current folder, laid out as Blender's exporter does: a cube
# as room, a plane as lamp below its ceiling, a sphere on the floor. y is up.
#   blender_room.sh [modelled|right|reversed|half [SEED]]
# modelled: as Blender makes them, the cube's faces outwards and the plane's upwards (the default);
# right: towards the light; reversed: all faces the other way than modelled; half: a random half.
set -eu
awk -v facing="${1:-modelled}" -v seed="${2:-1}" '
function vertex(x, y, z) { px[++count] = x; py[count] = y; pz[count] = z
                           printf "v %.6f %.6f %.6f\n", x, y, z }
function random() { seed = (seed * 16807) % 2147483647; return seed / 2147483647 }
# Starts an object; whether it looks away from the light as modelled.
function object(name, its_material, looks_away) {
    print "o " name; material = its_material; away = looks_away; base = count; faces = 0 }
# Four corners counted from 1 within the object, or three and a 0.
function face(a, b, c, d) { corner[++faces] = a " " b " " c (d ? " " d : "") }
function write_faces(   i, k, n, v, turned, line) {
    for (i = 1; i <= faces; ++i) {
        n = split(corner[i], v, " ")
        turned = facing == "reversed" || facing == "right" && away || facing == "half" && random() < .5
        line = "f"
        for (k = 1; k <= n; ++k)
            line = line " " base + v[turned ? n + 1 - k : k] "/" texture + 1 + k % 2 "/" normals + i
        lines[i] = line
        k = turned ? -1 : 1
        for (n = 1; n <= 3; ++n) p[n] = base + v[n]
        ux = px[p[2]] - px[p[1]]; uy = py[p[2]] - py[p[1]]; uz = pz[p[2]] - pz[p[1]]
        wx = px[p[3]] - px[p[2]]; wy = py[p[3]] - py[p[2]]; wz = pz[p[3]] - pz[p[2]]
        nx = uy * wz - uz * wy; ny = uz * wx - ux * wz; nz = ux * wy - uy * wx
        k /= sqrt(nx * nx + ny * ny + nz * nz)
        printf "vn %.4f %.4f %.4f\n", k * nx, k * ny, k * nz
    }
    print "vt 0.000000 0.000000\nvt 1.000000 1.000000\ns 0\nusemtl " material
    for (i = 1; i <= faces; ++i) print lines[i]
    normals += faces; texture += 2
}
BEGIN {
    if (facing !~ /^(modelled|right|reversed|half)$/) {
        print "blender_room.sh: modelled, right, reversed or half [SEED]" > "/dev/stderr"; exit 1 }
    print "mtllib room.mtl"
    object("Cube", "Wall", 1)
    for (i = 0; i < 8; ++i) vertex(i < 4 ? 1 : -1, i % 2 ? -1 : 1, i % 4 < 2 ? -1 : 1)
    face(1, 5, 7, 3); face(4, 3, 7, 8); face(8, 7, 5, 6)
    face(6, 2, 4, 8); face(2, 1, 3, 4); face(6, 5, 1, 2)
    write_faces()
    object("Plane", "Lamp", 1)
    vertex(-.3, .98, .3); vertex(.3, .98, .3); vertex(-.3, .98, -.3); vertex(.3, .98, -.3)
    face(1, 2, 4, 3)
    write_faces()
    object("Sphere", "Clay", 0)
    rings = 6; segments = 10; pi = atan2(0, -1)
    vertex(-.3, -.15, .2); vertex(-.3, -.95, .2)
    for (i = 1; i < rings; ++i)
        for (k = 0; k < segments; ++k)
            vertex(-.3 + .4 * sin(pi * i / rings) * cos(2 * pi * k / segments),
                   -.55 + .4 * cos(pi * i / rings),
                   .2 - .4 * sin(pi * i / rings) * sin(2 * pi * k / segments))
    for (k = 0; k < segments; ++k) {
        a = 3 + k; b = 3 + (k + 1) % segments; last = (rings - 2) * segments
        face(1, a, b, 0)
        for (i = 0; i < last; i += segments) face(a + i, a + i + segments, b + i + segments, b + i)
        face(2, b + last, a + last, 0)
    }
    write_faces()
}' > room.obj
cat > room.mtl <<'END'
newmtl Wall
Ns 250.000000
Ka 1.000000 1.000000 1.000000
Kd 0.700000 0.700000 0.700000
Ks 0.500000 0.500000 0.500000
Ke 0.000000 0.000000 0.000000
illum 2

newmtl Lamp
Kd 0.000000 0.000000 0.000000
Ke 10.000000 9.000000 8.000000
illum 2

newmtl Clay
Kd 0.800000 0.400000 0.200000
Ke 0.000000 0.000000 0.000000
illum 2
END
