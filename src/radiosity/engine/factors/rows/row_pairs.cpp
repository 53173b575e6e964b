#include "radiosity/engine/factors/rows/row_pairs.h"

#include "geometry/elementary.h"
#include "radiosity/engine/rays/receivers.h"
#include "radiosity/paper/scene/mesh.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hemilux {
namespace {

/// The fewest and the most rays that look for each other between a pair that no ray of a row found.
constexpr std::uint32_t min_probes = 1, max_probes = 32;

/// A pair that needs no more rays than these is estimated by rays alone; so many are the least.
/// Light through panes is always estimated by rays, by so many at most.
constexpr double max_pair_rays = 24, max_rays_through_panes = 4096;
constexpr std::uint32_t min_pair_rays = 4;

/// Rays of pairs of one row that are traced together.
constexpr std::size_t pair_rays_at_a_time = 65'536;

/// Pairs whose factors are this share of their tolerance are not looked for.
constexpr double smallest_searched = .6;

/// A line says as much as so many rays.
constexpr double rays_of_line = 4;

void count_lines(const PairEstimate& found, PairWork& work) {
    work.lines += found.lines;
    ++(found.lines > 0 ? work.line_pairs : work.exact_pairs);
    work.clear_pairs += found.is_clear ? 1 : 0;
}

} // namespace

/// Returns how many rays look for a pair; 0 where it is too small to be looked for.
std::uint32_t RowPairs::probes_of(double bound, double tolerance) const {
    if (!(bound > smallest_searched * tolerance))
        return 0;
    const double wanted = bound / (2 * tolerance);
    return std::clamp(static_cast<std::uint32_t>(std::min(wanted, 1e3)), min_probes, max_probes);
}

double RowPairs::missed_chance(std::uint32_t i, const Candidate& pair, double exchange,
                               double share) const {
    const double hits = options_.rays * exchange * (1 / faces_[i].area + 1 / faces_[pair.to].area);
    return elementary::exp(-hits) * elementary::whole_power(1 - std::min(share, 1.0), pair.probes);
}

/// Lists those of higher index that were seen from either side, and others that face the patch and
/// are large enough to count.
void RowPairs::look_for(std::uint32_t i) {
    candidates_.clear();
    unseen_.clear();
    if (options_.free_pairs)
        return list_hidden(i);
    const FacePlane& face = faces_[i];
    const auto add = [&](std::uint32_t j, std::vector<Candidate>& list, std::uint32_t least) {
        const std::uint32_t probes = probes_of(exchange_bound(face, faces_[j]), tolerance(i, j, 0));
        if (probes < least)
            return;
        const Facing facing = hemilux::facing(face, faces_[j], HiddenExchange::plane_rounding);
        if (facing != Facing::never)
            list.push_back({j, facing, probes, 0, 0});
    };
    for (const SeenPair& pair : seen_[i]) {
        is_seen_[pair.to] = true;
        add(pair.to, candidates_, 0);
    }
    groups_.for_each(i, smallest_searched * scale_ * options_.tolerance.least,
                     [&](std::uint32_t j) {
                         if (!is_seen_[j])
                             add(j, unseen_, 1);
                     });
    for (const SeenPair& pair : seen_[i])
        is_seen_[pair.to] = false;
}

/// Lists those of higher index that face the patch and are not clear.
void RowPairs::list_hidden(std::uint32_t i) {
    auto seen = seen_[i].begin();
    for (const FreePair& pair : options_.free_pairs->rows[i]) {
        if (pair.is_clear)
            continue;
        while (seen != seen_[i].end() && seen->to < pair.to)
            ++seen;
        const bool is_seen = seen != seen_[i].end() && seen->to == pair.to;
        const Facing facing =
            hemilux::facing(faces_[i], faces_[pair.to], HiddenExchange::plane_rounding);
        candidates_.push_back({pair.to, facing, 0, pair.exchange, is_seen ? seen->rays : 0});
    }
}

/// Returns the mean of what rays of both patches and rays or lines between them say of a pair, of
/// which a share was seen. The weights do not depend on what either met: so it is right on average.
/// `variance` is that of the share, `rays` so many independent ones with the same.
PairExchange RowPairs::pooled(std::uint32_t i, const Candidate& pair, double share, double variance,
                              double rays) const {
    // If nothing hid a part so many rays of both patches would have hit the other.
    const double hits = options_.rays * pair.free * (1 / faces_[i].area + 1 / faces_[pair.to].area);
    const double all = hits + rays;
    const double seen = (pair.hits + rays * share) / all;
    const double p = (all * std::min(seen, 1.0) + .5) / (all + 1);
    const double deviation =
        elementary::hypot(std::sqrt(p * (1 - p) * hits), rays * std::sqrt(variance)) / all;
    return {pair.to, static_cast<float>(pair.free * deviation), pair.free * seen};
}

