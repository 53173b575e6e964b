#include "radiosity/engine/factors/pairs/hidden_exchange.h"

#include "geometry/elementary.h"
#include "radiosity/engine/factors/pairs/line_samples.h"
#include "radiosity/engine/factors/pairs/pair_hull.h"
#include "radiosity/paper/sampling/rng.h"
#include "radiosity/paper/scene/mesh.h"

#include <algorithm>
#include <cmath>

namespace hemilux {
namespace {

/// The most lines between two patches.
constexpr std::uint32_t max_lines = 4096;

/// Returns how many lines have an error that is wanted, by that of some: it falls about as the
/// power -0.8 of them.
double enough_lines(std::uint32_t count, double deviation, double wanted) {
    return count * elementary::pow(deviation / wanted, 1 / .8);
}

/// The parts of two sides that are in front of each other's planes.
struct FrontParts {
    ConvexPart a, b;
    [[nodiscard]] bool empty() const { return a.empty() || b.empty(); }
};

FrontParts front_parts(const FacePlane& a, const FacePlane& b, Facing facing) {
    FrontParts parts{part_of(a.shape), part_of(b.shape)};
    if (facing == Facing::partly)
        parts = {in_front(parts.a, b.plane, HiddenExchange::plane_rounding),
                 in_front(parts.b, a.plane, HiddenExchange::plane_rounding)};
    return parts;
}

PairHull hull_of(const FacePlane& a, const FacePlane& b, const FrontParts& parts) {
    return {parts.a, a.plane, parts.b, b.plane, HiddenExchange::plane_rounding};
}

} // namespace

/// Collects the facets that reach into the hull of the two.
void HiddenExchange::find_between(std::uint32_t i, std::uint32_t j, const PairHull& hull) {
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

bool HiddenExchange::is_clear(std::uint32_t i, const FacePlane& a, std::uint32_t j,
                              const FacePlane& b, Facing facing) {
    const FrontParts parts = front_parts(a, b, facing);
    if (parts.empty())
        return true;
    find_between(i, j, hull_of(a, b, parts));
    return between_.empty() && !is_dimmed(a, b, facing);
}

bool HiddenExchange::is_dimmed(const FacePlane& a, const FacePlane& b, Facing facing) const {
    if (panes_.empty())
        return false;
    const FrontParts parts = front_parts(a, b, facing);
    if (parts.empty())
        return false;
    const PairHull hull = hull_of(a, b, parts);
    return std::ranges::any_of(panes_,
                               [&hull](const Polygon& pane) { return hull.holds_some_of(pane); });
}

PairEstimate HiddenExchange::between(std::uint32_t i, const FacePlane& a, std::uint32_t j,
                                     const FacePlane& b, Facing facing, double free,
                                     std::uint64_t seed,
                                     const std::function<double(double exchange)>& allowed) {
    const FrontParts parts = front_parts(a, b, facing);
    if (parts.empty())
        return {};
    find_between(i, j, hull_of(a, b, parts));
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
        const double enough = enough_lines(count, deviation, wanted);
        do
            count *= 2;
        while (count < max_lines && 1.4 * count < enough);
        lines.go_on_to(count);
    }
}

PairEstimate HiddenExchange::unbiased(std::uint32_t i, const FacePlane& a, std::uint32_t j,
                                      const FacePlane& b, Facing facing, double free,
                                      std::uint64_t seed, double allowed) {
    constexpr std::uint32_t first_lines = LineSamples::first_lines / 2;
    const FrontParts parts = front_parts(a, b, facing);
    if (parts.empty())
        return {};
    find_between(i, j, hull_of(a, b, parts));
    if (between_.empty())
        return {.exchange = free, .share = 1};
    LinesAlong along = LinesAlong::first_edge;
    SeenShare least;
    for (const LinesAlong other : {LinesAlong::first_edge, LinesAlong::second_edge}) {
        LineSamples lines(a, b, between_, other,
                          hash_words({seed, static_cast<std::uint64_t>(other)}));
        lines.go_on_to(first_lines);
        const SeenShare seen = lines.seen();
        if (other == along || seen.variance < least.variance) {
            along = other;
            least = seen;
        }
    }
    const double enough = enough_lines(first_lines, free * std::sqrt(least.variance), allowed);
    std::uint32_t count = LineSamples::first_lines;
    while (count < max_lines && 1.4 * count < enough)
        count *= 2;
    LineSamples lines(a, b, between_, along, hash_words({seed, 2}));
    lines.go_on_to(count);
    const SeenShare seen = lines.seen();
    return {free * seen.share, free * std::sqrt(seen.variance), seen.share, count + 2 * first_lines,
            seen.clear_lines == seen.lines};
}

} // namespace hemilux
