#pragma once
// The triangles of a primitive in the coordinates of its mesh (sections 3.7.2 and 3.7.2.1).

#include "io/gltf/elements.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

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
    std::vector<glm::vec3> colours; ///< of COLOR_0 by point, linear; empty where not asked for
};

/// Returns how many triangles the primitive has; 0 for points and lines. `place` is its JSON path.
/// Throws InputError for a number of corners that the mode does not allow.
[[nodiscard]] std::size_t count_triangles(const Primitive& primitive, const Buffers& buffers,
                                          const std::string& place);

class TriangleReader {
  public:
    explicit TriangleReader(Buffers& buffers) : buffers_(buffers) {}

    /// Reads the triangles, with coordinates of the sets from 0 to the one before `texcoord_sets`,
    /// and with the colours of vertices where the primitive has them and they are asked for. Throws
    /// InputError for indices beyond the vertices, and for places that are no numbers.
    [[nodiscard]] Triangles read(const Primitive& primitive, const std::string& place,
                                 std::size_t texcoord_sets, bool with_colours = false);

  private:
    [[nodiscard]] std::vector<std::uint32_t> vertices_of_corners(const Primitive& primitive,
                                                                 std::size_t vertices);
    void number_points(Triangles& triangles, std::size_t vertices);
    [[nodiscard]] std::vector<glm::vec3> colours_of_points(std::size_t accessor,
                                                           std::size_t vertices);

    Buffers& buffers_;
    std::vector<std::uint32_t> point_of_; ///< points by vertex; none but while points are numbered
    std::vector<std::uint32_t> used_;     ///< vertices by point
};

} // namespace hemilux::gltf
