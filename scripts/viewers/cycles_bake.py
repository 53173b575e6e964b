"""Bakes room.glb (scripts/artist_room.py) by Cycles into its second set of texture coordinates, and compares lightmaps:
blender --background --factory-startup --python cycles_bake.py -- bake SAMPLES TEXELS OUT.exr
blender --background --factory-startup --python cycles_bake.py -- compare A.exr B.exr
The first prints seconds of the processor, the second the RMS difference of the 95 % of texels that differ least,
relative to the mean light: others lie at edges, where Cycles samples whole texels."""
import os
import sys
import time

import bpy
import numpy

numpy.bool = bool  # Debian 12 has a numpy without it, and Blender 3.4 reads glTF with it

what, *arguments = sys.argv[sys.argv.index("--") + 1:]


def bake(samples, texels, path):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.import_scene.gltf(filepath="room.glb")
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.cycles.samples = samples
    scene.cycles.use_denoising = scene.cycles.use_adaptive_sampling = False
    scene.cycles.max_bounces = scene.cycles.diffuse_bounces = 32
    scene.render.threads_mode, scene.render.threads = "FIXED", 1
    image = bpy.data.images.new("light", texels, texels, float_buffer=True)
    for material in filter(lambda m: m.use_nodes, bpy.data.materials):
        nodes = material.node_tree.nodes
        target = nodes.new("ShaderNodeTexImage")
        target.image = image
        nodes.active = target
    bpy.ops.object.select_all(action="DESELECT")
    for thing in filter(lambda o: o.type == "MESH", bpy.data.objects):
        thing.select_set(True)
        bpy.context.view_layer.objects.active = thing
        thing.data.uv_layers.active = thing.data.uv_layers[1]
    settings = scene.render.bake
    settings.use_pass_color, settings.margin = False, 2
    begin = time.process_time()
    bpy.ops.object.bake(type="DIFFUSE")
    print(f"{samples} samples: {time.process_time() - begin:.1f} s")
    image.filepath_raw, image.file_format = os.path.abspath(path), "OPEN_EXR"
    image.save()


def pixels(path):
    image = bpy.data.images.load(os.path.abspath(path))
    image.colorspace_settings.name = "Non-Color"
    return numpy.array(image.pixels[:]).reshape(-1, 4)[:, :3].mean(axis=1)


def compare(a, b):
    both = (a > 0) & (b > 0)
    gaps = numpy.sort(numpy.abs(a - b)[both]) / b[both].mean()
    print(f"differs by {100 * numpy.sqrt((gaps[:int(.95 * gaps.size)] ** 2).mean()):.2f} %")


if what == "bake":
    bake(int(arguments[0]), int(arguments[1]), arguments[2])
else:
    compare(*map(pixels, arguments))
