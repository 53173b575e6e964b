#include "bvh/wide/float_ray.h"

#include "bvh/wide/four_floats.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

namespace hemilux::wide {
namespace {

/// In the box tests, an inverse component of a direction is at most this large. The ray then strays
/// by far less than the boxes are widened by, and no slab's plane gives 0 times infinity.
constexpr float steepest = 1e18f;
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

/// A power of two that scales a direction, so that scaling rounds nothing, and where a ray enters
/// the scene.
struct Scale {
    double shorten = 1, lengthen = 1, skipped = 0;
};

/// Finds what any other ray is to be scaled by.
Fit find_scale(const Ray& ray, const Space& space, Scale& scale) {
    const double longest = max_abs(ray.direction);
    const double distance = max_abs(ray.origin) / space.size;
    const double sum = ray.direction.x + ray.direction.y + ray.direction.z + distance;
    if (!(longest > 0 && longest < infinity && distance < infinity) || std::isnan(sum))
        return Fit::misses;
    if (distance > too_far)
        return Fit::too_far;
    if (!(longest >= 0.5 && longest <= 1)) {
        int exponent = 0;
        std::frexp(longest, &exponent);
        exponent = std::clamp(exponent, -1000, 1000);
        scale.shorten = std::ldexp(1.0, -exponent);
        scale.lengthen = std::ldexp(1.0, exponent);
    }
    return distance > 1 && !enter_box(ray, space, scale.skipped) ? Fit::misses : Fit::good;
}

F4 to_floats(const Vec3& v) {
    return {
        F4::Vector{static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z), 1}};
}

void store(const F4& from, float (&to)[3]) { std::memcpy(to, &from.v, sizeof to); }

} // namespace

Fit scale_ray(const Ray& given, const Space& space, FloatRay& ray, Scaling& scaling) {
    Scale scale;
    if (!is_unit_and_near(given, space))
        if (const Fit fit = find_scale(given, space, scale); fit != Fit::good)
            return fit;
    scaling = {scale.skipped, space.shrink * scale.lengthen}; // exact
    const F4 origin = to_floats((given.origin + scale.skipped * given.direction) * space.shrink);
    const F4 direction = to_floats(given.direction * scale.shorten);
    const F4 inverse =
        min(max(F4::splat(1) / direction, F4::splat(-steepest)), F4::splat(steepest));
    store(inverse, ray.slabs.inverse);
    store(F4::splat(0) - origin * inverse, ray.slabs.offset);
    store(origin, ray.origin);
    store(direction, ray.direction);
    ray.slabs.octant = 0;
    for (unsigned i = 0; i < 3; ++i) {
        const unsigned negative = std::bit_cast<std::uint32_t>(float{inverse.v[i]}) >> 31;
        ray.slabs.octant |= static_cast<SlabRay::Byte>(negative << i);
        ray.slabs.near[i] = static_cast<SlabRay::Byte>(width * (2 * i + negative));
        ray.slabs.far[i] = ray.slabs.near[i] ^ width;
    }
    constexpr float entered = 0.003f; // what a start where a ray enters the bounds may be off by
    const F4 far = abs(origin);
    ray.reach = entered + std::max(std::max(far.v[0], far.v[1]), far.v[2]);
    const Nearest t_min = scaling.bounds(given.t_min, no_facet, 0);
    ray.t_min_low = t_min.low;
    ray.t_min_high = t_min.high;
    ray.from = given.from;
    return Fit::good;
}

} // namespace hemilux::wide
