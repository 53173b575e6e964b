#pragma once
// A point of a surface, from which rays look.

#include "bvh/tracer.h"
#include "geometry/vector.h"

#include <cstdint>

namespace hemilux {

/// Lies in the local frame.
struct SurfacePoint {
    Vec3 position;
    Vec3 normal;         ///< unit, to the side that receives
    std::uint32_t facet; ///< that it lies on, or none
    /// That it lies on: its points may choose emitters by the same chances. None: by its own.
    std::uint32_t patch = none;

    [[nodiscard]] Ray ray(const Vec3& direction) const {
        return {.origin = position, .direction = direction, .from = facet};
    }
};

} // namespace hemilux
