#include "radiosity/paper/solution/missed_light.h"

#include <algorithm>
#include <cstdint>
#include <numeric>

namespace hemilux {

Vec3 bright_radiosity(const LightFoundByRays& light) {
    Vec3 power(0.0), squares(0.0), result(0.0);
    for (std::size_t i = 0; i < light.area.size(); ++i) {
        power += light.area[i] * light.leaving[i];
        squares += light.area[i] * light.leaving[i] * light.leaving[i];
    }
    for (int c = 0; c < 3; ++c)
        result[c] = power[c] > 0 ? squares[c] / power[c] : 0;
    return result;
}

namespace {

/// Returns the rays per area of the patches that most light comes from.
double rays_of_bright(const LightFoundByRays& light) {
    double rays = 0, area = 0;
    for (std::size_t i = 0; i < light.area.size(); ++i) {
        const double weight = glm::dot(light.leaving[i], light.leaving[i]);
        rays += weight * light.rays[i];
        area += weight * light.area[i];
    }
    return area > 0 ? rays / area : 0;
}

} // namespace

std::vector<Vec3> missed_by_rays(const LightFoundByRays& light) {
    constexpr double darker = 4; // patches so many times darker, as in a room beyond, show nothing
    const Vec3 bright = bright_radiosity(light);
    const auto arrives = [&](std::uint32_t i) {
        // Rounding may make it less than nothing.
        return std::max(light.incident[i].x + light.incident[i].y + light.incident[i].z, 0.0);
    };
    std::vector<std::uint32_t> order(light.area.size());
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return arrives(a) < arrives(b); });
    std::vector<Vec3> result(order.size(), Vec3(0.0));
    const double by_bright = rays_of_bright(light);
    double rays = 0; // of those from `darkest` to i
    auto darkest = order.begin();
    for (const std::uint32_t i : order) {
        rays += light.rays[i];
        for (; darker * arrives(*darkest) < arrives(i); ++darkest)
            rays -= light.rays[*darkest];
        const double both = rays + by_bright * light.area[i];
        if (both > 0)
            result[i] = light.reflectance[i] * bright * (rule_of_three / both);
    }
    return result;
}

} // namespace hemilux
