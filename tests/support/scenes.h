#pragma once
// Scenes whose solution is known, made in code.

#include "radiosity/paper/scene/scene.h"

namespace hemilux::test {

/// Adds a planar quad of n x m facets; corners counter-clockwise from the front; a to b has n
/// facets.
void add_quad(Scene& scene, const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d,
              std::uint32_t n, std::uint32_t m, std::uint32_t material);

/// The outside of the axis-aligned box from `low` to `high`, a quad a side, of the material 0.
void add_block(Scene& scene, const Vec3& low, const Vec3& high);
/// The same of a cube.
inline void add_cube(Scene& scene, const Vec3& centre, double half) {
    add_block(scene, centre - half, centre + half);
}

/// Adds the faces of another scene, with its materials.
void add_scene(Scene& scene, const Scene& other);

/// The inside of the axis-aligned box from `low` to `high`, n x n quads a side. Sides in the order
/// -y (floor), +y (ceiling), -x, +x, -z, +z; material[side].
[[nodiscard]] Scene box_room(const Vec3& low, const Vec3& high, std::uint32_t n,
                             const std::vector<Material>& materials,
                             const std::array<std::uint32_t, 6>& material_of_side);

/// All sides of one material.
[[nodiscard]] Scene furnace_box(std::uint32_t n, double reflectance, double emission = 1);

/// A closed L-shaped room of one material: not convex, so its patches do not all see each other.
[[nodiscard]] Scene furnace_l_shape(double reflectance, double emission = 1);

/// The unit cube: n x n quads a face, floor emits 1, all reflect the same.
[[nodiscard]] Scene cube_with_lit_floor(std::uint32_t n, double reflectance);

/// A sphere of triangles around the origin, facing inward: an octahedron divided `level` times.
[[nodiscard]] Scene sphere(int level, double radius, double reflectance, double emission);

/// A small room with a lamp, a block and a low wall: occlusion, three different channels.
[[nodiscard]] Scene room_with_block();

/// A white cube whose back wall a curtain of n x n emitting facets touches: it stands edge-on, in
/// the middle of the patch `wall_behind_curtain`.
[[nodiscard]] Scene curtain_at_wall(std::uint32_t n);
inline constexpr std::uint32_t wall_behind_curtain = 4 * 9 + 4;

/// The same things under the open sky.
[[nodiscard]] Scene open_scene();

} // namespace hemilux::test
