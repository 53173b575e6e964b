#include "io/gltf/primitives.h"

#include "io/files/error.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace hemilux::gltf {
namespace {

constexpr std::uint32_t none = 0xffffffff;

std::size_t count_corners(const Primitive& primitive, const Document& document) {
    const Index accessor = primitive.indices ? primitive.indices : primitive.position;
    return accessor ? document.accessors[*accessor].count : 0;
}

/// Returns the corners of triangle t, as numbers of the primitive's corners.
std::array<std::size_t, 3> corners_of(Mode mode, std::size_t t) {
    switch (mode) {
    case Mode::strip: // every other one would look away
        return {t, t + 1 + t % 2, t + 2 - t % 2};
    case Mode::fan:
        return {t + 1, t + 2, 0};
    default:
        return {3 * t, 3 * t + 1, 3 * t + 2};
    }
}

} // namespace

std::size_t count_triangles(const Primitive& primitive, const Buffers& buffers,
                            const std::string& place) {
    const std::size_t corners = count_corners(primitive, buffers.document());
    if (!primitive.position || primitive.mode < Mode::triangles)
        return 0;
    const bool loose = primitive.mode == Mode::triangles;
    if (corners < 3 || (loose && corners % 3 != 0))
        throw InputError(buffers.path(), place + ": expected " +
                                             (loose ? "a multiple of 3" : "3 or more") +
                                             " corners, found " + std::to_string(corners));
    return loose ? corners / 3 : corners - 2;
}

std::vector<std::uint32_t> TriangleReader::vertices_of_corners(const Primitive& primitive,
                                                               std::size_t vertices) {
    if (!primitive.indices) {
        std::vector<std::uint32_t> all(vertices);
        std::iota(all.begin(), all.end(), 0u);
        return all;
    }
    const Elements indices(buffers_, *primitive.indices);
    indices.check("SCALAR", {Component::uint8, Component::uint16, Component::uint32});
    std::vector<std::uint32_t> all(indices.size());
    for (std::size_t k = 0; k < all.size(); ++k) {
        all[k] = indices.whole_at(k);
        if (all[k] >= vertices)
            indices.fail("element " + std::to_string(k) + ": expected an index below " +
                         std::to_string(vertices) + ", the number of vertices, found " +
                         std::to_string(all[k]));
    }
    return all;
}

/// Replaces vertices by the points that are used, in the order of their first use.
void TriangleReader::number_points(Triangles& triangles, std::size_t vertices) {
    used_.clear();
    if (point_of_.size() < vertices)
        point_of_.resize(vertices, none);
    for (auto& corners : triangles.corners)
        for (std::uint32_t& corner : corners) {
            std::uint32_t& point = point_of_[corner];
            if (point == none) {
                point = static_cast<std::uint32_t>(used_.size());
                used_.push_back(corner);
            }
            corner = point;
        }
    for (const std::uint32_t vertex : used_)
        point_of_[vertex] = none;
}

/// Returns the colours of COLOR_0, which may have an alpha that is passed over.
std::vector<glm::vec3> TriangleReader::colours_of_points(std::size_t accessor,
                                                         std::size_t vertices) {
    const Elements colours(buffers_, accessor);
    const bool has_alpha = buffers_.document().accessors[accessor].type == "VEC4";
    colours.check(has_alpha ? "VEC4" : "VEC3",
                  {Component::uint8, Component::uint16, Component::float32});
    if (colours.size() < vertices)
        colours.fail("expected " + std::to_string(vertices) +
                     " elements, as many as vertices, found " + std::to_string(colours.size()));
    std::vector<glm::vec3> of_points;
    of_points.reserve(used_.size());
    for (const std::uint32_t v : used_) {
        const glm::vec3 colour(colours.at(v, 0), colours.at(v, 1), colours.at(v, 2));
        if (!(std::min({colour.r, colour.g, colour.b}) >= 0) ||
            !std::isfinite(colour.r + colour.g + colour.b))
            colours.fail("element " + std::to_string(v) +
                         ": expected finite numbers of at least 0");
        of_points.push_back(colour);
    }
    return of_points;
}

Triangles TriangleReader::read(const Primitive& primitive, const std::string& place,
                               std::size_t texcoord_sets, bool with_colours) {
    Triangles triangles;
    const std::size_t count = count_triangles(primitive, buffers_, place);
    if (count == 0)
        return triangles;
    const Elements positions(buffers_, *primitive.position);
    positions.check("VEC3", {Component::int8, Component::uint8, Component::int16, Component::uint16,
                             Component::float32});
    if (positions.size() > none)
        positions.fail("expected at most 4294967295 vertices");
    const std::vector<std::uint32_t> vertex = vertices_of_corners(primitive, positions.size());
    triangles.corners.reserve(count);
    for (std::size_t t = 0; t < count; ++t) {
        const auto [a, b, c] = corners_of(primitive.mode, t);
        triangles.corners.push_back({vertex[a], vertex[b], vertex[c]});
    }
    number_points(triangles, positions.size());
    triangles.vertex = used_;
    triangles.points.reserve(used_.size());
    for (const std::uint32_t v : used_) {
        const Vec3 point(positions.at(v, 0), positions.at(v, 1), positions.at(v, 2));
        if (!std::isfinite(point.x + point.y + point.z))
            positions.fail("element " + std::to_string(v) + ": expected finite numbers");
        triangles.points.push_back(point);
    }
    for (std::size_t set = 0; set < texcoord_sets; ++set) {
        const Elements coordinates(buffers_, *primitive.texcoords[set]);
        coordinates.check("VEC2", {Component::int8, Component::uint8, Component::int16,
                                   Component::uint16, Component::float32});
        if (coordinates.size() < positions.size())
            coordinates.fail("expected " + std::to_string(positions.size()) +
                             " elements, as many as vertices, found " +
                             std::to_string(coordinates.size()));
        std::vector<glm::vec2>& of_points = triangles.texcoords.emplace_back();
        of_points.reserve(used_.size());
        for (const std::uint32_t v : used_) {
            const Vec2 uv(coordinates.at(v, 0), coordinates.at(v, 1));
            if (!std::isfinite(uv.x + uv.y))
                coordinates.fail("element " + std::to_string(v) + ": expected finite numbers");
            of_points.emplace_back(uv);
        }
    }
    if (with_colours && primitive.colours)
        triangles.colours = colours_of_points(*primitive.colours, positions.size());
    return triangles;
}

} // namespace hemilux::gltf
