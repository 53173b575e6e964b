#include "app/report/half_light.h"

#include "radiosity/paper/scene/mesh.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace hemilux {

/// Converts by exponents, which are biased by 15 for halves and by 127 for floats. So a float that
/// is 2^-112 times as large has the half's exponent, also below the normal numbers of both.
std::uint16_t half_of(double value) {
    constexpr double largest = 65504;
    if (std::isnan(value))
        return 0;
    const auto size = static_cast<float>(std::min(std::abs(value), largest)) * 0x1p-112f;
    const auto bits = std::bit_cast<std::uint32_t>(size);
    const std::uint32_t to_even = 0xfff + (bits >> 13 & 1);
    return static_cast<std::uint16_t>((bits + to_even) >> 13 | (value < 0 ? 0x8000u : 0u));
}

std::vector<std::uint16_t> halves_of(std::span<const Vec3> radiosity, double unit) {
    std::vector<std::uint16_t> halves;
    halves.reserve(3 * radiosity.size());
    for (const Vec3& light : radiosity)
        for (int channel = 0; channel < 3; ++channel)
            halves.push_back(half_of(light[channel] / unit));
    return halves;
}

double mean_light(const Mesh& mesh, std::span<const Vec3> radiosity) {
    double sum = 0, area = 0;
    for (std::size_t i = 0; i < radiosity.size(); ++i) {
        const Patch& patch = mesh.patches()[i];
        if (mesh.material(patch).is_far)
            continue;
        sum += patch.area * glm::dot(radiosity[i], Vec3(1.0)) / 3;
        area += patch.area;
    }
    return sum > 0 ? sum / area : 1;
}

} // namespace hemilux
