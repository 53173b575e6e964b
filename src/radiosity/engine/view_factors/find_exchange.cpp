#include "radiosity/engine/view_factors/find_exchange.h"

#include "geometry/elementary.h"
#include "radiosity/engine/view_factors/line_samples.h"
#include "radiosity/engine/view_factors/pair_hull.h"
#include "radiosity/engine/view_factors/pair_rays.h"
#include "radiosity/engine/view_factors/seen_pairs.h"
#include "radiosity/engine/view_factors/sky_bands.h"
#include "radiosity/paper/sampling/rng.h"
#include "radiosity/paper/scene/mesh.h"
#include "radiosity/paper/solving/solver.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>

namespace hemilux {
namespace {

/// A distance from a plane that counts as in it, in the unit of a scene in [-1,1]^3.
constexpr double plane_rounding = 1e-9;

/// The fewest and the most rays that look for each other between a pair that no ray of a row found.
constexpr std::uint32_t min_probes = 2, max_probes = 32;

/// A pair that needs no more rays than these is estimated by rays alone; so many are the least.
constexpr double max_pair_rays = 24;
constexpr std::uint32_t min_pair_rays = 4;

/// Rays of pairs of one row that are traced together.
constexpr std::size_t rays_at_a_time = 65'536;

/// Pairs whose factors are this share of their tolerance are not looked for.
constexpr double smallest_searched = .1;

/// Cells by which lines begin, and the most, in each of three dimensions.
constexpr unsigned first_cells = 2, max_cells = 10;

/// What finds the pairs of one row, with its memory; one for each thread.
class RowPairs {
  public:
    RowPairs(const Mesh& mesh, const WideBvh& tree, const ExchangeOptions& options,
             std::span<const FacePlane> faces, std::span<const std::vector<SeenPair>> seen,
             double scale)
        : mesh_(mesh), tree_(tree), options_(options), faces_(faces), seen_(seen), scale_(scale),
          rays_(tree), probes_(tree), is_seen_(faces.size()) {}

    /// Finds the pairs of a patch with those of higher index. `missed` gets for each the exchange
    /// of other pairs like it that were not found, as the chance of finding it says.
    void find(std::uint32_t i, std::vector<PairExchange>& pairs, std::vector<float>& missed);
    [[nodiscard]] const ExchangeWork& work() const { return work_; }

  private:
    struct Candidate {
        std::uint32_t to;
        Facing facing;
        double rough;
    };
    void look_for(std::uint32_t i);
    void probe(std::uint32_t i);
    [[nodiscard]] std::uint32_t probes_of(std::uint32_t i, const Candidate& pair) const;
    /// Returns the chance that a pair was found by no ray.
    [[nodiscard]] double missed_chance(std::uint32_t i, const Candidate& pair, double exchange,
                                       double share) const;
    void estimate(std::uint32_t i, const Candidate& pair, std::vector<PairExchange>& pairs);
    void trace_small(std::uint32_t i, std::vector<PairExchange>& pairs);
    void estimate_by_lines(std::uint32_t i, const Candidate& pair, double free,
                           std::vector<PairExchange>& pairs);
    void add(std::uint32_t i, const Candidate& candidate, double free, double share,
             double deviation, std::vector<PairExchange>& pairs);
    [[nodiscard]] std::uint64_t seed_of(std::uint32_t i, std::uint32_t j, std::uint64_t use) const {
        return hash_words({options_.seed, i, j, use});
    }
    [[nodiscard]] double tolerance(std::uint32_t i, std::uint32_t j, double exchange) const {
        const double smaller = std::min(faces_[i].area, faces_[j].area);
        return scale_ * smaller * options_.tolerance(i, j, exchange / smaller);
    }

