#pragma once
// Describes a point of a surface, from which rays look.

#include "bvh/tracer.h"
#include "geometry/vector.h"

#include <cstdint>

namespace hemilux {

/// A point in the local frame.
struct SurfacePoint {
    Vec3 position;       ///< local units
    Vec3 normal;         ///< unit, to the side that receives
    std::uint32_t facet; ///< facet that it lies on, or none
    /// The patch that it lies on, whose points may choose emitters by the same chances. A point
    /// without one uses its own.
    std::uint32_t patch = none;
    /// The point lies above its facet, which rays from it may meet as any other.
    bool is_raised = false;

    /// Returns the facet that rays from the point leave out, or none.
    [[nodiscard]] std::uint32_t from() const { return is_raised ? none : facet; }
    [[nodiscard]] Ray ray(const Vec3& direction) const {
        return {.origin = position, .direction = direction, .from = from()};
    }
};

} // namespace hemilux
