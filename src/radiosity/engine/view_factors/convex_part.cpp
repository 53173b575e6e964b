#include "radiosity/engine/view_factors/convex_part.h"

#include <algorithm>

namespace hemilux {

ConvexPart part_of(const Polygon& polygon) {
    ConvexPart part;
    for (int k = 0; k < polygon.size(); ++k)
        part.add(polygon.corner[static_cast<std::size_t>(k)]);
    return part;
}

ConvexPart in_front(const ConvexPart& part, const Plane& plane, double rounding) {
    std::array<double, 28> height;
    double highest = 0, lowest = 0;
    for (std::size_t k = 0; k < part.size; ++k) {
        height[k] = plane.height(part.corner[k]);
        highest = std::max(highest, height[k]);
        lowest = std::min(lowest, height[k]);
    }
    if (!(highest > rounding))
        return {};
    if (lowest >= 0)
        return part;
    ConvexPart kept;
    for (std::size_t k = 0; k < part.size; ++k) {
        const std::size_t next = k + 1 < part.size ? k + 1 : 0;
        const double a = height[k], b = height[next];
        if (a >= 0)
            kept.add(part.corner[k]);
        if ((a < 0 && b > 0) || (a > 0 && b < 0))
            kept.add(glm::mix(part.corner[k], part.corner[next], a / (a - b)));
    }
    return kept.size >= 3 ? kept : ConvexPart{};
}

} // namespace hemilux