    const Mesh& mesh_;
    const WideBvh& tree_;
    const ExchangeOptions& options_;
    std::span<const FacePlane> faces_;
    std::span<const std::vector<SeenPair>> seen_;
    double scale_; ///< of tolerances
    PairRays rays_, probes_;
    std::vector<bool> is_seen_; ///< by patch, of the row
    std::vector<Candidate> candidates_, unseen_;
    struct Small {
        std::size_t place; ///< in the row's pairs
        Candidate pair;
        double free;
    };
    std::vector<Small> small_;
    std::vector<float> missed_;
    std::vector<std::uint32_t> near_;
    std::vector<Polygon> between_;
    ExchangeWork work_;
};

std::uint32_t RowPairs::probes_of(std::uint32_t i, const Candidate& pair) const {
    const double wanted = pair.rough / (2 * tolerance(i, pair.to, 0));
    return std::clamp(static_cast<std::uint32_t>(std::min(wanted, 1e3)), min_probes, max_probes);
}

double RowPairs::missed_chance(std::uint32_t i, const Candidate& pair, double exchange,
                               double share) const {
    const double hits = options_.rays * exchange * (1 / faces_[i].area + 1 / faces_[pair.to].area);
    return elementary::exp(-hits) *
           elementary::whole_power(1 - std::min(share, 1.0), probes_of(i, pair));
}

/// Lists those of higher index that were seen from either side, and others that face the patch and
/// are large enough to count.
void RowPairs::look_for(std::uint32_t i) {
    candidates_.clear();
    unseen_.clear();
    for (const SeenPair& pair : seen_[i])
        is_seen_[pair.to] = true;
    const FacePlane& face = faces_[i];
    for (std::uint32_t j = i + 1; j < faces_.size(); ++j) {
        const bool seen = is_seen_[j];
        const double rough = rough_exchange(face, faces_[j]);
        if (!seen && !(rough > smallest_searched * tolerance(i, j, 0)))
            continue;
        const Facing facing = hemilux::facing(face, faces_[j], plane_rounding);
        if (facing != Facing::never)
            (seen ? candidates_ : unseen_).push_back({j, facing, rough});
    }
    for (const SeenPair& pair : seen_[i])
        is_seen_[pair.to] = false;
}

/// Adds those of the unseen that a few rays see after all.
void RowPairs::probe(std::uint32_t i) {
    constexpr std::size_t at_a_time = 4096;
    for (std::size_t begin = 0; begin < unseen_.size(); begin += at_a_time) {
        const std::size_t end = std::min(begin + at_a_time, unseen_.size());
        for (std::size_t k = begin; k < end; ++k) {
            const std::uint32_t j = unseen_[k].to;
            probes_.add(faces_[i], mesh_.patches()[i].facet, faces_[j], mesh_.patches()[j].facet,
                        probes_of(i, unseen_[k]), seed_of(i, j, 1));
        }
        work_.rays += probes_.size();
        probes_.trace([&](std::size_t pair, const PairRays::Share& share) {
            if (share.arrived > 0)
                candidates_.push_back(unseen_[begin + pair]);
        });
    }
    std::ranges::sort(candidates_, {}, &Candidate::to);
}

void RowPairs::find(std::uint32_t i, std::vector<PairExchange>& pairs, std::vector<float>& missed) {
    look_for(i);
    probe(i);
    missed_.clear();
    for (const Candidate& pair : candidates_) {
        estimate(i, pair, pairs);
        if (rays_.size() >= rays_at_a_time)
            trace_small(i, pairs);
    }
    trace_small(i, pairs);
    missed.assign(missed_.begin(), missed_.end());
}

/// Traces the rays of the pairs that are estimated by rays alone.
void RowPairs::trace_small(std::uint32_t i, std::vector<PairExchange>& pairs) {
    work_.rays += rays_.size();
    rays_.trace([&](std::size_t k, const PairRays::Share& share) {
        const Small& small = small_[k];
        PairExchange& pair = pairs[small.place];
        const double seen = share.all > 0 ? share.seen / share.all : 0;
        // So many rays of equal weight have the same variance. The prior is half a ray on either
        // side.
        const double n = share.squares > 0 ? share.all * share.all / share.squares : 0;
        const double p = (n * seen + .5) / (n + 1);
        // Divided by the chance that it was found, the sum over all pairs like it is right on
        // average.
        const double chance = 1 - missed_chance(i, small.pair, small.free * p, p);
        pair.exchange = small.free * (share.arrived > 0 ? seen : p) / chance;
        pair.deviation = static_cast<float>(small.free * std::sqrt(p * (1 - p) / (n + 1)) / chance);
    });
    work_.ray_pairs += small_.size();
    small_.clear();
}

/// Adds a pair that was not estimated by rays alone.
void RowPairs::add(std::uint32_t i, const Candidate& candidate, double free, double share,
                   double deviation, std::vector<PairExchange>& pairs) {
    const double exchange = free * share;
    const double chance = missed_chance(i, candidate, exchange, share);
    pairs.push_back({candidate.to, static_cast<float>(deviation), exchange});
    missed_.push_back(static_cast<float>(exchange * chance / std::max(1 - chance, .1)));
}

void RowPairs::estimate(std::uint32_t i, const Candidate& candidate,
                        std::vector<PairExchange>& pairs) {
    const std::uint32_t j = candidate.to;
    const FacePlane &a = faces_[i], &b = faces_[j];
    const double free = free_exchange(a, b, candidate.facing, FreeAccuracy::rough, plane_rounding);
    if (!(free > 0))
        return;
    const double allowed = tolerance(i, j, free);
    const double rays = elementary::pow(free / (2 * allowed), 1.6);
    if (rays <= max_pair_rays) {
        const auto count = std::max(static_cast<std::uint32_t>(std::ceil(rays)), min_pair_rays);
        rays_.add(a, mesh_.patches()[i].facet, b, mesh_.patches()[j].facet, count,
                  seed_of(i, j, 2));
        small_.push_back({pairs.size(), candidate, free});
        pairs.push_back({j, 0, 0});
        missed_.push_back(0);
        return;
    }
    ConvexPart of_a = part_of(a.shape), of_b = part_of(b.shape);
    if (candidate.facing == Facing::partly) {
        of_a = in_front(of_a, b.plane, plane_rounding);
        of_b = in_front(of_b, a.plane, plane_rounding);
        if (of_a.empty() || of_b.empty())
            return;
    }
    const double exact = free_exchange(a, b, candidate.facing, FreeAccuracy::exact, plane_rounding);
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
    if (between_.empty()) {
        ++work_.exact_pairs;
        add(i, candidate, exact, 1, 0, pairs);
        return;
    }
    estimate_by_lines(i, candidate, exact, pairs);
}

void RowPairs::estimate_by_lines(std::uint32_t i, const Candidate& candidate, double free,
                                 std::vector<PairExchange>& pairs) {
    const std::uint32_t j = candidate.to;
    LineSamples lines(faces_[i], faces_[j], between_);
    ++work_.line_pairs;
    std::uint64_t use = 3;
    const auto sample = [&](unsigned cells, LinesAlong along) {
        const SeenShare seen = lines.estimate(cells, along, seed_of(i, j, use++));
        work_.lines += seen.lines;
        return seen;
    };
    SeenShare seen = sample(first_cells, LinesAlong::first_edge);
    const SeenShare other = sample(first_cells, LinesAlong::second_edge);
    const bool by_first = seen.variance <= other.variance;
    if (!by_first)
        seen = other;
    for (unsigned cells = first_cells;;) {
        const double deviation = free * std::sqrt(seen.variance);
        const double wanted = tolerance(i, j, free * seen.share);
        if (cells == max_cells || deviation <= wanted) {
            if (seen.share > 0)
                add(i, candidate, free, seen.share, deviation, pairs);
            work_.clear_pairs += seen.clear_lines == seen.lines;
            return;
        }
        // The error falls about as the square of the cells.
        const double next = std::min(cells * std::sqrt(deviation / wanted), double(max_cells));
        cells = std::clamp(static_cast<unsigned>(std::ceil(next)), cells + 1, max_cells);
        seen = sample(cells, by_first ? LinesAlong::first_edge : LinesAlong::second_edge);
    }
}

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

/// Counts rows that are done, for whoever watches.
class RowsDone {
  public:
    RowsDone(Monitor& monitor, const char* phase, std::size_t rows)
        : monitor_(monitor), rows_(static_cast<double>(rows)) {
        monitor.step_share = 0;
        monitor.phase = phase;
    }
    void add(std::size_t count) {
        monitor_.step_share = static_cast<double>(done_ += count) / rows_;
    }

