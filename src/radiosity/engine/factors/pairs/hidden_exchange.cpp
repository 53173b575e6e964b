#include "radiosity/engine/factors/pairs/hidden_exchange.h"

#include "geometry/elementary.h"
#include "radiosity/engine/factors/pairs/line_samples.h"
#include "radiosity/engine/factors/pairs/pair_hull.h"
#include "radiosity/paper/sampling/rng.h"
#include "radiosity/paper/scene/mesh.h"

#include <cmath>

namespace hemilux {
namespace {

/// The most lines between two patches.
constexpr std::uint32_t max_lines = 4096;

} // namespace

/// Collects the facets that reach into the hull of the two.
void HiddenExchange::find_between(std::uint32_t i, const FacePlane& a, const ConvexPart& of_a,
                                  std::uint32_t j, const FacePlane& b, const ConvexPart& of_b) {
    const PairHull hull(of_a, a.plane, of_b, b.plane, plane_rounding);
    near_.clear();
    between_.clear();
    tree_.facets_within(hull.sides(), near_);
    for (const std::uint32_t facet : near_) {
        if (facet == mesh_.patches()[i].facet || facet == mesh_.patches()[j].facet)
            continue;
        const Polygon shape = mesh_.shape_of(facet);
        if (hull.holds_some_of(shape))
            between_.push_back(shape);
    }
}

PairEstimate HiddenExchange::between(std::uint32_t i, const FacePlane& a, std::uint32_t j,
                                     const FacePlane& b, Facing facing, std::uint64_t seed,
                                     const std::function<double(double exchange)>& allowed) {
    ConvexPart of_a = part_of(a.shape), of_b = part_of(b.shape);
    if (facing == Facing::partly) {
        of_a = in_front(of_a, b.plane, plane_rounding);
        of_b = in_front(of_b, a.plane, plane_rounding);
        if (of_a.empty() || of_b.empty())
            return {};
    }
    const double free = free_exchange(a, b, facing, FreeAccuracy::exact, plane_rounding);
    find_between(i, a, of_a, j, b, of_b);
    if (between_.empty())
        return {.exchange = free, .share = 1};
    LineSamples along_first(a, b, between_, LinesAlong::first_edge, hash_words({seed, 1})),
        along_second(a, b, between_, LinesAlong::second_edge, hash_words({seed, 2}));
    along_first.go_on_to(LineSamples::first_lines);
    along_second.go_on_to(LineSamples::first_lines);
    LineSamples& lines =
        along_first.seen().variance <= along_second.seen().variance ? along_first : along_second;
    for (std::uint32_t count = LineSamples::first_lines;;) {
        const SeenShare seen = lines.seen();
        const double deviation = free * std::sqrt(seen.variance);
        const double wanted = allowed(free * seen.share);
        if (count >= max_lines || deviation <= wanted)
            return {free * seen.share, deviation, seen.share, seen.lines + LineSamples::first_lines,
                    seen.clear_lines == seen.lines};
        // The error falls about as the power -0.8 of the lines.
        const double enough = count * elementary::pow(deviation / wanted, 1 / .8);
        do
            count *= 2;
        while (count < max_lines && 1.4 * count < enough);
        lines.go_on_to(count);
    }
}

} // namespace hemilux
