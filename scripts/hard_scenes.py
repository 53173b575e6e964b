#!/usr/bin/env python3
"""Writes scenes whose light is hard to find, as NAME.obj and NAME.mtl, into a folder.

Usage: hard_scenes.py FOLDER
"""
import os
import sys


class Scene:
    """Quads of metres, counter-clockwise from the side that they show."""

    def __init__(self):
        self.vertices, self.faces, self.materials = [], [], {}

    def material(self, name, reflectance, emission=0.0):
        self.materials[name] = (reflectance, emission)
        return name

    def quad(self, material, corners, group="scene"):
        self.vertices += corners
        first = len(self.vertices) - len(corners) + 1
        self.faces.append((group, material, list(range(first, first + len(corners)))))

    def rectangle(self, material, axis, at, low, high, sign, group="scene"):
        """A rectangle across an axis, which shows to the side `sign` of it."""
        u, v = [a for a in range(3) if a != axis]
        corners = []
        for a, b in ((low[0], low[1]), (high[0], low[1]), (high[0], high[1]), (low[0], high[1])):
            corner = [0.0, 0.0, 0.0]
            corner[axis], corner[u], corner[v] = at, a, b
            corners.append(tuple(corner))
        flips = (axis == 1) != (sign < 0)
        self.quad(material, corners[::-1] if flips else corners, group)

    def box(self, material, low, high, inside=False, group="scene", skip=()):
        """The six sides of a box, or its inside; `skip` names sides such as (1, 1): axis, end."""
        for axis in range(3):
            u, v = [a for a in range(3) if a != axis]
            for end in (0, 1):
                if (axis, end) in skip:
                    continue
                sign = (1 if end else -1) * (-1 if inside else 1)
                self.rectangle(material, axis, (high if end else low)[axis],
                               (low[u], low[v]), (high[u], high[v]), sign, group)

    def wall_with_hole(self, material, axis, at, low, high, hole_low, hole_high, sign,
                       group="scene"):
        """A rectangle with a rectangular hole: four rectangles around it."""
        (a0, b0), (a1, b1), (c0, d0), (c1, d1) = low, high, hole_low, hole_high
        for part_low, part_high in (((a0, b0), (c0, b1)), ((c1, b0), (a1, b1)),
                                    ((c0, b0), (c1, d0)), ((c0, d1), (c1, b1))):
            if part_low[0] < part_high[0] and part_low[1] < part_high[1]:
                self.rectangle(material, axis, at, part_low, part_high, sign, group)

    def write(self, folder, name):
        with open(os.path.join(folder, name + ".mtl"), "w") as file:
            for material, (reflectance, emission) in self.materials.items():
                r, e = ([x] * 3 if isinstance(x, (int, float)) else x
                        for x in (reflectance, emission))
                file.write(f"newmtl {material}\nKd {r[0]:g} {r[1]:g} {r[2]:g}\n")
                if any(e):
                    file.write(f"Ke {e[0]:g} {e[1]:g} {e[2]:g}\n")
        with open(os.path.join(folder, name + ".obj"), "w") as file:
            file.write(f"mtllib {name}.mtl\n")
            for v in self.vertices:
                file.write(f"v {v[0]:.9g} {v[1]:.9g} {v[2]:.9g}\n")
            for group, material, face in self.faces:
                file.write(f"g {group}\nusemtl {material}\nf {' '.join(map(str, face))}\n")


def far_lamp(scene, emission, at, half):
    """A small bright square that faces down, as a sun: nearly parallel light."""
    scene.material("sun", 0.0, emission)
    x, y, z = at
    scene.rectangle("sun", 1, y, (x - half, z - half), (x + half, z + half), -1, "sun")


def hut():
    """A closed hut on one ground face; outside it is bright, inside a weak lamp."""
    scene = Scene()
    scene.material("ground", 0.6)
    scene.material("wall", 0.5)
    scene.material("lamp", 0.0, 100.0)
    scene.rectangle("ground", 1, 0.0, (-20, -20), (20, 20), 1)
    scene.box("wall", (-2, 0, -2), (2, 2.5, 2), inside=True, skip=((1, 0),), group="inside")
    scene.box("wall", (-2.1, 0, -2.1), (2.1, 2.6, 2.1), skip=((1, 0),))
    scene.rectangle("lamp", 1, 2.4, (-.2, -.2), (.2, .2), -1)
    far_lamp(scene, 2000.0, (10, 40, 5), 4)
    return scene


def two_rooms():
    """A bright room beside a faint one, closed against each other, on one floor face."""
    scene = Scene()
    scene.material("wall", 0.7)
    scene.material("bright", 0.0, 100.0)
    scene.material("faint", 0.0, 0.5)
    scene.box("wall", (-4, 0, -2), (4, 2.5, 2), inside=True)
    scene.rectangle("wall", 0, -.05, (0, -2), (2.5, 2), -1)
    scene.rectangle("wall", 0, .05, (0, -2), (2.5, 2), 1)
    scene.rectangle("bright", 1, 2.4, (-2.3, -.3), (-1.7, .3), -1)
    scene.rectangle("faint", 1, 2.4, (1.7, -.3), (2.3, .3), -1)
    return scene


