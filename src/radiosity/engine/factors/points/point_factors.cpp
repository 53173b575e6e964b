#include "radiosity/engine/factors/points/point_factors.h"

#include "geometry/frame.h"
#include "radiosity/engine/factors/points/target_view.h"
#include "radiosity/engine/factors/rows/sky_bands.h"
#include "radiosity/engine/sampling/sobol.h"
#include "radiosity/paper/rays/shot.h"
#include "radiosity/paper/scene/mesh.h"
#include "radiosity/paper/solving/solver.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <map>

namespace hemilux {
namespace {

/// Facets whose factor is below this share of the smallest tolerance are left to rays.
constexpr double smallest_searched = .1;

std::vector<PointTarget> targets_of(const Mesh& mesh, std::span<const std::uint32_t> row_of) {
    std::vector<PointTarget> targets;
    for (std::size_t i = 0; i < mesh.patches().size(); ++i)
        targets.push_back(
            {face_plane(mesh.patches()[i].shape), mesh.patches()[i].facet, row_of[i]});
    for (std::uint32_t facet = 0; facet < mesh.scene().facets.size(); ++facet)
        if (!mesh.has_back(facet))
            targets.push_back({face_plane(mesh.shape_of(facet).flipped()), facet, none});
    return targets;
}

/// Finds the rows of points, with its memory; one for each thread.
class PointView {
  public:
    PointView(const Mesh& mesh, const WideBvh& tree, std::span<const PointTarget> targets,
              const PointFactorOptions& options)
        : tree_(tree), targets_(targets), options_(options), view_(mesh, tree, options),
          is_hit_(mesh.scene().facets.size()) {}

    [[nodiscard]] PointFactors row_of(const FactorPoint& point, std::uint64_t index);

  private:
    void find_candidates(std::uint64_t seed);
    void trace(std::uint64_t seed);
    [[nodiscard]] std::vector<OpenShare> find_bands(double sky, std::uint64_t seed);

    const WideBvh& tree_;
    std::span<const PointTarget> targets_;
    const PointFactorOptions& options_;

