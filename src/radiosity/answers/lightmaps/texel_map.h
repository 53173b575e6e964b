#pragma once
// The points of surfaces that the texels of a lightmap show.

#include "bvh/tracer.h"
#include "geometry/vector.h"
#include "radiosity/answers/lightmaps/smooth_point.h"
#include "radiosity/engine/rays/surface_point.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace hemilux {

class Mesh;

/// A triangle of a facet, and its place in a lightmap.
struct PlacedTriangle {
    std::uint32_t facet;
    bool back;        ///< the reverse of a two-sided facet
    bool second_half; ///< corners 0, 2, 3 of a quad instead of 0, 1, 2
    /// Triangles with the same number are near each other on the surface where they are in the
    /// lightmap.
    std::uint32_t chart;
    std::array<Vec2, 3> place; ///< of its corners [texels], from the upper left corner
};

class TexelMap {
  public:
    /// The distance from a triangle up to which texels show its nearest point [texels]: those that
    /// viewers interpolate between inside of it.
    static constexpr double reach = 1.5;

    /// Finds what the middle of each texel of a square shows. Of several triangles the nearest
    /// counts, then the first. The mesh must outlive this object.
    TexelMap(const Mesh& mesh, std::vector<PlacedTriangle> triangles, int size);

    [[nodiscard]] int size() const { return size_; }
    [[nodiscard]] std::size_t count() const { return texels_.size(); }
    [[nodiscard]] std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(size_) +
               static_cast<std::size_t>(x);
    }
    /// Returns whether the texel shows a surface, and whether its middle lies on it.
    [[nodiscard]] bool shows(std::size_t texel) const { return texels_[texel].triangle != none; }
    [[nodiscard]] bool is_inside(std::size_t texel) const { return texels_[texel].distance == 0; }
    [[nodiscard]] float distance(std::size_t texel) const { return texels_[texel].distance; }
    [[nodiscard]] const PlacedTriangle& triangle(std::size_t texel) const {
        return triangles_[texels_[texel].triangle];
    }
    /// Returns the point that a texel shows, with its patch.
    [[nodiscard]] SurfacePoint point(std::size_t texel) const;
    /// Returns the point at a place [texels] near a texel, on the same triangle.
    [[nodiscard]] SurfacePoint point_near(std::size_t texel, const Vec2& place) const;
    /// Lets points receive light with these normals, by facet (smooth_point.h). Both must outlive
    /// this object.
    void set_normals(std::span<const CornerNormals> normals, const Tracer& tracer);
    /// Return these points as they receive light, without their patch: those above where no normals
    /// were set.
    [[nodiscard]] SurfacePoint receiver(std::size_t texel) const;
    [[nodiscard]] SurfacePoint receiver_near(std::size_t texel, const Vec2& place) const;
    /// Returns about the side of a texel on the surface, in local units.
    [[nodiscard]] double side(std::size_t texel) const;

    /// Texels whose middles lie well inside of two triangles.
    struct Overlap {
        std::uint32_t facet, other;
        std::size_t texels;
    };
    /// Returns the overlaps by pairs of groups, those with most texels first, each with two facets
    /// of them.
    [[nodiscard]] const std::vector<Overlap>& overlaps() const { return overlaps_; }

  private:
    struct Texel {
        std::uint32_t triangle = none;
        float u = 0, v = 0; ///< as in Hit
        float distance = std::numeric_limits<float>::infinity();
    };
    using OverlapCounts = std::vector<std::pair<std::uint64_t, Overlap>>;
    void paint(std::uint32_t number, OverlapCounts& overlaps);
    [[nodiscard]] SurfacePoint point_of(const PlacedTriangle& triangle, double u, double v) const;
    [[nodiscard]] SurfacePoint receiver_of(const PlacedTriangle& triangle, double u,
                                           double v) const;

    const Mesh& mesh_;
    std::vector<PlacedTriangle> triangles_;
    int size_;
    std::vector<Texel> texels_;
    std::vector<Overlap> overlaps_;
    std::span<const CornerNormals> normals_; ///< by facet; empty: those of facets
    const Tracer* tracer_ = nullptr;
};

/// Returns the corners of a placed triangle in the local frame.
[[nodiscard]] std::array<Vec3, 3> corners_of(const Mesh& mesh, const PlacedTriangle& triangle);

/// Returns the triangles of charts.
struct LightmapChart;
[[nodiscard]] std::vector<PlacedTriangle> placed_triangles(const Mesh& mesh,
                                                           std::span<const LightmapChart> charts);

} // namespace hemilux
