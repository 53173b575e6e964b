"""Renders what was baked by Blender and compares it with hemilux's own picture; check.sh runs it:
blender --background --factory-startup --python blender.py -- vertices|lightmap EX,EY,EZ,TX,TY,TZ,FOV
blender --background --factory-startup --python blender.py -- baked|shown
The first shows scene.glb, the second lit.glb, whose materials keep their textures and whose camera is that of the file,
or shown.glb as it is imported."""
import json
import math
import os
import struct
import sys

import bpy
import numpy
from mathutils import Vector

numpy.bool = bool  # Debian 12 has a numpy without it, and Blender 3.4 reads glTF with it

what, *numbers = sys.argv[sys.argv.index("--") + 1:]
width, height = 400, 300


def document(path):
    with open(path, "rb") as file:
        size = struct.unpack("<I", file.read(20)[12:16])[0]
        return json.loads(file.read(size))


def add_camera():
    """Adds the camera of the command line. glTF has y upwards, Blender z."""
    eye_x, eye_y, eye_z, at_x, at_y, at_z, fov = map(float, numbers[0].split(","))
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.location = Vector((eye_x, -eye_z, eye_y))
    camera.rotation_euler = (Vector((at_x, -at_z, at_y)) - camera.location).to_track_quat("-Z", "Y").to_euler()
    camera.data.sensor_fit = "VERTICAL"
    camera.data.angle = fov * math.pi / 180
    bpy.context.scene.collection.objects.link(camera)
    return camera


def lightmap_node(tree, path, uv_set):
    """Adds an image that is read by a set of texture coordinates as it is."""
    uv, texture = tree.nodes.new("ShaderNodeUVMap"), tree.nodes.new("ShaderNodeTexImage")
    uv.uv_map = "UVMap" if uv_set == 0 else f"UVMap.{uv_set:03}"
    texture.image = bpy.data.images.load(os.path.abspath(path), check_existing=True)
    texture.image.colorspace_settings.name = "Linear"
    tree.links.new(uv.outputs["UV"], texture.inputs["Vector"])
    return texture.outputs["Color"]


def show(tree, colour):
    """Lets a material send this colour alone."""
    emission, output = tree.nodes.new("ShaderNodeEmission"), tree.nodes.new("ShaderNodeOutputMaterial")
    tree.links.new(colour, emission.inputs["Color"])
    tree.links.new(emission.outputs["Emission"], output.inputs["Surface"])
    output.is_active_output = True


def mix(tree, kind, a, b):
    """Adds the product or sum of two colours, each a socket or a value."""
    node = tree.nodes.new("ShaderNodeMixRGB")
    node.blend_type = kind
    node.inputs["Fac"].default_value = 1
    for name, colour in (("Color1", a), ("Color2", b)):
        if isinstance(colour, bpy.types.NodeSocket):
            tree.links.new(colour, node.inputs[name])
        else:
            node.inputs[name].default_value = colour
    return node.outputs["Color"]


def show_lightmap():
    material = bpy.data.materials.new("lightmap")
    material.use_nodes = True
    material.node_tree.nodes.clear()
    show(material.node_tree, lightmap_node(material.node_tree, "scene.lightmap.exr", 1))
    for mesh in bpy.data.meshes:
        mesh.materials.clear()
        mesh.materials.append(material)


def show_baked():
    """Lets materials send their colour times the light, and pi times the radiance of lamps: what pictures show."""
    sets = {m["name"]: m["extensions"]["MOZ_lightmap"]["texCoord"] for m in document("lit.glb")["materials"]}
    for material in bpy.data.materials:
        if not material.use_nodes or material.name not in sets:
            continue
        tree = material.node_tree
        surface = next(node for node in tree.nodes if node.type == "BSDF_PRINCIPLED")
        def colour_of(name):
            socket = surface.inputs[name]
            return socket.links[0].from_socket if socket.links else socket.default_value[:]
        strength = math.pi * surface.inputs["Emission Strength"].default_value
        reflected = mix(tree, "MULTIPLY", colour_of("Base Color"),
                        lightmap_node(tree, "lit.lightmap.exr", sets[material.name]))
        emitted = mix(tree, "MULTIPLY", colour_of("Emission"), (strength, strength, strength, 1))
        show(tree, mix(tree, "ADD", reflected, emitted))


def pixels(path):
    image = bpy.data.images.load(os.path.abspath(path))
    image.colorspace_settings.name = "Non-Color"
    return [x for k, x in enumerate(image.pixels[:]) if k % 4 < 3]


bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.import_scene.gltf(filepath={"baked": "lit.glb", "shown": "shown.glb"}.get(what, "scene.glb"))
scene = bpy.context.scene
scene.camera = add_camera() if numbers else next(o for o in bpy.data.objects if o.type == "CAMERA")
if what == "lightmap":
    show_lightmap()
elif what == "baked":
    show_baked()

scene.render.engine = "CYCLES"
scene.cycles.samples = 16
scene.cycles.max_bounces = 0
scene.cycles.pixel_filter_type = "BOX"
scene.cycles.use_denoising = False
scene.render.resolution_x, scene.render.resolution_y = width, height
scene.render.resolution_percentage = 100
if what == "shown":
    scene.view_settings.view_transform = "Standard"
    scene.render.image_settings.file_format = "PNG"
    scene.render.filepath = os.path.abspath("blender.png")
else:
    scene.view_settings.view_transform = "Raw"
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_depth = "32"
    scene.render.filepath = os.path.abspath("blender.exr")
bpy.ops.render.render(write_still=True)

if what == "shown":
    gaps = [abs(a - b) for a, b in zip(pixels("blender.png"), pixels("shown.png"))]
    print(f"shown: mean difference {255 * sum(gaps) / len(gaps):.2f} of 255")
    sys.exit()

if what == "baked":  # without a limit, as pictures in W/m2
    shown, own = pixels("blender.exr"), pixels("room.hdr")
else:
    exposure = document("scene.glb")["scenes"][0]["extras"]["exposure"]
    factor = exposure if what == "lightmap" else 1
    shown = [min(1, factor * x) for x in pixels("blender.exr")]
    own = [min(1, exposure * x) for x in pixels("picture.hdr")]
mean = sum(own) / len(own)
gaps = sorted(100 * abs(a - b) / mean for a, b in zip(shown, own))
print(f"{what}: in all {100 * (sum(shown) / sum(own) - 1):.2f} %, median {gaps[len(gaps) // 2]:.2f} %, "
      f"9 of 10 below {gaps[len(gaps) * 9 // 10]:.2f} %, mean {sum(gaps) / len(gaps):.2f} %")
