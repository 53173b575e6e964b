#!/usr/bin/env python3
"""Writes a .glb of 2 N * N triangles: a hilly ground with a texture of 2048 x 2048 pixels, and a lamp.

    scripts/textured_glb.py N FILE.glb
"""
import array
import json
import math
import struct
import sys
import zlib


def png(size):
    rows = b"".join(
        b"\0" + bytes(v for x in range(size) for v in ((x * y >> 7) & 255, x & 255, y & 255))
        for y in range(size))

    def chunk(kind, data):
        return (struct.pack(">I", len(data)) + kind + data +
                struct.pack(">I", zlib.crc32(kind + data)))
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">2I5B", size, size, 8, 2, 0, 0, 0)) +
            chunk(b"IDAT", zlib.compress(rows, 6)) + chunk(b"IEND", b""))


n, path = int(sys.argv[1]), sys.argv[2]
places, uv, indices = array.array("f"), array.array("f"), array.array("I")
for j in range(n + 1):
    for i in range(n + 1):
        x, z = i / n, j / n
        places.extend((x, 0.1 * math.sin(9 * x) * math.cos(7 * z) + 0.002 * math.sin(90 * x * z), z))
        uv.extend((x, z))
for j in range(n):
    for i in range(n):
        a, b = j * (n + 1) + i, (j + 1) * (n + 1) + i
        indices.extend((a, b, b + 1, a, b + 1, a + 1))
lamp = array.array("f", (0.4, 1, 0.4, 0.6, 1, 0.4, 0.6, 1, 0.6, 0.4, 1, 0.6))
parts = [places.tobytes(), uv.tobytes(), indices.tobytes(), lamp.tobytes(), png(2048)]
views, buffer = [], b""
for part in parts:
    views.append({"buffer": 0, "byteOffset": len(buffer), "byteLength": len(part)})
    buffer += part + b"\0" * (-len(part) % 4)
count = (n + 1) ** 2
scene = {
    "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
    "meshes": [{"primitives": [
        {"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "indices": 2, "material": 0},
        {"attributes": {"POSITION": 3}, "mode": 6, "material": 1}]}],
    "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}, "metallicFactor": 0}},
                  {"emissiveFactor": [1, 1, 1]}],
    "textures": [{"source": 0}], "images": [{"bufferView": 4, "mimeType": "image/png"}],
    "accessors": [
        {"bufferView": 0, "componentType": 5126, "count": count, "type": "VEC3",
         "min": [0, -0.102, 0], "max": [1, 0.102, 1]},
        {"bufferView": 1, "componentType": 5126, "count": count, "type": "VEC2"},
        {"bufferView": 2, "componentType": 5125, "count": 6 * n * n, "type": "SCALAR"},
        {"bufferView": 3, "componentType": 5126, "count": 4, "type": "VEC3",
         "min": [0.4, 1, 0.4], "max": [0.6, 1, 0.6]}],
    "bufferViews": views, "buffers": [{"byteLength": len(buffer)}]}
text = json.dumps(scene).encode()
text += b" " * (-len(text) % 4)
with open(path, "wb") as file:
    file.write(struct.pack("<4s2I", b"glTF", 2, 28 + len(text) + len(buffer)))
    file.write(struct.pack("<I4s", len(text), b"JSON") + text)
    file.write(struct.pack("<I4s", len(buffer), b"BIN\0") + buffer)