def door_ajar():
    """A dark room behind a narrow gap to a bright one."""
    scene = Scene()
    scene.material("wall", 0.7)
    scene.material("lamp", 0.0, 100.0)
    scene.box("wall", (-4, 0, -2), (4, 2.5, 2), inside=True)
    for at, sign in ((-.05, -1), (.05, 1)):
        scene.wall_with_hole("wall", 0, at, (0, -2), (2.5, 2), (0, .5), (2.1, .56), sign)
    scene.rectangle("lamp", 1, 2.4, (-2.3, -.3), (-1.7, .3), -1)
    return scene


def gallery(rooms=6):
    """A row of rooms with small doors; only every third has a lamp."""
    scene = Scene()
    scene.material("wall", 0.75)
    scene.material("lamp", 0.0, 60.0)
    for k in range(rooms):
        x = 4.0 * k
        skip = ((0, 0),) if k > 0 else ()
        skip += ((0, 1),) if k + 1 < rooms else ()
        scene.box("wall", (x + .05, 0, -2), (x + 3.95, 2.5, 2), inside=True, skip=skip)
        if k > 0:
            scene.wall_with_hole("wall", 0, x + .05, (0, -2), (2.5, 2), (0, .2), (2, 1), 1)
        if k + 1 < rooms:
            scene.wall_with_hole("wall", 0, x + 3.95, (0, -2), (2.5, 2), (0, .2), (2, 1), -1)
            scene.box("wall", (x + 3.95, 0, .2), (x + 4.05, 2, 1), inside=True,
                      skip=((0, 0), (0, 1)))
        if k % 3 == 0:
            scene.rectangle("lamp", 1, 2.4, (x + 1.7, -.3), (x + 2.3, .3), -1)
    return scene


def skylight():
    """A hall with a roof of four holes under a far lamp."""
    scene = Scene()
    scene.material("wall", 0.6)
    scene.box("wall", (0, 0, 0), (12, 5, 8), inside=True, skip=((1, 1),))
    for i in range(2):
        for j in range(2):
            low, high = (6 * i, 4 * j), (6 * i + 6, 4 * j + 4)
            hole = (low[0] + 2.7, low[1] + 1.7), (low[0] + 3.3, low[1] + 2.3)
            scene.wall_with_hole("wall", 1, 5.0, low, high, *hole, -1)
            scene.wall_with_hole("wall", 1, 5.1, low, high, *hole, 1)
    far_lamp(scene, 5000.0, (14, 60, 10), 3)
    return scene


def hangar():
    """A large hall with one hole of 0.2 m in its roof."""
    scene = Scene()
    scene.material("wall", 0.6)
    scene.box("wall", (0, 0, 0), (20, 8, 12), inside=True, skip=((1, 1),))
    for at, sign in ((8.0, -1), (8.1, 1)):
        scene.wall_with_hole("wall", 1, at, (0, 0), (20, 12), (9.9, 5.9), (10.1, 6.1), sign)
    far_lamp(scene, 50000.0, (14, 80, 10), 3)
    return scene


def slats():
    """A room whose window is closed by slats."""
    scene = Scene()
    scene.material("wall", 0.7)
    scene.material("slat", 0.5)
    scene.material("outside", 0.0, 30.0)
    scene.box("wall", (0, 0, 0), (5, 3, 4), inside=True, skip=((0, 0),))
    scene.wall_with_hole("wall", 0, 0.0, (0, 0), (3, 4), (1, 1), (2.2, 3), 1)
    for k in range(24):
        y = 1 + .05 * k
        scene.quad("slat", [(-.06, y + .05, 1), (-.06, y + .05, 3), (0, y + .01, 3), (0, y + .01, 1)])
        scene.quad("slat", [(-.06, y + .049, 1), (0, y + .009, 1), (0, y + .009, 3), (-.06, y + .049, 3)])
    scene.rectangle("outside", 0, -3.0, (-2, -3), (5, 7), 1)
    return scene


def sink():
    """A closed room of reflectance 1 with one black panel."""
    scene = Scene()
    scene.material("wall", 1.0)
    scene.material("black", 0.0)
    scene.material("lamp", 0.0, 20.0)
    scene.box("wall", (0, 0, 0), (4, 3, 4), inside=True)
    scene.rectangle("black", 0, .01, (1, 1), (2, 2), 1)
    scene.rectangle("lamp", 1, 2.9, (1.8, 1.8), (2.2, 2.2), -1)
    return scene


def lamp_case():
    """A lamp 5 mm under its case, frames on the walls, boxes on the floor."""
    scene = Scene()
    scene.material("wall", 0.7)
    scene.material("wood", 0.4)
    scene.material("lamp", 0.0, 80.0)
    scene.box("wall", (0, 0, 0), (4, 2.6, 3), inside=True)
    scene.box("wood", (1.5, 2.5, 1.2), (2.5, 2.6, 1.8))
    scene.rectangle("lamp", 1, 2.495, (1.55, 1.25), (2.45, 1.75), -1)
    scene.box("wood", (.5, 1, 0), (1.5, 1.8, .03))
    scene.box("wood", (2.5, 0, .5), (3.2, .8, 1.2))
    scene.box("wood", (.3, 0, 1.8), (1, .4, 2.6))
    return scene


def main():
    folder = sys.argv[1]
    os.makedirs(folder, exist_ok=True)
    for make in (hut, two_rooms, door_ajar, gallery, skylight, hangar, slats, sink, lamp_case):
        make().write(folder, make.__name__)


main()
