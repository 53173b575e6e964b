#include "bvh/wide/wide_bvh.h"

#include "bvh/brute_force.h"
#include "bvh/wide/float_ray.h"
#include "bvh/wide/kernel_choice.h"

#include <algorithm>
#include <array>
#include <tuple>
#include <vector>

namespace hemilux {
namespace {

using wide::Fit;
using wide::flag;
using wide::FloatRay;
using wide::Nearest;
using wide::Scaling;

/// The rays that are asked about, and what is needed to decide in doubles.
struct Query {
    const FacetSoup& soup;
    const wide::Space& space;
    std::span<const Ray> rays;
    std::vector<unsigned> too_far = {}; ///< rays that the kernels cannot trace

    template <EdgeRule rule>
    bool hit(unsigned k, std::uint32_t facet, double t_max, Hit& hit) const {
        const Ray& ray = rays[k];
        const ShearedRay sheared(ray.origin, ray.direction);
        hit.facet = facet;
        return hit_facet<rule>(soup.vertices, soup.facets[facet], sheared, ray.t_min, t_max, hit);
    }
};

bool load(void* context, unsigned k, FloatRay& scaled, Nearest& end) {
    Query& query = *static_cast<Query*>(context);
    Scaling scaling;
    const Fit fit = scale_ray(query.rays[k], query.space, scaled, scaling);
    if (fit == Fit::too_far)
        query.too_far.push_back(k);
    end = scaling.bounds(query.rays[k].t_max, wide::no_facet, 0);
    return fit == Fit::good;
}

/// Decides which hit is closer. The nearest so far is computed again too: this happens so seldom
/// that keeping it costs more.
void closer(void* context, unsigned k, std::uint32_t slot, Nearest& nearest) {
    const Query& query = *static_cast<const Query*>(context);
    Hit best{none, query.rays[k].t_max, 0, 0, false, false}, hit{};
    if (nearest.slot != wide::no_facet &&
        query.hit<EdgeRule::inclusive>(k, nearest.slot & ~flag, best.t, hit))
        best = hit;
    if (query.hit<EdgeRule::inclusive>(k, slot & ~flag, best.t, hit) &&
        comes_before(hit.t, hit.facet, best))
        best = hit;
    if (best.facet == none)
        return;
    FloatRay scaled;
    Scaling scaling;
    (void)scale_ray(query.rays[k], query.space, scaled, scaling);
    nearest = scaling.bounds(best.t, best.facet, best.front);
}

bool hits(void* context, unsigned k, std::uint32_t slot) {
    const Query& query = *static_cast<const Query*>(context);
    Hit hit{};
    return query.hit<EdgeRule::inclusive>(k, slot & ~flag, query.rays[k].t_max, hit);
}

/// Counts the second half of a quad only where the first does not count, so that the quad counts
/// once.
bool counts(void* context, unsigned k, std::uint32_t slot) {
    const Query& query = *static_cast<const Query*>(context);
    Hit hit{};
    return query.hit<EdgeRule::half_open>(k, slot & ~flag, query.rays[k].t_max, hit) &&
           hit.second_half == ((slot & flag) != 0);
}

wide::RayQuery ray_query(Query& query) { return {&query, load, closer, hits, counts}; }

} // namespace

WideBvh::WideBvh(const FacetSoup& soup, const WideBvhOptions& options)
    : soup_(soup), kernels_(&wide::kernels_of(options.kernels)),
      built_(wide::build(soup, options.threads)), space_{built_.bounds} {
    space_.size = wide::size_of(built_.bounds);
    space_.shrink = 1 / space_.size;
}

std::optional<Hit> WideBvh::closest(const Ray& ray) const {
    if (built_.leaves.size() == 0)
        return std::nullopt;
    Query query{soup_, space_, {&ray, 1}};
    FloatRay scaled;
    Nearest nearest;
    if (load(&query, 0, scaled, nearest))
        kernels_->closest(tree(), scaled, nearest, ray_query(query));
    else if (!query.too_far.empty())
        return BruteForce(soup_).closest(ray);
    return nearest.slot == wide::no_facet ? std::nullopt
                                          : std::optional(locate(ray, nearest.slot & ~flag));
}

bool WideBvh::occluded(const Ray& ray, std::uint32_t target) const {
    if (built_.leaves.size() == 0)
        return false;
    Query query{soup_, space_, {&ray, 1}};
    FloatRay scaled;
    Nearest end;
    if (load(&query, 0, scaled, end))
        return kernels_->occluded(tree(), scaled, end, target, ray_query(query));
    return !query.too_far.empty() && BruteForce(soup_).occluded(ray, target);
}

std::uint32_t WideBvh::count(const Ray& ray) const {
    if (built_.leaves.size() == 0)
        return 0;
    Query query{soup_, space_, {&ray, 1}};
    FloatRay scaled;
    Nearest end;
    if (load(&query, 0, scaled, end))
        return kernels_->count(tree(), scaled, end, ray_query(query));
    return query.too_far.empty() ? 0 : BruteForce(soup_).count(ray);
}

Hit WideBvh::locate(const Ray& ray, std::uint32_t facet) const {
    Hit hit{};
    const ShearedRay sheared(ray.origin, ray.direction);
    (void)hit_facet<EdgeRule::inclusive>(soup_.vertices, soup_.facets[facet], sheared, ray.t_min,
                                         ray.t_max, hit);
    hit.facet = facet;
    return hit;
}

std::size_t WideBvh::triangles_around(const Vec3& point) const {
    if (built_.leaves.size() == 0)
        return 0;
    const Vec3 scaled = point / space_.size;
    const auto holds = [&](const wide::Node& node, unsigned k) {
        for (unsigned i = 0; i < 3; ++i) {
            const double x = scaled[static_cast<int>(i)];
            if (!(double(node.plane[2 * i][k]) <= x && x <= double(node.plane[2 * i + 1][k])))
                return false;
        }
        return true;
    };
    std::size_t triangles = 0;
    if (built_.nodes.size() == 0)
        return 0;
    std::vector<std::uint32_t> pending{0};
    while (!pending.empty()) {
        const std::uint32_t index = pending.back();
        pending.pop_back();
        if ((index & flag) != 0) {
            triangles += static_cast<std::size_t>(
                std::ranges::count_if(built_.leaves.data()[index & ~flag].slot,
                                      [](std::uint32_t slot) { return slot != wide::no_facet; }));
            continue;
        }
        const wide::Node& node = built_.nodes.data()[index];
        for (unsigned k = 0; k < wide::width; ++k)
            if (holds(node, k))
                pending.push_back(node.child[k]);
    }
    return triangles;
}

// Floats decide which boxes are outside, by so much that their rounding does not matter.
void WideBvh::facets_within(const Shaft& shaft, std::vector<std::uint32_t>& facets) const {
    if (built_.leaves.size() == 0)
        return;
    struct Side {
        std::array<float, 3> normal;
        std::array<std::size_t, 3> plane; ///< of a box, where it reaches farthest inside
        float offset;
    };
    constexpr double slack = 1e-6;
    std::array<Side, std::tuple_size_v<decltype(Shaft::side)>> sides;
    for (std::size_t s = 0; s < shaft.size; ++s) {
        const auto& [normal, offset] = shaft.side[s];
        sides[s].offset = static_cast<float>(offset * space_.shrink + slack);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            sides[s].normal[axis] = static_cast<float>(normal[static_cast<int>(axis)]);
            sides[s].plane[axis] = 2 * axis + (sides[s].normal[axis] > 0 ? 0 : 1);
        }
    }
    const std::size_t before = facets.size();
    std::array<std::uint32_t, wide::stack_size> pending;
    std::size_t size = 0;
    pending[size++] = 0; // the root
    while (size > 0) {
        const std::uint32_t index = pending[--size];
        if ((index & flag) != 0) {
            for (const std::uint32_t slot : built_.leaves.data()[index & ~flag].slot)
                if (slot != wide::no_facet)
                    facets.push_back(slot & ~flag);
            continue;
        }
        const wide::Node& node = built_.nodes.data()[index];
        std::array<float, wide::width> beyond; // of all sides, the farthest
        for (unsigned k = 0; k < wide::width; ++k)
            beyond[k] = node.plane[0][k] <= node.plane[1][k] ? -1.0f : 1.0f; // absent: outside
        for (std::size_t s = 0; s < shaft.size; ++s) {
            const Side& side = sides[s];
            const auto *x = node.plane[side.plane[0]], *y = node.plane[side.plane[1]],
                       *z = node.plane[side.plane[2]];
            for (unsigned k = 0; k < wide::width; ++k)
                beyond[k] = std::max(beyond[k], side.normal[0] * x[k] + side.normal[1] * y[k] +
                                                    side.normal[2] * z[k] - side.offset);
        }
        for (unsigned k = 0; k < wide::width; ++k)
            if (beyond[k] <= 0)
                pending[size++] = node.child[k];
    }
    const auto added = facets.begin() + static_cast<std::ptrdiff_t>(before);
    std::sort(added, facets.end());
    facets.erase(std::unique(added, facets.end()), facets.end());
}

