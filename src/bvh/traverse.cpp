#include "bvh/bvh.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hemilux {
namespace {

/// The ray as the float boxes see it.
struct BoxRay {
    std::array<float, 3> origin, inverse;
    double skipped = 0; ///< t at which the float ray starts
    bool misses = false;

    /// A direction component of zero would make 0 * inf = NaN on a slab's plane. This share of the
    /// longest component is far below what the widening of the boxes covers.
    static constexpr double tiny = 1e-18;

    BoxRay(const Ray& ray, const Box& bounds) {
        const double length = std::max(
            {std::abs(ray.direction.x), std::abs(ray.direction.y), std::abs(ray.direction.z)});
        Vec3 slope;
        for (int i = 0; i < 3; ++i) {
            const double d = ray.direction[i];
            slope[i] = std::abs(d) < tiny * length ? std::copysign(tiny * length, d) : d;
        }
        skip_to(bounds, ray.origin, slope);
        for (int i = 0; i < 3; ++i) {
            origin[static_cast<std::size_t>(i)] =
                static_cast<float>(ray.origin[i] + skipped * ray.direction[i]);
            inverse[static_cast<std::size_t>(i)] = static_cast<float>(1.0 / slope[i]);
        }
    }

    /// Moves the start of rays from far outside to the scene's box, because their distance would
    /// not fit the float's digits.
    void skip_to(const Box& bounds, const Vec3& from, const Vec3& slope) {
        double enter = 0, leave = std::numeric_limits<double>::infinity();
        for (int i = 0; i < 3; ++i) {
            const double a = (bounds.low[i] - from[i]) / slope[i];
            const double b = (bounds.high[i] - from[i]) / slope[i];
            enter = std::max(enter, std::min(a, b));
            leave = std::min(leave, std::max(a, b));
        }
        misses = !(enter <= leave);
        skipped = enter;
    }
};

/// A node to be visited once nearer ones are done, and where the ray enters its box.
struct Pending {
    Bvh::Child at;
    float enter;
};

/// This is deeper than any tree that the builder makes.
constexpr int stack_size = 128;

} // namespace

template <class Leaf>
void Bvh::traverse(const Ray& ray, const double& t_max, Leaf&& leaf) const {
    if (order_.empty())
        return;
    const BoxRay box_ray(ray, bounds_);
    if (box_ray.misses)
        return;
    // The exit distance is rounded up by more than the error of the three operations behind it.
    constexpr float round_up = 1.0f + 8.0f * std::numeric_limits<float>::epsilon();
    const auto limit = [&] { return static_cast<float>(t_max - box_ray.skipped) * round_up; };

    std::array<Pending, stack_size> stack;
    int top = 0;
    Pending now{root_, 0};
    for (;;) {
        if (now.at.count != none) {
            for (std::uint32_t slot = now.at.first; slot < now.at.first + now.at.count; ++slot)
                if (leaf(slot))
                    return;
        } else {
            const Node& node = nodes_[now.at.first];
            std::array<float, 2> enter{0.0f, 0.0f};
            const float far = limit();
            std::array<float, 2> leave{far, far};
            for (std::size_t axis = 0; axis < 3; ++axis)
                for (std::size_t child = 0; child < 2; ++child) {
                    const float a =
                        (node.low[axis][child] - box_ray.origin[axis]) * box_ray.inverse[axis];
                    const float b =
                        (node.high[axis][child] - box_ray.origin[axis]) * box_ray.inverse[axis];
                    enter[child] = std::max(enter[child], std::min(a, b));
                    leave[child] = std::min(leave[child], std::max(a, b) * round_up);
                }
            const bool hit0 = enter[0] <= leave[0], hit1 = enter[1] <= leave[1];
            if (hit0 || hit1) {
                const std::size_t near = hit0 && (!hit1 || enter[0] <= enter[1]) ? 0 : 1;
                if (hit0 && hit1)
                    stack[static_cast<std::size_t>(top++)] = {node.child[1 - near],
                                                              enter[1 - near]};
                now = {node.child[near], enter[near]};
                continue;
            }
        }
        do {
            if (top == 0)
                return;
            now = stack[static_cast<std::size_t>(--top)];
        } while (now.enter > limit());
    }
}

std::optional<Hit> Bvh::closest(const Ray& ray) const {
    const ShearedRay sheared(ray.origin, ray.direction);
    Hit best{none, ray.t_max, 0, 0, false, false};
    traverse(ray, best.t, [&](std::uint32_t slot) {
        Hit hit{};
        const std::uint32_t facet = order_[slot];
        if (facet != ray.from &&
            hit_facet<EdgeRule::inclusive>(vertices_, facets_[slot], sheared, ray.t_min, best.t,
                                           hit) &&
            comes_before(hit.t, facet, best)) {
            best = hit;
            best.facet = facet;
        }
        return false;
    });
    return best.facet == none ? std::nullopt : std::optional(best);
}

bool Bvh::occluded(const Ray& ray, std::uint32_t target) const {
    const ShearedRay sheared(ray.origin, ray.direction);
    bool blocked = false;
    traverse(ray, ray.t_max, [&](std::uint32_t slot) {
        Hit hit{};
        const std::uint32_t facet = order_[slot];
        blocked = facet != ray.from && facet != target &&
                  hit_facet<EdgeRule::inclusive>(vertices_, facets_[slot], sheared, ray.t_min,
                                                 ray.t_max, hit);
        return blocked;
    });
    return blocked;
}

std::uint32_t Bvh::count(const Ray& ray) const {
    const ShearedRay sheared(ray.origin, ray.direction);
    std::uint32_t pierced = 0;
    traverse(ray, ray.t_max, [&](std::uint32_t slot) {
        Hit hit{};
        pierced += order_[slot] != ray.from &&
                   hit_facet<EdgeRule::half_open>(vertices_, facets_[slot], sheared, ray.t_min,
                                                  ray.t_max, hit);
        return false;
    });
    return pierced;
}

} // namespace hemilux
