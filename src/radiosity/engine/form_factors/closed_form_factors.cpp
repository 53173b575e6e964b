#include "radiosity/engine/form_factors/closed_form_factors.h"

#include "radiosity/engine/factors/rows/view_factors.h"
#include "radiosity/paper/scene/mesh.h"
#include "radiosity/paper/solving/solver.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace hemilux {
namespace {

/// Adds the pairs that are clear to the others of a patch.
void add_clear(const std::vector<FreePair>& free, std::vector<PairExchange>& pairs) {
    pairs.reserve(free.size());
    for (const FreePair& pair : free)
        if (pair.is_clear)
            pairs.push_back({pair.to, 0, pair.exchange});
    std::ranges::sort(pairs, {}, &PairExchange::to);
}

} // namespace

ClosedFormFactors::ClosedFormFactors(const Mesh& mesh, const Tracer& tracer, const Workers& workers,
                                     Monitor& monitor)
    : mesh_(mesh), tracer_(tracer), tree_(mesh.soup_to_trace(), {.threads = workers.threads()}),
      pairs_(find_free_pairs(mesh, tree_, workers, monitor)) {}

std::optional<double> ClosedFormFactors::factor(std::uint32_t i, std::uint32_t j) const {
    const std::vector<FreePair>& row = pairs_.rows[std::min(i, j)];
    const auto found = std::ranges::lower_bound(row, std::max(i, j), {}, &FreePair::to);
    if (found == row.end() || found->to != std::max(i, j))
        return 0.0;
    return found->is_clear ? std::optional(found->exchange / mesh_.patches()[i].area)
                           : std::nullopt;
}

std::vector<double> ClosedFormFactors::free_light(std::span<const double> leaving) const {
    const auto patches = mesh_.patches();
    std::vector<double> arriving(leaving.size());
    for (std::size_t i = 0; i < leaving.size(); ++i)
        for (const FreePair& pair : pairs_.rows[i]) {
            arriving[i] += pair.exchange * leaving[pair.to] / patches[i].area;
            arriving[pair.to] += pair.exchange * leaving[i] / patches[pair.to].area;
        }
    return arriving;
}

std::optional<ClosedFactors> ClosedFormFactors::batch(std::uint64_t seed, std::uint32_t rays,
                                                      const FactorTolerance& tolerance,
                                                      const Workers& workers,
                                                      Monitor& monitor) const {
    FoundExchange found = find_exchange(mesh_, tree_,
                                        {.rays = rays,
                                         .tolerance = tolerance,
                                         .seed = seed,
                                         .free_pairs = &pairs_,
                                         .through_panes = &tracer_},
                                        workers, monitor);
    if (monitor.interrupted)
        return std::nullopt;
    for (std::uint32_t i = 0; i < found.list.pairs.size(); ++i)
        add_clear(pairs_.rows[i], found.list.pairs[i]);
    const ClosingAudit audit = close_rows(found.list, rays);
    const std::size_t patches = mesh_.patches().size();
    std::vector<std::uint32_t> row_of(patches);
    std::iota(row_of.begin(), row_of.end(), 0U);
    ViewFactors factors = sum_over_rows(std::move(found.list), row_of, patches);
    ClosedFactors closed;
    closed.matrix = {std::move(factors.row_begin), std::move(factors.column),
                     std::move(factors.factor)};
    for (const std::array<OpenShare, opens>& open : factors.open) {
        const auto share = [&open](Open kind) {
            return open[static_cast<std::size_t>(kind)].factor;
        };
        closed.lost.push_back({share(Open::sky) + share(Open::ground), share(Open::back)});
    }
    closed.rays = found.work.rays;
    closed.unclosed = audit.unsolved;
    return closed;
}

} // namespace hemilux
