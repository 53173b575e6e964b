#include "radiosity/paper/hemisphere/edge_division.h"

#include "geometry/elementary.h"

namespace hemilux {

double division_share(double ns_1, double ns_2) {
    return ns_1 > 0 && ns_2 > 0 ? ns_2 / (ns_1 + ns_2) : 0.5;
}

Vec3 point_on_arc(const Vec3& a, const Vec3& b, double share) {
    const double angle = elementary::atan2(glm::length(glm::cross(a, b - a)), glm::dot(a, b));
    if (!(elementary::sin(angle) > 0)) // an edge without length
        return a;
    return glm::normalize(elementary::sin((1 - share) * angle) * a +
                          elementary::sin(share * angle) * b);
}

CountedDirection estimated_point(const CountedDirection& a, const CountedDirection& b) {
    const double af = division_share(a.surfaces, b.surfaces), bf = 1 - af; // AB = 1
    return {point_on_arc(a.direction, b.direction, af), a.surfaces * bf + b.surfaces * af};
}

CountedTriangle estimated_child(const CountedTriangle& triangle, std::size_t child) {
    const auto& [a, b, c] = triangle;
    const CountedDirection ab = estimated_point(a, b), bc = estimated_point(b, c),
                           ca = estimated_point(c, a);
    const std::array<CountedTriangle, 4> children{
        {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}}};
    return children[child];
}

} // namespace hemilux
