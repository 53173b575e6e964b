#include "radiosity/answers/views/lit_patches.h"

#include "radiosity/paper/scene/mesh.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace hemilux {
namespace {

double sum_of(const Vec3& light) { return light.r + light.g + light.b; }

/// Returns the light above which patches reflect four fifths of all power.
double usual_level(const Mesh& mesh, std::span<const double> light) {
    std::vector<std::uint32_t> order(light.size());
    std::iota(order.begin(), order.end(), 0u);
    std::ranges::sort(order, std::greater(), [&](std::uint32_t i) { return light[i]; });
    const auto power = [&](std::uint32_t i) { return mesh.patches()[i].area * light[i]; };
    double most = 0;
    for (const std::uint32_t i : order)
        most += 0.8 * power(i);
    for (const std::uint32_t i : order)
        if ((most -= power(i)) <= 0)
            return light[i];
    return 0;
}

/// Draws patches by systematic sampling.
std::vector<std::uint32_t> drawn_by_power(const Mesh& mesh, std::span<const double> light) {
    constexpr std::size_t count = 40;
    double sum = 0;
    for (std::size_t i = 0; i < light.size(); ++i)
        sum += mesh.patches()[i].area * light[i];
    std::vector<std::uint32_t> drawn;
    double passed = 0;
    for (std::uint32_t i = 0; i < light.size() && sum > 0; ++i) {
        passed += mesh.patches()[i].area * light[i];
        const auto due = static_cast<std::size_t>(std::lround(count * passed / sum));
        if (drawn.size() < std::min(due, count))
            drawn.resize(std::min(due, count), i);
    }
    drawn.erase(std::unique(drawn.begin(), drawn.end()), drawn.end());
    return drawn;
}

} // namespace

std::vector<double> reflected_light(const Mesh& mesh, std::span<const Vec3> radiosity) {
    constexpr double rounding = 1e-6; // of the difference of two like numbers
    std::vector<double> light(radiosity.size());
    for (std::uint32_t i = 0; i < light.size(); ++i) {
        const Material& material = mesh.material(i);
        const double all = sum_of(radiosity[i]), reflected = all - sum_of(material.emission);
        if (!material.is_far && std::isfinite(reflected) && reflected > rounding * all)
            light[i] = reflected;
    }
    return light;
}

LitPatches lit_patches(const Mesh& mesh, std::span<const Vec3> radiosity) {
    constexpr double of_usual = 0.5;
    constexpr float of_emitter = 0.2f;
    const std::vector<double> light = reflected_light(mesh, radiosity);
    const double full = of_usual * usual_level(mesh, light);
    LitPatches lit{{}, drawn_by_power(mesh, light)};
    for (std::uint32_t i = 0; i < light.size(); ++i) {
        const Material& material = mesh.material(i);
        if (!(full > 0)) {
            lit.weight.push_back(material.is_far ? 0.0f : 1.0f);
            continue;
        }
        const auto weight = static_cast<float>(std::min(1.0, light[i] / full));
        lit.weight.push_back(sum_of(material.emission) > light[i] ? std::min(weight, of_emitter)
                                                                  : weight);
    }
    return lit;
}

} // namespace hemilux
