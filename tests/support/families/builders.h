#pragma once
// Parts of which the hard scenes are built. Each facet is one patch.

#include "support/families/dense_system.h"
#include "support/families/hard_scene.h"

#include <optional>

namespace hemilux::test {

[[nodiscard]] Scene with_materials(std::vector<Material> materials);
[[nodiscard]] Material grey(const char* name, double reflectance, double emission);
/// How many facets a scene has: the end of a range.
[[nodiscard]] std::uint32_t facets_of(const Scene& scene);

/// A parallelogram; corners counter-clockwise from the front.
[[nodiscard]] Polygon parallelogram(const Vec3& corner, const Vec3& first, const Vec3& second);
/// A facet of this shape, with vertices of its own.
void add_polygon(Scene& scene, const Polygon& polygon, std::uint32_t material);

/// A smaller polygon about the centre of another one, which is a parallelogram or, with equal
/// shares, a triangle: its edges are such shares of the outer ones. What is around it becomes
/// trapezoids; the inner one gets a material or is left open.
struct Inset {
    Vec2 share;
    std::optional<std::uint32_t> inner;
};
/// All of a cell is missing.
inline const Inset missing_cell{Vec2(1.0), std::nullopt};
/// Returns the inner polygon.
Polygon add_with_inset(Scene& scene, const Polygon& around, std::uint32_t material,
                       const Inset& inset);

/// Sides of a box as of box_room: floor, ceiling, -x, +x, -z, +z.
enum BoxSide : std::uint32_t { floor_side, ceiling, left, right, back, front };

/// A cell of a box's side, or its inset, that is not like the others.
struct OddCell {
    std::uint32_t side, column, row;
    Inset inset;
};
/// What a box was given, and where it is open.
struct BuiltBox {
    Range patches;
    std::vector<Polygon> openings; ///< facing inward, in the order of the odd cells
};
/// The inside of a box with n x n cells a side.
BuiltBox add_box(Scene& scene, const Vec3& low, const Vec3& high, std::uint32_t n,
                 std::uint32_t material, const std::vector<OddCell>& odd);

/// Sum of the form factors from each patch of a range to some openings.
[[nodiscard]] std::vector<double> lost_through(const DenseSystem& system, Range range,
                                               const std::vector<Polygon>& openings);
/// A convex box, with what is open in it: all pairs, and the rows closed.
void add_convex(DenseSystem& system, const BuiltBox& box, ExchangeTable& table);

/// One vertex in place of all within 1e-10 m of each other, as in a modelled scene.
void weld(Scene& scene);

/// A welded scene with its reference, whose relative error is bounded.
[[nodiscard]] HardScene solved(Scene scene, std::vector<Vec3> reference, double relative_error,
                               std::vector<std::vector<std::uint32_t>> parts);
/// The same with the solution of a system.
[[nodiscard]] HardScene solved(Scene scene, const DenseSystem& system, double relative_error,
                               std::vector<std::vector<std::uint32_t>> parts);
[[nodiscard]] std::vector<Vec3> emission_of(const Scene& scene);

} // namespace hemilux::test
