"""Renders a baked mesh by Blender and compares it with hemilux's own picture; check_viewers.sh runs it:
blender --background --factory-startup --python blender.py -- vertices|lightmap EX,EY,EZ,TX,TY,TZ,FOV"""
import json
import os
import struct
import sys

import bpy
import numpy
from mathutils import Vector

numpy.bool = bool  # Debian 12 has a numpy without it, and Blender 3.4 reads glTF with it

what, numbers = sys.argv[sys.argv.index("--") + 1:]
eye_x, eye_y, eye_z, at_x, at_y, at_z, fov = map(float, numbers.split(","))
width, height = 400, 300
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.import_scene.gltf(filepath="scene.glb")

# glTF has y upwards, Blender z.
camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
camera.location = Vector((eye_x, -eye_z, eye_y))
camera.rotation_euler = (Vector((at_x, -at_z, at_y)) - camera.location).to_track_quat("-Z", "Y").to_euler()
camera.data.sensor_fit = "VERTICAL"
camera.data.angle = fov * 3.14159265358979 / 180
scene = bpy.context.scene
scene.collection.objects.link(camera)
scene.camera = camera

if what == "lightmap":
    # The second set of texture coordinates, through an image that is shown as it is.
    material = bpy.data.materials.new("lightmap")
    material.use_nodes = True
    nodes, links = material.node_tree.nodes, material.node_tree.links
    nodes.clear()
    uv, texture = nodes.new("ShaderNodeUVMap"), nodes.new("ShaderNodeTexImage")
    uv.uv_map = "UVMap.001"
    texture.image = bpy.data.images.load(os.path.abspath("scene.lightmap.exr"))
    texture.image.colorspace_settings.name = "Linear"
    emission, output = nodes.new("ShaderNodeEmission"), nodes.new("ShaderNodeOutputMaterial")
    links.new(uv.outputs["UV"], texture.inputs["Vector"])
    links.new(texture.outputs["Color"], emission.inputs["Color"])
    links.new(emission.outputs["Emission"], output.inputs["Surface"])
    for mesh in bpy.data.meshes:
        mesh.materials.clear()
        mesh.materials.append(material)

scene.render.engine = "CYCLES"
scene.cycles.samples = 16
scene.cycles.max_bounces = 0
scene.cycles.pixel_filter_type = "BOX"
scene.cycles.use_denoising = False
scene.render.resolution_x, scene.render.resolution_y = width, height
scene.render.resolution_percentage = 100
scene.view_settings.view_transform = "Raw"
scene.render.image_settings.file_format = "OPEN_EXR"
scene.render.image_settings.color_depth = "32"
scene.render.filepath = os.path.abspath("blender.exr")
bpy.ops.render.render(write_still=True)


def pixels(path):
    image = bpy.data.images.load(os.path.abspath(path))
    image.colorspace_settings.name = "Non-Color"
    return [x for k, x in enumerate(image.pixels[:]) if k % 4 < 3]


with open("scene.glb", "rb") as file:
    size = struct.unpack("<I", file.read(20)[12:16])[0]
    exposure = json.loads(file.read(size))["scenes"][0]["extras"]["exposure"]
factor = exposure if what == "lightmap" else 1
shown = [min(1, factor * x) for x in pixels("blender.exr")]
own = [min(1, exposure * x) for x in pixels("picture.hdr")]
mean = sum(own) / len(own)
gaps = sorted(100 * abs(a - b) / mean for a, b in zip(shown, own))
print(f"{what}: median {gaps[len(gaps) // 2]:.2f} %, 9 of 10 below {gaps[len(gaps) * 9 // 10]:.2f} %, "
      f"mean {sum(gaps) / len(gaps):.2f} %")
