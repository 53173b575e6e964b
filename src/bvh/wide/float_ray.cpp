#include "bvh/wide/float_ray.h"

#include <algorithm>
#include <cmath>

namespace hemilux::wide {
namespace {

/// In the box tests, a component of a direction that is smaller than this is replaced by it. The
/// ray then strays by far less than the boxes are widened by, and no slab's plane gives 0 times
/// infinity.
constexpr double min_slope = 1e-18;
constexpr double too_far = 0x1p20; ///< distance in sizes of the scene

constexpr double infinity = std::numeric_limits<double>::infinity();

double max_abs(const Vec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

/// Finds where the ray enters the box; false when it does not.
bool enter_box(const Ray& ray, const Space& space, double& enter) {
    const double widen = space.size * 0x1p-20;
    double leave = infinity;
    for (int i = 0; i < 3; ++i) {
        const double d = ray.direction[i];
        const double a = (space.bounds.low[i] - widen - ray.origin[i]) / d;
        const double b = (space.bounds.high[i] + widen - ray.origin[i]) / d;
        if (std::isnan(a) || std::isnan(b))
            continue; // within a plane, or parallel on it
        enter = std::max(enter, std::min(a, b));
        leave = std::min(leave, std::max(a, b));
    }
    return enter <= leave;
}

/// Returns whether the ray is as nearly all rays are: of unit length, from within the scene, with
/// nothing infinite and no NaN.
bool is_unit_and_near(const Ray& ray, const Space& space) {
    const Vec3 &o = ray.origin, &d = ray.direction;
    const double square = glm::dot(d, d) + 0 * (o.x + o.y + o.z);
    const double distance = std::max(std::max(std::abs(o.x), std::abs(o.y)), std::abs(o.z));
    return square > .99 && square < 1 + 1e-9 && distance <= space.size;
}

void set_component(FloatRay& ray, int i, double start, double direction) {
    const double d =
        std::abs(direction) < min_slope ? std::copysign(min_slope, direction) : direction;
    ray.origin[i] = static_cast<float>(start);
    ray.direction[i] = static_cast<float>(direction);
    ray.inverse[i] = 1.0f / static_cast<float>(d);
}

} // namespace

Fit scale_ray(const Ray& given, const Space& space, FloatRay& ray) {
    if (is_unit_and_near(given, space)) {
        ray.skipped = 0;
        ray.per_unit = space.shrink;
        ray.from = given.from;
        for (int i = 0; i < 3; ++i)
            set_component(ray, i, given.origin[i] * space.shrink, given.direction[i]);
        ray.t_min_low = below(ray, given.t_min);
        ray.t_min_high = above(ray, given.t_min);
        return Fit::good;
    }
    const double longest = max_abs(given.direction);
    const double distance = max_abs(given.origin) / space.size;
    const double sum = given.direction.x + given.direction.y + given.direction.z + distance;
    if (!(longest > 0 && longest < infinity && distance < infinity) || std::isnan(sum))
        return Fit::misses;
    if (distance > too_far)
        return Fit::too_far;
    // A power of two is chosen, so that scaling rounds nothing; most directions are of unit length
    // already.
    double shorten = 1;
    if (!(longest >= 0.5 && longest <= 1)) {
        int exponent = 0;
        std::frexp(longest, &exponent);
        shorten = std::ldexp(1.0, -std::clamp(exponent, -1000, 1000));
    }
    double skipped = 0;
    if (distance > 1 && !enter_box(given, space, skipped))
        return Fit::misses;
    ray.skipped = skipped;
    ray.per_unit = 1 / (space.size * shorten); // exact
    ray.from = given.from;
    for (int i = 0; i < 3; ++i)
        set_component(ray, i, (given.origin[i] + skipped * given.direction[i]) * space.shrink,
                      given.direction[i] * shorten);
    ray.t_min_low = below(ray, given.t_min);
    ray.t_min_high = above(ray, given.t_min);
    return Fit::good;
}

} // namespace hemilux::wide
