#pragma once
// Radiosity at the corners of patches, for smooth pictures (Gouraud 1971, as used for radiosity by
// Goral et al. 1984).
//
// Corners of patches that meet in one point form classes. Two belong together when their patches
// have the same material and normals that differ by less than the crease angle. They belong
// together too where that is so through others. Light does not bleed over a crease, to another
// material or to the other side of a sheet. A class has one material, so its mean radiosity is the
// mean of the reflected part plus that material's emission. An emitter keeps a sharp edge.

#include "geometry/polygon.h"

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace hemilux {

class Mesh;
struct Slope;

/// A patch on whose sides corners of others lie, as meshes are written and drawn. So the patch and
/// its neighbours have the same vertices, and no crack shows between them.
struct Outline {
    std::uint32_t patch;
    std::vector<std::uint32_t> classes; ///< round the patch, from its first corner on
    std::vector<std::array<std::uint32_t, 3>> triangles; ///< indices of `classes`
};

/// A place on a side where corners of others meet, but none of a surface like the patch's: its
/// light is interpolated between two classes.
struct BetweenClasses {
    std::uint32_t from, to;
    double place; ///< 0: from, 1: to
};

struct CornerClasses {
    std::vector<std::array<std::uint32_t, 4>>
        of_patch;                        ///< class of each corner; triangle: [3] == [2]
    std::vector<Vec3> position;          ///< place of each class, local frame
    std::vector<BetweenClasses> between; ///< the last classes: those of no patch's corners
    std::vector<Outline> outlines;       ///< outlines in the order of patches
};

[[nodiscard]] CornerClasses find_corner_classes(const Mesh& mesh);

/// Returns the outline of a patch; null where it has no vertices but its corners.
[[nodiscard]] const Outline* outline_of(const CornerClasses& classes, std::uint32_t patch);

/// Calls visit(a, b, c) with the classes of each triangle of a patch. The triangles of all patches
/// have no T-junction where facets are divided.
template <class Visit>
void for_each_triangle(const CornerClasses& classes, std::uint32_t patch, const Visit& visit) {
    if (const Outline* const outline = outline_of(classes, patch)) {
        for (const auto& [a, b, c] : outline->triangles)
            visit(outline->classes[a], outline->classes[b], outline->classes[c]);
        return;
    }
    const auto& [a, b, c, d] = classes.of_patch[patch];
    visit(a, b, c);
    if (c != d)
        visit(a, c, d);
}

/// The patches that take part in the mean of a class.
enum class MeanOver {
    corners, ///< those with a corner in it: pictures interpolate each patch between its corners
    outlines ///< those too on whose sides it lies: meshes have it as a vertex there
};

/// Returns the mean radiosity of each class of corners [W/m2], weighted by the angles at the
/// corners. `slope` is empty, or says by patch what its light is in its corners.
[[nodiscard]] std::vector<Vec3> smooth(const Mesh& mesh, const CornerClasses& classes,
                                       std::span<const Vec3> radiosity,
                                       std::span<const Slope> slope = {},
                                       MeanOver over = MeanOver::outlines);

/// Returns the same for any value that patches have in their corners.
[[nodiscard]] std::vector<Vec3>
smooth(const Mesh& mesh, const CornerClasses& classes,
       const std::function<Vec3(std::uint32_t patch, const Vec3& corner)>& value,
       MeanOver over = MeanOver::outlines);

/// Returns the weights of the corners for a point of the polygon: barycentric in a triangle, the
/// inverse of the bilinear map in a quad. They are linear along edges, so that neighbours agree
/// there.
[[nodiscard]] std::array<double, 4> corner_weights(const Polygon& shape, const Vec3& point);

} // namespace hemilux
