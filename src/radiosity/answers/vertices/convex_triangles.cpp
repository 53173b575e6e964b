#include "radiosity/answers/vertices/convex_triangles.h"

#include "geometry/elementary.h"

#include <utility>

namespace hemilux {

/// The Delaunay triangle on one side of a chord has the corner that sees the chord under the
/// largest angle: no other corner lies within their circle.
std::vector<std::array<std::uint32_t, 3>> convex_triangles(std::span<const Vec3> corners) {
    const auto angle_at = [&](std::uint32_t i, std::uint32_t from, std::uint32_t to) {
        const Vec3 a = corners[from] - corners[i], b = corners[to] - corners[i];
        return elementary::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
    };
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> chords{
        {0, static_cast<std::uint32_t>(corners.size()) - 1}};
    while (!chords.empty()) {
        const auto [from, to] = chords.back();
        chords.pop_back();
        if (to - from < 2)
            continue;
        std::uint32_t best = from + 1;
        for (std::uint32_t i = from + 2; i < to; ++i)
            if (angle_at(i, from, to) > angle_at(best, from, to))
                best = i;
        triangles.push_back({from, best, to});
        chords.emplace_back(best, to);
        chords.emplace_back(from, best);
    }
    return triangles;
}

} // namespace hemilux
