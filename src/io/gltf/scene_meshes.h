#pragma once
// The triangles of the meshes that nodes show, added to a scene.

#include "io/gltf/instances.h"
#include "io/gltf/primitives.h"
#include "io/gltf/texture_maps.h"
#include "io/scene_files/read_result.h"
#include "radiosity/light/polygons/polygon_division.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

namespace hemilux::gltf {

/// The counts of what primitives and meshes have that is not read, and of what they lack.
struct MeshTally {
    std::size_t without_coordinates = 0, lines = 0, coloured = 0, morphed = 0, skins = 0;
};

class SceneMeshes {
  public:
    /// The materials of the document are in the scene already, with their textures.
    SceneMeshes(Buffers& buffers, const TextureMaps& maps, ReadResult& result)
        : document_(buffers.document()), path_(buffers.path()), maps_(maps), triangles_(buffers),
          result_(result) {}

    /// Adds the mesh of a node that shows one. Throws InputError.
    void add(const Instance& instance);
    [[nodiscard]] const MeshTally& tally() const { return tally_; }

  private:
    void add_primitive(const Instance& instance, std::size_t mesh, std::size_t number,
                       std::uint32_t group);
    void place(const std::vector<Vec3>& points, const Instance& instance);
    void add_texcoords(const Primitive& primitive, const Triangles& triangles,
                       const std::array<std::uint32_t, 3>& corners);
    void add_tints(const Triangles& triangles, const std::array<std::uint32_t, 3>& corners);
    [[nodiscard]] bool is_unlit(const Primitive& primitive) const;
    [[nodiscard]] const Triangles& triangles_of(std::size_t mesh, std::size_t number);
    [[nodiscard]] std::uint32_t group_of(const std::string& name);
    [[nodiscard]] std::uint32_t default_material();

    const Document& document_;
    const std::string& path_;
    const TextureMaps& maps_;
    TriangleReader triangles_;
    ReadResult& result_;
    std::unordered_map<std::string, std::uint32_t> group_index_;
    /// Triangles by mesh and primitive, read when a node shows them first.
    std::unordered_map<std::size_t, std::vector<std::optional<Triangles>>> read_;
    std::optional<std::uint32_t> default_material_;
    PolygonDivision division_;
    std::vector<Vec3> world_; ///< the points of a primitive
    MeshTally tally_;
};

/// Returns the JSON path of a primitive.
[[nodiscard]] std::string place_of(std::size_t mesh, std::size_t primitive);

} // namespace hemilux::gltf
