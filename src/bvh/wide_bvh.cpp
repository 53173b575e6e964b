#include "bvh/wide_bvh.h"

#include "bvh/brute_force.h"
#include "bvh/float_ray.h"
#include "bvh/kernel_choice.h"

namespace hemilux {
namespace {

using wide::Fit;
using wide::flag;
using wide::Nearest;
using wide::ScaledRay;

/// What the judge needs to decide in doubles.
struct Query {
    const FacetSoup& soup;
    std::span<const Ray> rays;
    std::span<const ScaledRay> scaled;

    template <EdgeRule rule>
    bool hit(unsigned k, std::uint32_t facet, double t_max, Hit& hit) const {
        const Ray& ray = rays[k];
        const ShearedRay sheared(ray.origin, ray.direction);
        hit.facet = facet;
        return hit_facet<rule>(soup.vertices, soup.facets[facet], sheared, ray.t_min, t_max, hit);
    }
};

/// The nearest so far is worked out again too: this happens so seldom that keeping it costs more.
void closer(void* context, unsigned k, std::uint32_t slot, Nearest& nearest) {
    const Query& query = *static_cast<const Query*>(context);
    Hit best{none, query.rays[k].t_max, 0, 0, false, false}, hit{};
    if (nearest.slot != wide::no_facet &&
        query.hit<EdgeRule::inclusive>(k, nearest.slot & ~flag, best.t, hit))
        best = hit;
    if (query.hit<EdgeRule::inclusive>(k, slot & ~flag, best.t, hit) &&
        comes_before(hit.t, hit.facet, best))
        best = hit;
    if (best.facet != none)
        nearest = {query.scaled[k].below(best.t), query.scaled[k].above(best.t), best.facet,
                   best.front};
}

bool struck(void* context, unsigned k, std::uint32_t slot) {
    const Query& query = *static_cast<const Query*>(context);
    Hit hit{};
    return query.hit<EdgeRule::inclusive>(k, slot & ~flag, query.rays[k].t_max, hit);
}

/// The second half of a quad counts only where the first does not: then the quad counts once.
bool counts(void* context, unsigned k, std::uint32_t slot) {
    const Query& query = *static_cast<const Query*>(context);
    Hit hit{};
    return query.hit<EdgeRule::half_open>(k, slot & ~flag, query.rays[k].t_max, hit) &&
           hit.second_half == ((slot & flag) != 0);
}

wide::Judge judge(Query& query) { return {&query, closer, struck, counts}; }

} // namespace

WideBvh::WideBvh(const FacetSoup& soup, const WideBvhOptions& options)
    : soup_(soup), kernels_(&wide::find_kernels(options.kernels)),
      built_(wide::build(soup, options.threads)), space_{built_.low, built_.high, 1} {
    space_.size = wide::size_of(built_.low, built_.high);
}

std::optional<Hit> WideBvh::closest(const Ray& ray) const {
    const ScaledRay scaled(ray, space_);
    if (scaled.fit == Fit::too_far)
        return BruteForce(soup_).closest(ray);
    if (scaled.fit == Fit::misses || empty())
        return std::nullopt;
    Query query{soup_, {&ray, 1}, {&scaled, 1}};
    Nearest nearest{scaled.below(ray.t_max), scaled.above(ray.t_max), wide::no_facet, 0};
    kernels_->closest(tree(), scaled.ray, 0, nearest, judge(query));
    return nearest.slot == wide::no_facet ? std::nullopt
                                          : std::optional(locate(ray, nearest.slot & ~flag));
}

bool WideBvh::occluded(const Ray& ray, std::uint32_t target) const {
    const ScaledRay scaled(ray, space_);
    if (scaled.fit == Fit::too_far)
        return BruteForce(soup_).occluded(ray, target);
    if (scaled.fit == Fit::misses || empty())
        return false;
    Query query{soup_, {&ray, 1}, {&scaled, 1}};
    return kernels_->occluded(tree(), scaled.ray, 0, scaled.below(ray.t_max),
                              scaled.above(ray.t_max), target, judge(query));
}

std::uint32_t WideBvh::count(const Ray& ray) const {
    const ScaledRay scaled(ray, space_);
    if (scaled.fit == Fit::too_far)
        return BruteForce(soup_).count(ray);
    if (scaled.fit == Fit::misses || empty())
        return 0;
    Query query{soup_, {&ray, 1}, {&scaled, 1}};
    return kernels_->count(tree(), scaled.ray, 0, scaled.below(ray.t_max), scaled.above(ray.t_max),
                           judge(query));
}

Hit WideBvh::locate(const Ray& ray, std::uint32_t facet) const {
    Hit hit{};
    const ShearedRay sheared(ray.origin, ray.direction);
    (void)hit_facet<EdgeRule::inclusive>(soup_.vertices, soup_.facets[facet], sheared, ray.t_min,
                                         ray.t_max, hit);
    hit.facet = facet;
    return hit;
}

} // namespace hemilux
