#include "radiosity/engine/factors/pairs/convex_part.h"

namespace hemilux {

ConvexPart part_of(const Polygon& polygon) {
    ConvexPart part;
    for (int k = 0; k < polygon.size(); ++k)
        part.add(polygon.corner[static_cast<std::size_t>(k)]);
    return part;
}

ConvexPart in_front(const ConvexPart& part, const Plane& plane, double rounding) {
    ConvexPart kept;
    const double highest =
        clip_in_front(part.corners(), plane, [&](const Vec3& corner) { kept.add(corner); });
    return highest > rounding && kept.size >= 3 ? kept : ConvexPart{};
}

} // namespace hemilux
