#pragma once
// This divides a face of any shape into the shapes that a scene consists of: triangles and planar
// convex quads. Its area is kept, and every corner stays a corner, so that neighbours still meet.
//
// Quads that are planar and convex stay; other quads are cut along a diagonal. Planar convex
// polygons are cut into strips, each a quad. All others are cut into triangles in the plane of
// their normal, which is that of the area vector (Newell's method).

#include "geometry/vector.h"
#include "radiosity/light/polygons/ear_clipping.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace hemilux {

/// Corners farther than this from the polygon's plane, relative to its diagonal, make it
/// non-planar.
inline constexpr double planarity_tolerance = 1e-6;

/// The noteworthy properties of a face.
struct PolygonFlags {
    bool degenerate = false; ///< no wider than the rounding of its coordinates: it has no pieces
    bool nonplanar = false;
    bool concave = false;
    bool crossing = false;   ///< crosses itself: its pieces overlap, or miss a part
    bool unchecked = false;  ///< may cross itself: it has too many long edges to compare them all
    bool unfinished = false; ///< too intricate: its pieces may overlap
};

/// The work that faces may cause, counted in visits of nodes and in pairs of edges. Simple faces of
/// any number of corners take a few hundred per corner; the rest is for a few intricate ones.
struct DivisionWork {
    std::uint64_t divide = 50'000'000, compare = 100'000'000;
    static constexpr std::uint64_t divide_each = 1000, compare_each = 256; ///< more, for a corner
};

class PolygonDivision {
  public:
    /// Indices of corners, counter-clockwise as the polygon; triangle: [3] == [2].
    using Piece = std::array<std::uint32_t, 4>;

    /// Divides a polygon of any number of corners. Corners equal to the one before are left out.
    PolygonFlags divide(std::span<const Vec3> corners);
    /// Returns the pieces of the last polygon.
    [[nodiscard]] std::span<const Piece> pieces() const { return pieces_; }
    /// The work that all polygons together may still cause; each adds some of its own.
    DivisionWork work;

  private:
    void keep_distinct(std::span<const Vec3> corners);
    [[nodiscard]] bool scale_to_unit(std::span<const Vec3> corners);
    [[nodiscard]] bool project();
    [[nodiscard]] bool is_planar() const;
    [[nodiscard]] bool is_planar_quad(const Piece& quad) const;
    [[nodiscard]] bool is_collinear() const;
    /// Counts of corners by turn, and of changes between rightward and leftward edges.
    struct Turns {
        std::size_t right = 0, straight = 0, reversals = 0;
        [[nodiscard]] bool strictly_convex() const;
    };
    [[nodiscard]] Turns turns() const;

    void add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c);
    void add_strips();
    [[nodiscard]] bool add_quad_cut_in_two();
    void clip_ears(PolygonFlags& flags);

    std::vector<std::uint32_t> kept_; ///< corner of the polygon for each of the following points
    std::vector<Vec3> point_;         ///< relative to the first and scaled: within [-1,1]^3
    std::vector<Vec2> flat_;          ///< projected along the normal
    double diagonal_ = 0, rounding_ = 0;
    Vec3 normal_{0.0};
    EarClipper clipper_;
    std::vector<Piece> pieces_;
};

} // namespace hemilux
