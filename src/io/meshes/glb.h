#pragma once
// The mesh with its light as a binary glTF 2.0 file (specification of the Khronos Group, sections 3
// and 4.4), for three.js, Godot, Blender and others.

#include "io/files/provenance.h"
#include "radiosity/answers/vertices/baked_light.h"

#include <span>
#include <string>

namespace hemilux {

/// Writes a node with a mesh for each group, under its name: its patches as triangles, quads as
/// two. Vertices have
/// - POSITION, about the middle of the scene, where the nodes are moved to;
/// - COLOR_0, the light as `display` shows it, linear in [0,1] as glTF demands;
/// - _RADIOSITY, _IRRADIANCE or _INDIRECT, the light itself [W/m2].
/// The one material is unlit (KHR_materials_unlit), so viewers show COLOR_0 as it is. Suns and
/// skies are left out. `up` is the scene's axis that points up, 1 or 2. In glTF that is y, so nodes
/// are turned where it is z. Throws OutputError, also for more than the 4 GiB of the format.
///
/// `texcoords` is empty, or holds by class the place in a lightmap, from its upper left corner to
/// (1, 1). It becomes TEXCOORD_1, and TEXCOORD_0 too, without which the format has no second one.
void write_glb(const std::string& path, const Mesh& mesh, const CornerClasses& classes,
               const VertexLight& light, const Provenance& from = {}, int up = 1,
               std::span<const Vec2> texcoords = {});

} // namespace hemilux