wide::Tree WideBvh::tree() const {
    constexpr std::size_t cache = 1 << 21;
    return {built_.nodes.data(), built_.leaves.data(), built_.quality.bytes > cache};
}

void WideBvh::closest_stream(std::span<const Ray> rays, std::span<FacetHit> out) const {
    std::fill_n(out.begin(), rays.size(), FacetHit{});
    if (built_.leaves.size() == 0)
        return;
    std::array<wide::FirstHit, 1024> hits;
    for (std::size_t begin = 0; begin < rays.size(); begin += hits.size()) {
        const auto now = rays.subspan(begin, std::min(rays.size() - begin, hits.size()));
        std::fill_n(hits.begin(), now.size(), wide::FirstHit{wide::no_facet, 0});
        Query query{soup_, space_, now};
        kernels_->closest_stream(tree(), ray_query(query), static_cast<unsigned>(now.size()),
                                 hits.data());
        for (std::size_t k = 0; k < now.size(); ++k)
            if (hits[k].slot != wide::no_facet)
                out[begin + k] = {hits[k].slot & ~flag, hits[k].front != 0};
        for (const unsigned k : query.too_far)
            out[begin + k] = facet_hit(BruteForce(soup_).closest(now[k]));
    }
}

void WideBvh::occluded_stream(std::span<const Ray> rays, std::span<const std::uint32_t> targets,
                              std::span<std::uint8_t> out) const {
    std::fill_n(out.begin(), rays.size(), std::uint8_t{0});
    if (built_.leaves.size() == 0)
        return;
    Query query{soup_, space_, rays};
    kernels_->occluded_stream(tree(), ray_query(query), static_cast<unsigned>(rays.size()),
                              targets.data(), out.data());
    for (const unsigned k : query.too_far)
        out[k] = BruteForce(soup_).occluded(rays[k], targets[k]);
}

void WideBvh::count_stream(std::span<const Ray> rays, std::span<std::uint32_t> out) const {
    std::fill_n(out.begin(), rays.size(), 0u);
    if (built_.leaves.size() == 0)
        return;
    Query query{soup_, space_, rays};
    kernels_->count_stream(tree(), ray_query(query), static_cast<unsigned>(rays.size()),
                           out.data());
    for (const unsigned k : query.too_far)
        out[k] = BruteForce(soup_).count(rays[k]);
}

} // namespace hemilux