  private:
    Monitor& monitor_;
    double rows_;
    std::atomic<std::size_t> done_{0};
};

} // namespace

FactorTolerance relative_above(double error, double least) {
    return [error, least](std::uint32_t, std::uint32_t, double factor) {
        return error * std::max(factor, least);
    };
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
    RowsDone looked(monitor, "finding pairs", patches);
    workers.for_chunks_with(
        patches, 16, [&] { return RowRays(mesh, tree, options.seed, options.up, options.bands); },
        [&](RowRays& rays, std::size_t begin, std::size_t end) {
            RowView view;
            for (std::size_t i = begin; i < end && !monitor.interrupted.is_wished(); ++i) {
                rays.trace(static_cast<std::uint32_t>(i), options.rays, view);
                seen_patches[i].assign(view.seen.begin(), view.seen.end());
                memory.add_seen(view.seen.size());
                list.open[i] = view.open;
                std::ranges::copy(view.bands,
                                  list.bands.begin() + static_cast<std::ptrdiff_t>(i * bands));
            }
            monitor.rays += (end - begin) * options.rays;
            looked.add(end - begin);
        });
    found.is_void = monitor.interrupted.is_wished();
    if (found.is_void)
        return found;
    const std::vector<std::vector<SeenPair>> seen = pairs_of(std::move(seen_patches));
    std::vector<std::vector<float>> missed(patches);
    std::mutex mutex;
    const auto measure = [&](double scale) {
        std::vector<std::uint8_t> is_done(patches, 0);
        ExchangeWork& work = found.work; // pairs of this pass, rays and lines of all
        work.exact_pairs = work.line_pairs = work.ray_pairs = work.clear_pairs = 0;
        RowsDone measured(monitor, "measuring pairs", patches);
        workers.for_chunks_with(
            patches, 4, [&] { return RowPairs(mesh, tree, options, faces, seen, scale); },
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