    TargetView view_;
    FactorPoint point_{};
    double skipped_ = 0;                            ///< bound of the factors that are left out
    std::vector<std::uint32_t> candidates_, small_; ///< targets
    std::vector<bool> is_hit_;                      ///< by facet, by the rays of the point
    std::vector<Ray> rays_;
    std::vector<FacetHit> hits_;
};

void PointView::trace(std::uint64_t seed) {
    rays_.clear();
    const Frame frame = Frame::from_normal(point_.normal);
    SobolBlocks<4> places(seed);
    for (std::uint32_t k = 0; k < options_.rays; ++k) {
        const std::array<double, 4> u = places.at(k);
        rays_.push_back({.origin = point_.position,
                         .direction = frame.to_world(cosine_direction({u[0], u[1]})),
                         .from = point_.facet});
    }
    hits_.resize(rays_.size());
    tree_.closest_stream(rays_, hits_);
}

/// Lists the targets that count, or that a ray hit.
void PointView::find_candidates(std::uint64_t seed) {
    candidates_.clear();
    small_.clear();
    skipped_ = 0;
    const double counts = smallest_searched * options_.error * options_.least;
    double small_sum = 0;
    for (std::uint32_t t = 0; t < targets_.size(); ++t) {
        const double rough = rough_factor(point_, targets_[t]);
        if (rough > counts)
            candidates_.push_back(t);
        else if (rough > 0) {
            small_.push_back(t);
            small_sum += rough;
        }
    }
    if (small_.empty())
        return;
    trace(seed);
    for (const FacetHit& hit : hits_)
        if (hit.facet != none)
            is_hit_[hit.facet] = true;
    for (const std::uint32_t t : small_)
        if (is_hit_[targets_[t].facet])
            candidates_.push_back(t);
    for (const FacetHit& hit : hits_)
        if (hit.facet != none)
            is_hit_[hit.facet] = false;
    // What no ray of so many hit is below three of them in 95 % of all cases.
    skipped_ = std::min(small_sum, 3.0 / options_.rays);
}

/// Makes the sum of a row 1 where sampled factors, or rounding, made it more than 1.
void take_excess(PointFactors& row) {
    const double excess = row.sum() - 1;
    double variance = 0;
    for (const double error : row.standard_error)
        variance += error * error;
    if (excess > 0 && variance > 0)
        for (std::size_t k = 0; k < row.factor.size(); ++k) {
            const double part = row.standard_error[k] * row.standard_error[k] / variance;
            row.factor[k] = std::max(row.factor[k] - part * excess, 0.0);
        }
    const double sum = row.sum();
    if (!(sum > 0))
        return;
    for (double& factor : row.factor)
        factor /= sum;
    for (OpenShare& open : row.open)
        open.factor /= sum;
}

PointFactors PointView::row_of(const FactorPoint& point, std::uint64_t index) {
    point_ = point;
    view_.move_to(point);
    find_candidates(hash_words({options_.seed, index, 1}));
    std::map<std::uint32_t, SeenFactor> by_column;
    SeenFactor all;
    for (const std::uint32_t t : candidates_) {
        const SeenFactor seen = view_.see(targets_[t], hash_words({options_.seed, index, 2, t}));
        if (!(seen.factor > 0 || seen.variance > 0))
            continue;
        for (SeenFactor* sum : {&by_column[targets_[t].column], &all}) {
            sum->factor += seen.factor;
            sum->variance += seen.variance;
            sum->above += seen.above;
        }
    }
    PointFactors row;
    row.is_known = true;
    row.unlisted_bound = skipped_;
    for (const auto& [column, seen] : by_column) {
        if (column == none) {
            row.open[static_cast<std::size_t>(Open::back)] = {seen.factor,
                                                              std::sqrt(seen.variance)};
            continue;
        }
        row.column.push_back(column);
        row.factor.push_back(seen.factor);
        row.standard_error.push_back(std::sqrt(seen.variance));
    }
    // Of two standard errors, what is not listed takes one.
    const double deviation = std::sqrt(all.variance + skipped_ * skipped_ / 4);
    const double of_sky = (1 + point.normal[options_.up]) / 2;
    const auto left = [deviation](double whole, double taken) {
        constexpr double rounding = 1e-11;
        const double rest = whole - taken;
        return OpenShare{rest > rounding ? rest : 0, whole > rounding ? deviation : 0};
    };
    row.open[static_cast<std::size_t>(Open::sky)] = left(of_sky, all.above);
    row.open[static_cast<std::size_t>(Open::ground)] = left(1 - of_sky, all.factor - all.above);
    take_excess(row);
    if (options_.bands)
        row.bands = find_bands(row.open[static_cast<std::size_t>(Open::sky)].factor,
                               hash_words({options_.seed, index, 1}));
    return row;
}

/// Divides the sky as the point's rays do that leave upwards.
std::vector<OpenShare> PointView::find_bands(double sky, std::uint64_t seed) {
    trace(seed);
    std::vector<std::uint32_t> counts(options_.bands->size());
    for (std::size_t k = 0; k < rays_.size(); ++k)
        if (hits_[k].facet == none && rays_[k].direction[options_.up] > 0)
            ++counts[options_.bands->of(rays_[k].direction)];
    std::vector<OpenShare> shares = shares_of(counts, options_.rays);
    scale_to_sum(shares, sky);
    return shares;
}

} // namespace

double PointFactors::sum() const {
    double sum = 0;
    for (const OpenShare& share : open)
        sum += share.factor;
    for (const double of_surface : factor)
        sum += of_surface;
    return sum;
}

std::vector<PointFactors> point_factors(std::span<const FactorPoint> points, const Mesh& mesh,
                                        const WideBvh& tree, std::span<const std::uint32_t> row_of,
                                        const PointFactorOptions& options, const Workers& workers,
                                        Monitor& monitor) {
    const std::vector<PointTarget> targets = targets_of(mesh, row_of);
    std::vector<PointFactors> rows(points.size());
    monitor.step_share = 0;
    monitor.phase = "points";
    constexpr double bytes_of_entry = 2 * (sizeof(std::uint32_t) + 2 * sizeof(double)); // and files
    std::atomic<std::size_t> done{0}, entries{0};
    workers.for_chunks_with(
        points.size(), 1, [&] { return PointView(mesh, tree, targets, options); },
        [&](PointView& view, std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end && !monitor.interrupted; ++i) {
                rows[i] = view.row_of(points[i], i);
                const std::size_t sum = entries += rows[i].column.size();
                if (options.ask)
                    options.ask(bytes_of_entry * static_cast<double>(sum));
            }
            monitor.step_share =
                static_cast<double>(done += end - begin) / static_cast<double>(points.size());
        });
    return rows;
}

} // namespace hemilux
