#include "radiosity/engine/factors/rows/find_exchange.h"

#include "radiosity/engine/factors/rows/row_pairs.h"
#include "radiosity/engine/factors/rows/row_rays.h"
#include "radiosity/engine/factors/rows/rows_done.h"
#include "radiosity/engine/factors/rows/seen_pairs.h"
#include "radiosity/engine/factors/rows/sky_bands.h"
#include "radiosity/engine/rays/panes.h"
#include "radiosity/paper/scene/mesh.h"
#include "radiosity/paper/solving/solver.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>

namespace hemilux {
namespace {

/// Factors far below those that are asked for may have so much larger errors, in absolute figures.
constexpr double below_least = 5;

/// Sums what was missed by row. A bound of it: what no ray of so many found is below three of them
/// in 95 % of all cases.
void find_unlisted(ExchangeList& list, std::span<const MeasuredRow> measured, std::uint32_t rays) {
    list.unlisted.assign(list.area.size(), 0);
    for (std::size_t i = 0; i < measured.size(); ++i)
        for (std::size_t k = 0; k < measured[i].missed.size(); ++k) {
            const double missed = measured[i].missed[k];
            const std::uint32_t j = measured[i].pairs[k].to;
            list.unlisted[i] += missed / list.area[i];
            list.unlisted[j] += missed / list.area[j];
        }
    for (const double expected : list.unlisted)
        list.unlisted_bound.push_back(2 * expected + 3.0 / rays);
}

/// Counts what is found, and asks whether it may be that much.
class PairsMemory {
  public:
    explicit PairsMemory(const std::function<void(double bytes)>& ask) : ask_(ask) {}
    void add_seen(std::size_t count) { add(per_seen * count); }
    void add_pairs(std::size_t count) { add(per_pair * count); }

  private:
    /// A patch that was seen, in two lists, one of which grows; a pair in the list, and in both
    /// rows of the factors while the list is freed.
    static constexpr std::uint64_t per_seen = 24, per_pair = 72;

    void add(std::uint64_t bytes) {
        const std::uint64_t sum = bytes_ += bytes;
        if (ask_)
            ask_(static_cast<double>(sum));
    }
    const std::function<void(double bytes)>& ask_;
    std::atomic<std::uint64_t> bytes_{0};
};

} // namespace

FactorTolerance relative_above(double error, double least) {
    return {below_least * error * least,
            [error, least](std::uint32_t, std::uint32_t, double factor) {
                if (factor >= least)
                    return error * factor;
                const double ratio = least / factor;
                return error * least * std::min(ratio * ratio, below_least);
            }};
}

FoundExchange find_exchange(const Mesh& mesh, const WideBvh& tree, const ExchangeOptions& options,
                            const Workers& workers, Monitor& monitor) {
    const std::size_t patches = mesh.patches().size();
    FoundExchange found;
    ExchangeList& list = found.list;
    const std::vector<FacePlane> faces = face_planes(mesh);
    for (const Patch& patch : mesh.patches())
        list.area.push_back(patch.area);
    list.has_all_pairs = options.free_pairs != nullptr;
    list.open.resize(patches);
    const std::size_t bands = options.bands ? options.bands->size() : 0;
    list.bands.resize(patches * bands);
    PairsMemory memory(options.ask);
    std::vector<std::vector<SeenPatch>> seen_patches(patches);
    const FacingBacks backs(mesh);
    const Tracer& tracer = options.through_panes ? *options.through_panes : tree;
    const std::vector<Polygon> panes =
        options.through_panes ? local_panes(mesh) : std::vector<Polygon>{};
    const RowScene scene{mesh, tracer, backs, options.seed, options.up, options.bands};
    found.is_void = !trace_all_rows(
        scene, options.rays, "finding pairs", workers, monitor,
        [&](std::uint32_t i, const RowView& view) {
            seen_patches[i].assign(view.seen.begin(), view.seen.end());
            memory.add_seen(view.seen.size());
            list.open[i] = view.open;
            std::ranges::copy(view.bands,
                              list.bands.begin() + static_cast<std::ptrdiff_t>(i * bands));
        });
    if (found.is_void)
        return found;
    const std::vector<std::vector<SeenPair>> seen = pairs_of(std::move(seen_patches));
    const FacingPatches groups(faces);
    const PairSearch search{mesh, tree, tracer, panes, options, faces, groups, seen};
    std::vector<MeasuredRow> rows(patches);
    if (options.load)
        options.load(rows);
    for (const MeasuredRow& row : rows)
        if (row.is_measured())
            memory.add_pairs(row.pairs.size());
    const auto pass = [&](double scale) {
        RowsDone measured(monitor, "measuring pairs", patches);
        const std::size_t rows_at_a_time = std::size_t{256} * workers.threads();
        for (std::size_t first = 0; first < patches && !monitor.interrupted;
             first += rows_at_a_time) {
            const std::span some =
                std::span(rows).subspan(first, std::min(rows_at_a_time, patches - first));
            workers.for_chunks_with(
                some.size(), 4, [&] { return RowPairs(search, scale); },
                [&](RowPairs& pairs, std::size_t begin, std::size_t end) {
                    for (std::size_t k = begin; k < end && !monitor.interrupted; ++k) {
                        MeasuredRow& row = some[k];
                        if (row.scale <= scale)
                            continue;
                        const std::size_t known = row.pairs.size();
                        const std::uint64_t rays = row.work.rays;
                        pairs.measure(static_cast<std::uint32_t>(first + k), row);
                        memory.add_pairs(std::max(row.pairs.size(), known) - known);
                        monitor.rays += row.work.rays - rays;
                    }
                    measured.add(end - begin);
                });
            if (options.keep)
                options.keep(rows, false);
        }
    };
    for (const double scale : options.before)
        pass(scale);
    pass(1);
    if (options.keep)
        options.keep(rows, true);
    for (std::uint32_t i = 0; i < patches; ++i) {
        MeasuredRow& row = rows[i];
        if (!row.is_measured())
            pairs_by_rays(i, faces, seen[i], options.rays, row.pairs, row.missed);
        found.work += row.work;
        found.work.rows_left += row.scale > 1 ? 1 : 0;
    }
    found.work.rays += patches * options.rays;
    find_unlisted(list, rows, options.rays);
    for (MeasuredRow& row : rows)
        list.pairs.push_back(std::move(row.pairs));
    return found;
}

} // namespace hemilux
