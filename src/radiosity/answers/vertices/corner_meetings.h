#pragma once
// This finds where corners of patches meet in a point. It also finds where such a point lies on a
// side of another patch, between patches that are divided differently.

#include "geometry/vector.h"

#include <compare>
#include <cstdint>
#include <vector>

namespace hemilux {

class Mesh;

struct PatchCorner {
    std::uint32_t patch;
    std::uint32_t corner;
};

/// The corners that meet in each point: those of point v are corner[first[v]] to
/// corner[first[v + 1]].
struct CornerMeetings {
    std::vector<std::uint32_t> first;
    std::vector<PatchCorner> corner;
    std::vector<Vec3> position; ///< local frame
};

[[nodiscard]] CornerMeetings find_meetings(const Mesh& mesh);

/// A point inside a side of a patch, which goes from corner `side` to the next one.
struct PointOnSide {
    std::uint32_t patch;
    std::uint32_t side;
    double place; ///< 0 at the beginning of the side, 1 at its end
    std::uint32_t point;

    [[nodiscard]] auto operator<=>(const PointOnSide&) const = default;
};

/// Finds points on the sides that the division of facets has made, and on the edges of the file
/// that divided facets share. They are in the order of patches, and go round each patch. Each is
/// listed once.
[[nodiscard]] std::vector<PointOnSide> find_points_on_sides(const Mesh& mesh,
                                                            const CornerMeetings& meetings);

} // namespace hemilux
