#pragma once
// A convex room that a tree is asked about: which facets may reach into it? Where it is the room
// between two patches, those may hide one from the other (Haines and Wallace 1994, "Shaft culling
// for efficient ray-cast radiosity").

#include "geometry/box.h"

#include <array>
#include <cstddef>

namespace hemilux {

/// The common room of half-spaces: a point is inside where dot(normal, point) <= offset for all.
struct Shaft {
    struct HalfSpace {
        Vec3 normal; ///< outwards, of unit length
        double offset;
    };
    std::array<HalfSpace, 24> side{};
    std::size_t size = 0;

    /// Adds a half-space; one more than there is room for is left out, which makes the room larger.
    void add(const Vec3& normal, double offset) {
        if (size < side.size())
            side[size++] = {normal, offset};
    }
};

} // namespace hemilux
