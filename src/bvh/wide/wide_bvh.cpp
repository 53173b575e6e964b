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

/// The data that the exact test needs to decide in doubles.
struct Query {
    const FacetSoup& soup;
    std::span<const Ray> rays;
    std::span<const FloatRay> scaled;

    template <EdgeRule rule>
    bool hit(unsigned k, std::uint32_t facet, double t_max, Hit& hit) const {
        const Ray& ray = rays[k];
        const ShearedRay sheared(ray.origin, ray.direction);
        hit.facet = facet;
        return hit_facet<rule>(soup.vertices, soup.facets[facet], sheared, ray.t_min, t_max, hit);
    }
};

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
    if (best.facet != none)
        nearest = {below(query.scaled[k], best.t), above(query.scaled[k], best.t), best.facet,
                   best.front};
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

FacetHit hit_record(const Nearest& nearest) {
    if (nearest.slot == wide::no_facet)
        return {};
    return {nearest.slot & ~flag, nearest.front != 0};
}

wide::ExactTest exact(Query& query) { return {&query, closer, hits, counts}; }

} // namespace

WideBvh::WideBvh(const FacetSoup& soup, const WideBvhOptions& options)
    : soup_(soup), kernels_(&wide::kernels_of(options.kernels)),
      built_(wide::build(soup, options.threads, options.hierarchy)), space_{built_.bounds} {
    space_.size = wide::size_of(built_.bounds);
    space_.shrink = 1 / space_.size;
}

std::optional<Hit> WideBvh::closest(const Ray& ray) const {
    FloatRay scaled;
    const Fit fit = fit_ray(ray, scaled);
    if (fit == Fit::too_far)
        return BruteForce(soup_).closest(ray);
    if (fit == Fit::misses)
        return std::nullopt;
    Query query{soup_, {&ray, 1}, {&scaled, 1}};
    Nearest nearest = nothing_before(scaled, ray.t_max);
    kernels_->closest(tree(), scaled, 0, nearest, exact(query));
    return nearest.slot == wide::no_facet ? std::nullopt
                                          : std::optional(locate(ray, nearest.slot & ~flag));
}

bool WideBvh::occluded(const Ray& ray, std::uint32_t target) const {
    FloatRay scaled;
    const Fit fit = fit_ray(ray, scaled);
    if (fit == Fit::too_far)
        return BruteForce(soup_).occluded(ray, target);
    if (fit == Fit::misses)
        return false;
    Query query{soup_, {&ray, 1}, {&scaled, 1}};
    return kernels_->occluded(tree(), scaled, 0, below(scaled, ray.t_max), above(scaled, ray.t_max),
                              target, exact(query));
}

std::uint32_t WideBvh::count(const Ray& ray) const {
    FloatRay scaled;
    const Fit fit = fit_ray(ray, scaled);
    if (fit == Fit::too_far)
        return BruteForce(soup_).count(ray);
    if (fit == Fit::misses)
        return 0;
    Query query{soup_, {&ray, 1}, {&scaled, 1}};
    return kernels_->count(tree(), scaled, 0, below(scaled, ray.t_max), above(scaled, ray.t_max),
                           exact(query));
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
    std::vector<std::uint32_t> pending{tree().root};
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
    pending[size++] = tree().root;
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
    return {built_.nodes.data(), built_.leaves.data(), built_.nodes.size() == 0 ? flag : 0u,
            built_.quality.bytes > cache};
}

Fit WideBvh::fit_ray(const Ray& ray, FloatRay& scaled) const {
    return built_.leaves.size() == 0 ? Fit::misses : scale_ray(ray, space_, scaled);
}

/// Some rays of a stream, ready for the kernels. Those that the kernels cannot trace end before
/// they begin.
struct WideBvh::Block {
    static constexpr std::size_t size = 256;

    std::array<FloatRay, size> scaled;
    std::array<Nearest, size> nearest;
    std::array<Fit, size> fit;

    Block(const WideBvh& bvh, std::span<const Ray> rays) {
        for (std::size_t k = 0; k < rays.size(); ++k) {
            fit[k] = bvh.fit_ray(rays[k], scaled[k]);
            if (fit[k] == Fit::good) {
                nearest[k] = nothing_before(scaled[k], rays[k].t_max);
            } else {
                scaled[k] = {};
                nearest[k] = {-1, -1, wide::no_facet, 0};
            }
        }
    }
};

void WideBvh::closest_stream(std::span<const Ray> rays, std::span<FacetHit> out) const {
    if (built_.leaves.size() == 0) {
        std::fill_n(out.begin(), rays.size(), FacetHit{});
        return;
    }
    for (; !rays.empty(); rays = rays.subspan(std::min(rays.size(), Block::size))) {
        const auto now = rays.first(std::min(rays.size(), Block::size));
        Block block(*this, now);
        Query query{soup_, now, block.scaled};
        kernels_->closest_stream(tree(), block.scaled.data(), static_cast<unsigned>(now.size()),
                                 block.nearest.data(), exact(query));
        for (std::size_t k = 0; k < now.size(); ++k)
            out[k] = block.fit[k] == Fit::too_far ? facet_hit(closest(now[k]))
                                                  : hit_record(block.nearest[k]);
        out = out.subspan(now.size());
    }
}

void WideBvh::occluded_stream(std::span<const Ray> rays, std::span<const std::uint32_t> targets,
                              std::span<std::uint8_t> out) const {
    if (built_.leaves.size() == 0) {
        std::fill_n(out.begin(), rays.size(), std::uint8_t{0});
        return;
    }
    for (std::size_t begin = 0; begin < rays.size(); begin += Block::size) {
        const auto now = rays.subspan(begin, std::min(rays.size() - begin, Block::size));
        Block block(*this, now);
        Query query{soup_, now, block.scaled};
        kernels_->occluded_stream(tree(), block.scaled.data(), static_cast<unsigned>(now.size()),
                                  block.nearest.data(), &targets[begin], &out[begin], exact(query));
        for (std::size_t k = 0; k < now.size(); ++k)
            if (block.fit[k] == Fit::too_far)
                out[begin + k] = occluded(now[k], targets[begin + k]);
    }
}

void WideBvh::count_stream(std::span<const Ray> rays, std::span<std::uint32_t> out) const {
    if (built_.leaves.size() == 0) {
        std::fill_n(out.begin(), rays.size(), 0u);
        return;
    }
    for (std::size_t begin = 0; begin < rays.size(); begin += Block::size) {
        const auto now = rays.subspan(begin, std::min(rays.size() - begin, Block::size));
        Block block(*this, now);
        Query query{soup_, now, block.scaled};
        kernels_->count_stream(tree(), block.scaled.data(), static_cast<unsigned>(now.size()),
                               block.nearest.data(), &out[begin], exact(query));
        for (std::size_t k = 0; k < now.size(); ++k)
            if (block.fit[k] == Fit::too_far)
                out[begin + k] = count(now[k]);
    }
}

} // namespace hemilux
