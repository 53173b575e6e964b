#!/usr/bin/env python3
"""Writes a room as a modelling program exports it: a .glb of many objects in a tree of empties, with
textures, two sets of texture coordinates (the second for a lightmap), a camera, an animation and
extras that nobody knows.

    scripts/artist_room.py room.glb [--boxes 100] [--coordinates two|one|overlapping]

two: TEXCOORD_1 has places of its own for all faces; one: there is no second set; overlapping: all
objects have the whole square.
"""
import argparse
import json
import math
import random
import struct
import zlib


def png(width, height, pixel):
    rows = b"".join(b"\0" + b"".join(bytes(pixel(x, y)) for x in range(width)) for y in range(height))

    def chunk(kind, data):
        body = kind + data
        return struct.pack(">I", len(data)) + body + struct.pack(">I", zlib.crc32(body))

    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0))
            + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


class File:
    def __init__(self):
        self.binary, self.views, self.accessors = b"", [], []

    def view(self, data, **more):
        self.views.append({"buffer": 0, "byteOffset": len(self.binary), "byteLength": len(data), **more})
        self.binary += data + b"\0" * (-len(data) % 4)
        return len(self.views) - 1

    def floats(self, rows, kind, target=34962, bounds=False):
        entry = {"bufferView": self.view(b"".join(struct.pack(f"<{len(r)}f", *r) for r in rows),
                                         **({"target": target} if target else {})),
                 "componentType": 5126, "count": len(rows), "type": kind}
        if bounds:
            rounded = [struct.unpack(f"<{len(r)}f", struct.pack(f"<{len(r)}f", *r)) for r in rows]
            entry["min"] = [min(c) for c in zip(*rounded)]
            entry["max"] = [max(c) for c in zip(*rounded)]
        self.accessors.append(entry)
        return len(self.accessors) - 1

    def indices(self, numbers):
        self.accessors.append({"bufferView": self.view(struct.pack(f"<{len(numbers)}H", *numbers), target=34963),
                               "componentType": 5123, "count": len(numbers), "type": "SCALAR"})
        return len(self.accessors) - 1


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("output")
    parser.add_argument("--boxes", type=int, default=100)
    parser.add_argument("--coordinates", choices=["two", "one", "overlapping"], default="two")
    asked = parser.parse_args()
    rng, file = random.Random(1), File()
    faces_in_all = 6 * (asked.boxes + 1) + 1
    # The six faces of the room have half of the square, three by two of them.
    rows = math.ceil(math.sqrt(6 * asked.boxes + 1) / math.sqrt(2)) or 1
    columns = math.ceil((6 * asked.boxes + 1) / rows)

    def cell(face):
        if face < 6:
            x, y, w, h = face % 3 / 3, face // 3 * .25, 1 / 3, .25
        else:
            w, h = 1 / columns, .5 / rows
            x, y = (face - 6) % columns * w, .5 + (face - 6) // columns * h
        gap = .004
        return x + gap, y + gap, w - 2 * gap, h - 2 * gap

    face_number = 0
    meshes, nodes, materials = [], [], []
    for k in range(16):
        base = [.2 + .6 * rng.random() for _ in range(3)] + [1]
        materials.append({"name": f"paint.{k:03}", "doubleSided": k % 4 == 0,
                          "pbrMetallicRoughness": {"baseColorFactor": base, "metallicFactor": 0}})
        if k < 4:
            materials[-1]["pbrMetallicRoughness"]["baseColorTexture"] = {"index": k}
    materials.append({"name": "lamp", "emissiveFactor": [1, 1, 1],
                      "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 20}},
                      "pbrMetallicRoughness": {"baseColorFactor": [0, 0, 0, 1], "metallicFactor": 0}})

    def mesh(name, quads, material):
        nonlocal face_number
        points, normals, first, second, index = [], [], [], [], []
        for corners in quads:
            a, b, c = corners[:3]
            u, v = [b[i] - a[i] for i in range(3)], [c[i] - b[i] for i in range(3)]
            n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
            length = math.sqrt(sum(x * x for x in n))
            start = len(points)
            points += corners
            normals += [[x / length for x in n]] * 4
            first += [(0, 1), (1, 1), (1, 0), (0, 0)]
            x, y, w, h = (0, 0, 1, 1) if asked.coordinates == "overlapping" else cell(face_number)
            second += [(x, y + h), (x + w, y + h), (x + w, y), (x, y)]
            index += [start, start + 1, start + 2, start, start + 2, start + 3]
            face_number += 1
        attributes = {"POSITION": file.floats(points, "VEC3", bounds=True), "NORMAL": file.floats(normals, "VEC3"),
                      "TEXCOORD_0": file.floats(first, "VEC2")}
        if asked.coordinates != "one":
            attributes["TEXCOORD_1"] = file.floats(second, "VEC2")
        meshes.append({"name": name, "primitives": [
            {"attributes": attributes, "indices": file.indices(index), "material": material}]})
        return len(meshes) - 1

    def box(low, high, inward=False):
        (x0, y0, z0), (x1, y1, z1) = low, high
        quads = [[(x0, y0, z1), (x1, y0, z1), (x1, y1, z1), (x0, y1, z1)],
                 [(x1, y0, z0), (x0, y0, z0), (x0, y1, z0), (x1, y1, z0)],
                 [(x1, y0, z1), (x1, y0, z0), (x1, y1, z0), (x1, y1, z1)],
                 [(x0, y0, z0), (x0, y0, z1), (x0, y1, z1), (x0, y1, z0)],
                 [(x0, y1, z1), (x1, y1, z1), (x1, y1, z0), (x0, y1, z0)],
                 [(x0, y0, z0), (x1, y0, z0), (x1, y0, z1), (x0, y0, z1)]]
        return [q[::-1] for q in quads] if inward else quads

    shelves = []
    nodes.append({"name": "room", "mesh": mesh("room", box((-4, 0, -3), (4, 3, 3), inward=True), 0)})
    for s in range(10):
        shelves.append({"name": f"shelf.{s:03}", "translation": [-3.5 + .75 * s, 0, 0],
                        "rotation": [0, math.sin(.05 * s), 0, math.cos(.05 * s)], "children": []})
    nodes += shelves
    for k in range(asked.boxes):
        w, h, d = (.15 + .3 * rng.random() for _ in range(3))
        nodes.append({"name": f"box.{k:03}", "mesh": mesh(f"cube.{k:03}", box((-w / 2, 0, -d / 2), (w / 2, h, d / 2)),
                                                          1 + k % 15),
                      "translation": [.2 * rng.random() - .1, 0, -2.6 + .55 * (k // 10)],
                      "extras": {"bought": 1990 + k}})
        shelves[k % 10]["children"].append(len(nodes) - 1)
    nodes.append({"name": "lamp", "mesh": mesh("lamp", [[(-1, 2.95, -1), (1, 2.95, -1), (1, 2.95, 1), (-1, 2.95, 1)]], 16)})
    lamp = len(nodes) - 1
    nodes.append({"name": "eye", "camera": 0, "translation": [0, 1.6, 2.8]})
    assert face_number == faces_in_all
    images = [{"name": f"boards.{k}", "mimeType": "image/png",
               "bufferView": file.view(png(8, 8, lambda x, y, k=k: (255, 200 - 20 * ((x + k) % 3), 160 + 8 * y)))}
              for k in range(4)]
    times, places = file.floats([(0,), (1,)], "SCALAR", None, True), file.floats([(0, 0, 0), (0, 1, 0)], "VEC3", None)
    document = {
        "asset": {"version": "2.0", "generator": "artist_room.py"}, "scene": 0,
        "scenes": [{"name": "Scene", "nodes": [0] + list(range(1, 11)) + [lamp, lamp + 1]}],
        "nodes": nodes, "meshes": meshes, "materials": materials, "images": images,
        "samplers": [{"magFilter": 9729, "minFilter": 9987}],
        "textures": [{"sampler": 0, "source": k} for k in range(4)],
        "cameras": [{"name": "camera", "type": "perspective", "perspective": {"yfov": 1.0, "znear": .1, "zfar": 100}}],
        "animations": [{"name": "slide", "samplers": [{"input": times, "output": places}],
                        "channels": [{"sampler": 0, "target": {"node": 1, "path": "translation"}}]}],
        "accessors": file.accessors, "bufferViews": file.views, "buffers": [{"byteLength": len(file.binary)}],
        "extensionsUsed": ["KHR_materials_emissive_strength"],
        "extras": {"project": "artist_room"}}
    text = json.dumps(document, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    with open(asked.output, "wb") as out:
        out.write(struct.pack("<4sII", b"glTF", 2, 28 + len(text) + len(file.binary))
                  + struct.pack("<I4s", len(text), b"JSON") + text
                  + struct.pack("<I4s", len(file.binary), b"BIN\0") + file.binary)


main()
