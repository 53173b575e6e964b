#include "io/pictures/view_judge.h"

#include "geometry/box.h"
#include "radiosity/scene/mesh.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hemilux {
namespace {

double luminance_of(const Vec3& b) { return glm::dot(b, Vec3(0.2126, 0.7152, 0.0722)); }

/// Dark is what has less than a tenth of the mean luminance. In a scene without light all is
/// bright.
std::vector<double> brightness_of(const Mesh& mesh, std::span<const Vec3> radiosity) {
    constexpr double dark = 0.1;
    double power = 0, area = 0;
    for (std::size_t i = 0; i < radiosity.size(); ++i) {
        const Vec3 reflected = radiosity[i] - mesh.material(static_cast<std::uint32_t>(i)).emission;
        power += mesh.patches()[i].area * std::max(luminance_of(reflected), 0.0);
        area += mesh.patches()[i].area;
    }
    std::vector<double> brightness(mesh.patches().size(), 1.0);
    if (!(power > 0))
        return brightness;
    for (std::size_t i = 0; i < radiosity.size(); ++i) {
        const double y = std::max(luminance_of(radiosity[i]), 0.0);
        brightness[i] = y / (y + dark * power / area);
    }
    return brightness;
}

/// Surfaces that look alike: of one material and turned to one side.
std::uint64_t kind_of(const Patch& patch) {
    const Vec3 size = glm::abs(patch.normal);
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const int side = 2 * axis + (patch.normal[axis] > 0 ? 1 : 0);
    return std::uint64_t{patch.material} * 6 + static_cast<std::uint64_t>(side);
}

/// exp of the entropy of how often each value occurs: the number of equally frequent values.
/// Sorts the values.
double effective_number(std::vector<std::uint64_t>& values) {
    std::sort(values.begin(), values.end());
    double entropy = 0;
    for (auto begin = values.begin(); begin != values.end();) {
        const auto end = std::upper_bound(begin, values.end(), *begin);
        const double share = static_cast<double>(end - begin) / static_cast<double>(values.size());
        entropy -= share * std::log(share);
        begin = end;
    }
    return std::exp(entropy);
}

/// Sums over the rays that saw something.
struct Impression {
    double brightness = 0, brightness_squared = 0;
    double through_backs = 0;
    Vec3 point{0.0};
    double point_squared = 0;
    std::vector<double> depths;
    std::vector<std::uint64_t> kinds, facets;
};

/// Share of the depths that are small beside the median. Reorders them.
double share_near(std::vector<double>& depths) {
    constexpr double near = 0.2;
    const auto middle = depths.begin() + static_cast<std::ptrdiff_t>(depths.size() / 2);
    std::nth_element(depths.begin(), middle, depths.end());
    const double limit = near * *middle;
    const auto count =
        std::count_if(depths.begin(), depths.end(), [&](double depth) { return depth < limit; });
    return static_cast<double>(count) / static_cast<double>(depths.size());
}

double score_of(Impression& seen, double rays, double diagonal) {
    if (seen.depths.empty())
        return 0;
    const auto n = static_cast<double>(seen.depths.size());
    const double coverage = n / rays;
    const double lit = seen.brightness / n;
    const double contrast = std::sqrt(std::max(seen.brightness_squared / n - lit * lit, 0.0));
    const double variety =
        std::log(1 + effective_number(seen.kinds)) * std::log(2 + effective_number(seen.facets));
    const double width =
        std::sqrt(
            std::max(seen.point_squared / n - glm::dot(seen.point, seen.point) / (n * n), 0.0)) /
        diagonal;
    const double direct = 1 - 0.5 * seen.through_backs / n;
    const double away = 1 - share_near(seen.depths);
    return coverage * lit * (1 + contrast) * variety * std::sqrt(width) * direct * away * away;
}

} // namespace

ViewJudge::ViewJudge(const Mesh& mesh, const Tracer& tracer, std::span<const Vec3> radiosity)
    : mesh_(mesh), tracer_(tracer), brightness_(brightness_of(mesh, radiosity)) {
    Box box;
    for (const Vec3& vertex : mesh.vertices())
        box.include(vertex);
    diagonal_ = glm::length(box.extent());
}

double ViewJudge::score(const Camera& camera, double aspect, int columns, int rows) const {
    const CameraRays rays(camera, mesh_, aspect);
    Impression seen;
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < columns; ++x) {
            const Ray ray = rays.ray((x + 0.5) / columns, (y + 0.5) / rows);
            const std::optional<Seen> first = look(mesh_, tracer_, ray);
            if (!first)
                continue;
            const Patch& patch = mesh_.patches()[first->patch];
            const double b = brightness_[first->patch];
            const Vec3 point = ray.origin + first->hit.t * ray.direction;
            seen.brightness += b;
            seen.brightness_squared += b * b;
            seen.through_backs += first->backs > 0;
            seen.point += point;
            seen.point_squared += glm::dot(point, point);
            seen.depths.push_back(first->hit.t);
            seen.kinds.push_back(kind_of(patch));
            seen.facets.push_back(patch.facet);
        }
    return score_of(seen, columns * static_cast<double>(rows), diagonal_);
}

bool ViewJudge::is_inside(const Vec3& point) const {
    // Directions on a spiral over the sphere, evenly spread (Vogel 1979).
    constexpr int directions = 32;
    constexpr double golden_angle = std::numbers::pi * (3 - 2.23606797749979);
    constexpr double enough = 0.6;
    double bright = 0;
    for (int i = 0; i < directions; ++i) {
        const double z = 1 - (2 * i + 1.0) / directions;
        const double r = std::sqrt(1 - z * z), angle = golden_angle * i;
        const Ray ray{.origin = point, .direction = {r * std::cos(angle), r * std::sin(angle), z}};
        if (const std::optional<Hit> hit = tracer_.closest(ray))
            if (const std::uint32_t patch = mesh_.patch_at(*hit); patch != none)
                bright += brightness_[patch] > 0.1;
    }
    return bright > enough * directions;
}

} // namespace hemilux
