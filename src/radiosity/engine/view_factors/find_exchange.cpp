#include "radiosity/engine/view_factors/find_exchange.h"

#include "radiosity/engine/view_factors/row_pairs.h"
#include "radiosity/engine/view_factors/row_rays.h"
#include "radiosity/engine/view_factors/rows_done.h"
#include "radiosity/engine/view_factors/seen_pairs.h"
#include "radiosity/engine/view_factors/sky_bands.h"
#include "radiosity/paper/scene/mesh.h"
#include "radiosity/paper/solving/solver.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>

namespace hemilux {
namespace {

/// Factors far below those that are asked for may have so much larger errors, in absolute figures.
constexpr double below_least = 5;

/// Sums what was missed by row. A bound of it: what no ray of so many found is below three of them
/// in 95 % of all cases.
void find_unlisted(ExchangeList& list, const std::vector<std::vector<float>>& missed,
                   std::uint32_t rays) {
    list.unlisted.assign(list.area.size(), 0);
    for (std::size_t i = 0; i < missed.size(); ++i)
        for (std::size_t k = 0; k < missed[i].size(); ++k) {
            const std::uint32_t j = list.pairs[i][k].to;
            list.unlisted[i] += double(missed[i][k]) / list.area[i];
            list.unlisted[j] += double(missed[i][k]) / list.area[j];
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
    /// A patch that was seen, in two lists, one of which grows; a pair in the list, as terms of
    /// both rows and as factors of both.
    static constexpr std::uint64_t per_seen = 24, per_pair = 128;

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
    std::vector<FacePlane> faces;
    faces.reserve(patches);
    for (const Patch& patch : mesh.patches()) {
        faces.push_back(face_plane(patch.shape));
        list.area.push_back(patch.area);
    }
    list.open.resize(patches);
    const std::size_t bands = options.bands ? options.bands->size() : 0;
    list.bands.resize(patches * bands);
    list.pairs.resize(patches);
    PairsMemory memory(options.ask);
    std::vector<std::vector<SeenPatch>> seen_patches(patches);
    const RowScene scene{mesh, tree, options.seed, options.up, options.bands};
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
    const PairSearch search{mesh, tree, options, faces, groups, seen};
    std::vector<std::vector<float>> missed(patches);
    std::mutex mutex;
    const auto measure = [&](double scale) {
        std::vector<std::uint8_t> is_done(patches, 0);
        ExchangeWork& work = found.work; // pairs of this pass, rays and lines of all
        work.exact_pairs = work.line_pairs = work.ray_pairs = work.clear_pairs = 0;
        RowsDone measured(monitor, "measuring pairs", patches);
        workers.for_chunks_with(
            patches, 4, [&] { return RowPairs(search, scale); },
            [&](RowPairs& row, std::size_t begin, std::size_t end) {
                const ExchangeWork before = row.work();
                for (std::size_t i = begin; i < end && !monitor.interrupted; ++i) {
                    const std::size_t known = list.pairs[i].size();
                    list.pairs[i].clear();
                    row.find(static_cast<std::uint32_t>(i), list.pairs[i], missed[i]);
                    list.pairs[i].shrink_to_fit();
                    memory.add_pairs(std::max(list.pairs[i].size(), known) - known);
                    is_done[i] = 1;
                }
                const ExchangeWork& now = row.work();
                monitor.rays += now.rays - before.rays;
                measured.add(end - begin);
                const std::lock_guard lock(mutex);
                work.rays += now.rays - before.rays;
                work.lines += now.lines - before.lines;
                work.exact_pairs += now.exact_pairs - before.exact_pairs;
                work.line_pairs += now.line_pairs - before.line_pairs;
                work.ray_pairs += now.ray_pairs - before.ray_pairs;
                work.clear_pairs += now.clear_pairs - before.clear_pairs;
            });
        return is_done;
    };
    std::vector<std::uint8_t> is_known(patches, 0);
    const auto pass = [&](double scale) {
        const std::vector<std::uint8_t> is_done = measure(scale);
        for (std::size_t i = 0; i < patches; ++i)
            is_known[i] |= is_done[i];
        return static_cast<std::uint64_t>(
            std::count(is_done.begin(), is_done.end(), std::uint8_t{0}));
    };
    found.work.rows_left = patches;
    for (const double scale : options.before)
        if (!monitor.interrupted)
            pass(scale);
    if (!monitor.interrupted)
        found.work.rows_left = pass(1);
    for (std::uint32_t i = 0; i < patches; ++i)
        if (is_known[i] == 0)
            pairs_by_rays(i, faces, seen[i], options.rays, list.pairs[i], missed[i]);
    found.work.rays += patches * options.rays;
    find_unlisted(list, missed, options.rays);
    return found;
}

} // namespace hemilux
