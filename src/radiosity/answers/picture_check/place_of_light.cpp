#include "radiosity/answers/picture_check/place_of_light.h"

#include "geometry/elementary.h"
#include "geometry/frame.h"
#include "radiosity/answers/views/lit_patches.h"
#include "radiosity/paper/scene/mesh.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <numeric>

namespace hemilux {
namespace {

/// Marks the patches that reflect 99 % of all power, those first that reflect most per area.
std::vector<bool> lit_part(const Mesh& mesh, std::span<const double> light) {
    constexpr double nearly_all = 0.99;
    const auto power = [&](std::uint32_t i) { return mesh.patches()[i].area * light[i]; };
    std::vector<std::uint32_t> order(light.size());
    std::iota(order.begin(), order.end(), 0u);
    std::ranges::sort(order, std::greater(), [&](std::uint32_t i) { return light[i]; });
    double left = 0;
    for (const std::uint32_t i : order)
        left += nearly_all * power(i);
    std::vector<bool> lit(light.size());
    for (const std::uint32_t i : order) {
        if (!(left > 0))
            break;
        lit[i] = true;
        left -= power(i);
    }
    return lit;
}

/// Names the groups that reflect nine tenths of the power.
void name_groups(PlaceOfLight& place, const Mesh& mesh, std::span<const double> light) {
    constexpr double most = 0.9;
    const Scene& scene = mesh.scene();
    std::vector<double> power(scene.groups.size());
    for (std::size_t i = 0; i < light.size(); ++i)
        power[scene.facets[mesh.patches()[i].facet].group] += mesh.patches()[i].area * light[i];
    const double sum = std::accumulate(power.begin(), power.end(), 0.0);
    std::vector<std::size_t> order(power.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, std::greater(), [&](std::size_t g) { return power[g]; });
    for (const std::size_t g : order) {
        if (place.of_light >= most)
            break;
        place.of_light += power[g] / sum;
        place.groups.push_back(scene.groups[g]);
    }
}

/// Returns the share of light from the lit part that arrives at it again, or at emitters.
double kept_share(const Mesh& mesh, const Tracer& tracer, std::span<const std::uint32_t> from,
                  const std::vector<bool>& lit) {
    constexpr int rays = 24;
    constexpr double golden = 0.6180339887498949;
    double kept = 0, all = 0;
    for (const std::uint32_t index : from) {
        const Patch& patch = mesh.patches()[index];
        const Frame frame = Frame::from_normal(patch.normal);
        for (int k = 0; k < rays; ++k) {
            const double u = (k + 0.5) / rays, turn = 2 * std::numbers::pi * golden * k;
            const Vec2 around = std::sqrt(u) * elementary::on_circle(turn);
            const Vec3 way =
                around.x * frame.x + around.y * frame.y + std::sqrt(1 - u) * patch.normal;
            const auto hit =
                tracer.closest({.origin = patch.centre, .direction = way, .from = patch.facet});
            const std::uint32_t at = hit ? mesh.patch_at(*hit) : none;
            all += 1;
            kept += at != none && !mesh.material(at).is_far &&
                    (lit[at] || mesh.material(at).emission != Vec3(0.0));
        }
    }
    return all > 0 ? kept / all : 0;
}

std::string number_text(double value, const char* format) {
    char text[32];
    std::snprintf(text, sizeof text, format, value);
    return text;
}

double longest_side(const Vec3& extent) { return std::max({extent.x, extent.y, extent.z}); }

} // namespace

PlaceOfLight place_of_light(const Mesh& mesh, const Tracer& tracer,
                            std::span<const Vec3> radiosity) {
    constexpr double nearly_all = 0.97;
    const std::vector<double> light = reflected_light(mesh, radiosity);
    const std::vector<bool> lit = lit_part(mesh, light);
    PlaceOfLight place;
    double area = 0;
    for (std::uint32_t i = 0; i < light.size(); ++i) {
        if (mesh.material(i).is_far)
            continue;
        const Patch& patch = mesh.patches()[i];
        area += patch.area;
        if (!lit[i])
            continue;
        place.of_area += patch.area;
        for (const Vec3& corner : patch.shape.corner)
            place.box.include(mesh.frame().to_world(corner));
    }
    if (place.box.empty())
        return place;
    place.of_area /= area;
    name_groups(place, mesh, light);
    place.enclosed =
        kept_share(mesh, tracer, lit_patches(mesh, radiosity).brightest, lit) > nearly_all;
    return place;
}

std::string text_of(const PlaceOfLight& place, const Mesh& mesh) {
    constexpr std::size_t max_names = 3;
    const std::size_t count = place.groups.size(), named = std::min(count, max_names);
    std::string names;
    for (std::size_t k = 0; k < named; ++k)
        names += (k == 0 ? "'" : k + 1 < count ? ", '" : " and '") + place.groups[k] + "'";
    if (count > named)
        names += " and " + std::to_string(count - named) + " more";
    Box all;
    for (const Patch& patch : mesh.patches())
        if (!mesh.material(patch).is_far)
            all.include(box_of(patch.shape.corner));
    const double percent = std::floor(100 * std::min(place.of_light, 1.0) + 1e-9);
    return number_text(percent, "%.0f %% of the light ") +
           (place.enclosed ? "stays inside " : "falls on ") + names +
           number_text(longest_side(place.box.extent()), ", %.3g wide in a scene of ") +
           number_text(longest_side(all.extent()) / mesh.frame().scale, "%.3g");
}

} // namespace hemilux
