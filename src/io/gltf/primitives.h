#pragma once
// The triangles of a primitive in the coordinates of its mesh (sections 3.7.2 and 3.7.2.1).

#include "io/gltf/elements.h"

#include <glm/vec2.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace hemilux::gltf {

struct Triangles {
    std::vector<Vec3> points;          ///< those that triangles use
    std::vector<std::uint32_t> vertex; ///< of the primitive, by point
    std::vector<std::array<std::uint32_t, 3>> corners;
    /// Texture coordinates by set and point; empty where none are asked for.
    std::vector<std::vector<glm::vec2>> texcoords;
};

/// Returns how many triangles the primitive has; 0 for points and lines. `place` is its JSON path.
/// Throws InputError for a number of corners that the mode does not allow.
[[nodiscard]] std::size_t count_triangles(const Primitive& primitive, const Buffers& buffers,
                                          const std::string& place);

class TriangleReader {
  public:
    /// The buffers must outlive this object.
    explicit TriangleReader(Buffers& buffers) : buffers_(buffers) {}

    /// Reads the triangles, with coordinates of the sets from 0 to the one before `texcoord_sets`.
    /// Throws InputError for indices beyond the vertices, and for places that are no numbers.
    [[nodiscard]] Triangles read(const Primitive& primitive, const std::string& place,
                                 std::size_t texcoord_sets);

  private:
    [[nodiscard]] std::vector<std::uint32_t> vertices_of_corners(const Primitive& primitive,
                                                                 std::size_t vertices);
    void number_points(Triangles& triangles, std::size_t vertices);

    Buffers& buffers_;
    std::vector<std::uint32_t> point_of_; ///< points by vertex; none but while points are numbered
    std::vector<std::uint32_t> used_;     ///< vertices by point
};

} // namespace hemilux::gltf