/// Adds those of the unseen that a few rays see after all.
void RowPairs::probe(std::uint32_t i, MeasuredRow& row) {
    constexpr std::size_t at_a_time = 4096;
    for (std::size_t begin = 0; begin < unseen_.size(); begin += at_a_time) {
        const std::size_t end = std::min(begin + at_a_time, unseen_.size());
        for (std::size_t k = begin; k < end; ++k) {
            const std::uint32_t j = unseen_[k].to;
            probes_.add(faces_[i], mesh_.patches()[i].facet, faces_[j], mesh_.patches()[j].facet,
                        unseen_[k].probes, seed_of(i, j, 1));
        }
        row.work.rays += probes_.size();
        probes_.trace([&](std::size_t pair, const PairRays::Share& share) {
            if (share.arrived > 0)
                candidates_.push_back(unseen_[begin + pair]);
        });
    }
    std::ranges::sort(candidates_, {}, &Candidate::to);
}

void RowPairs::measure(std::uint32_t i, MeasuredRow& row) {
    row.scale = scale_;
    row.work = {.rays = row.work.rays, .lines = row.work.lines};
    row.pairs.clear();
    row.missed.clear();
    look_for(i);
    probe(i, row);
    for (const Candidate& pair : candidates_) {
        estimate(i, pair, row);
        if (rays_.size() >= pair_rays_at_a_time)
            trace_small(i, row);
    }
    trace_small(i, row);
    row.pairs.shrink_to_fit();
    row.missed.shrink_to_fit();
}

/// Traces the rays of the pairs that are estimated by rays alone.
void RowPairs::trace_small(std::uint32_t i, MeasuredRow& row) {
    row.work.rays += rays_.size();
    rays_.trace([&](std::size_t k, const PairRays::Share& share) {
        const Small& small = small_[k];
        PairExchange& pair = row.pairs[small.place];
        const double seen = share.all > 0 ? share.seen / share.all : 0;
        // So many rays of equal weight have the same variance. The prior is half a ray on either
        // side.
        const double n = share.squares > 0 ? share.all * share.all / share.squares : 0;
        const double p = (n * seen + .5) / (n + 1);
        if (options_.free_pairs) {
            // The ratio to the whole kernel of so few rays would not be right on average.
            const double areas = faces_[i].area * faces_[pair.to].area;
            const double of_free =
                share.seen * areas / (std::numbers::pi * small.rays * small.free);
            pair = pooled(i, small.pair, of_free, p * (1 - p) / (n + 1), small.rays);
            return;
        }
        const double exchange = small.free * (share.arrived > 0 ? seen : p);
        const double deviation = small.free * std::sqrt(p * (1 - p) / (n + 1));
        // Divided by the chance that it was found, the sum over all pairs like it is right on
        // average. The pair itself is then too large by as much; where that is more than it may be,
        // pairs like it are not listed.
        const double missed = missed_chance(i, small.pair, small.free * p, p);
        const double found = std::max(1 - missed, 1e-3), whole = exchange / found;
        const bool stands_for_others = missed * whole <= tolerance(i, pair.to, whole);
        pair.exchange = stands_for_others ? whole : exchange;
        pair.deviation = static_cast<float>(
            stands_for_others ? elementary::hypot(deviation, missed * exchange) / found
                              : deviation);
        row.missed[small.place] = stands_for_others ? 0 : static_cast<float>(missed * whole);
    });
    row.work.ray_pairs += small_.size();
    small_.clear();
}

void RowPairs::estimate(std::uint32_t i, const Candidate& candidate, MeasuredRow& row) {
    const std::uint32_t j = candidate.to;
    const FacePlane &a = faces_[i], &b = faces_[j];
    const auto free_of = [&](FreeAccuracy accuracy) {
        return candidate.free > 0 ? candidate.free
                                  : free_exchange(a, b, candidate.facing, accuracy,
                                                  HiddenExchange::plane_rounding);
    };
    const double free = free_of(FreeAccuracy::rough);
    if (!(free > 0))
        return;
    const double rays =
        std::min(elementary::pow(free / (2 * tolerance(i, j, free)), 1.6), max_rays_through_panes);
    if (rays <= max_pair_rays || hidden_.is_dimmed(a, b, candidate.facing)) {
        const auto count = std::max(static_cast<std::uint32_t>(std::ceil(rays)),
                                    options_.free_pairs ? 1 : min_pair_rays);
        rays_.add(a, mesh_.patches()[i].facet, b, mesh_.patches()[j].facet, count,
                  seed_of(i, j, 2));
        small_.push_back({row.pairs.size(), count, candidate, free});
        row.pairs.push_back({j, 0, 0});
        row.missed.push_back(0);
        return;
    }
    if (options_.free_pairs) {
        const PairEstimate found = hidden_.unbiased(i, a, j, b, candidate.facing, free,
                                                    seed_of(i, j, 3), tolerance(i, j, free));
        count_lines(found, row.work);
        const double deviation = found.deviation / free;
        row.pairs.push_back(
            pooled(i, candidate, found.share, deviation * deviation, rays_of_line * found.lines));
        row.missed.push_back(0);
        return;
    }
    const PairEstimate found = hidden_.between(
        i, a, j, b, candidate.facing, free_of(FreeAccuracy::exact), seed_of(i, j, 3),
        [&](double exchange) { return tolerance(i, j, exchange); });
    count_lines(found, row.work);
    if (!(found.exchange > 0))
        return;
    const double missed = missed_chance(i, candidate, found.exchange, found.share);
    row.pairs.push_back({j, static_cast<float>(found.deviation), found.exchange});
    row.missed.push_back(static_cast<float>(found.exchange * missed / std::max(1 - missed, .1)));
}

} // namespace hemilux
