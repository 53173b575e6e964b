#include "radiosity/engine/point_views/point_factors.h"

#include "geometry/frame.h"
#include "geometry/projected_polygon.h"
#include "radiosity/engine/point_views/seen_part.h"
#include "radiosity/engine/sampling/sobol.h"
#include "radiosity/engine/view_factors/free_exchange.h"
#include "radiosity/engine/view_factors/sky_bands.h"
#include "radiosity/paper/rays/shot.h"
#include "radiosity/paper/scene/mesh.h"
#include "radiosity/paper/solving/solver.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <map>
#include <numbers>

namespace hemilux {
namespace {

/// A height over a plane that counts as in it, in the unit of a scene in [-1,1]^3.
constexpr double height_rounding = 1e-9;

/// So many facets in between are cut out; beyond, rays are as exact as need be.
constexpr std::size_t max_covers = 256;

/// Facets whose factor is below this share of the smallest tolerance are left to rays.
constexpr double smallest_searched = .1;

/// A side of a facet or of a part of it, as a point may see it.
struct Target {
    FacePlane face;
    std::uint32_t facet;
    std::uint32_t column; ///< surface; none: back of a one-sided facet
};

std::vector<Target> targets_of(const Mesh& mesh, std::span<const std::uint32_t> row_of) {
    std::vector<Target> targets;
    for (std::size_t i = 0; i < mesh.patches().size(); ++i)
        targets.push_back(
            {face_plane(mesh.patches()[i].shape), mesh.patches()[i].facet, row_of[i]});
    for (std::uint32_t facet = 0; facet < mesh.scene().facets.size(); ++facet)
        if (!mesh.has_back(facet))
            targets.push_back({face_plane(mesh.shape_of(facet).flipped()), facet, none});
    return targets;
}

/// Returns about the factor of a target that nothing hides, rather too large than too small.
double rough_factor(const FactorPoint& point, const Target& target) {
    const Vec3 d = target.face.centre - point.position;
    const double height = target.face.plane.height(point.position);
    const double rise = glm::dot(d, point.normal) + target.face.radius;
    if (!(height > height_rounding && rise > height_rounding))
        return 0;
    const double radius = target.face.radius;
    const double square = std::max(glm::dot(d, d) - radius * radius, radius * radius);
    return std::min(height * rise * target.face.area / (square * square * std::numbers::pi), 1.0);
}

/// Returns the factor of a piece of the hemisphere, whose corners are in the point's frame.
double factor_of(const ConvexPart& piece) {
    double sum = 0;
    for (std::size_t k = 0; k < piece.size; ++k)
        sum += edge_term(piece.corner[k], piece.next(k));
    return std::abs(sum) / (2 * std::numbers::pi);
}

/// What is seen of a target: a factor, its variance, and how much of it is above the level of the
/// point, towards the sky.
struct Seen {
    double factor = 0, variance = 0, above = 0;
};

/// Finds the rows of points, with its memory; one for each thread.
class PointView {
  public:
    PointView(const Mesh& mesh, const WideBvh& tree, std::span<const Target> targets,
              const PointFactorOptions& options)
        : mesh_(mesh), tree_(tree), targets_(targets), options_(options),
          is_hit_(mesh.scene().facets.size()) {}

    [[nodiscard]] PointFactors row_of(const FactorPoint& point, std::uint64_t index);

  private:
    struct Cover {
        ConvexPart part;
        double factor;
    };
    void find_candidates(std::uint64_t seed);
    void trace(std::uint64_t seed);
    [[nodiscard]] std::vector<OpenShare> find_bands(double sky, std::uint64_t seed);
    [[nodiscard]] ConvexPart directions_of(const ConvexPart& part) const;
    [[nodiscard]] Seen see(const Target& target, std::uint64_t seed);
    [[nodiscard]] ConvexPart cover_of(std::uint32_t facet, const Target& target) const;
    [[nodiscard]] bool is_hidden_by_one(const Target& target, const ConvexPart& whole);
    void find_covers(const Target& target, const ConvexPart& part);
    [[nodiscard]] bool cut_out(const ConvexPart& whole);
    [[nodiscard]] Seen by_rays(const Target& target, double free, std::uint64_t seed) const;

    const Mesh& mesh_;
    const WideBvh& tree_;
    std::span<const Target> targets_;
    const PointFactorOptions& options_;

    FactorPoint point_{};
    Frame frame_{};
    Plane horizon_{};
    Vec3 up_{}; ///< in the point's frame
    double skipped_ = 0;
    std::vector<std::uint32_t> candidates_, small_; ///< targets
    std::vector<bool> is_hit_;                      ///< by facet, by the rays of the point
    std::vector<Ray> rays_;
    std::vector<FacetHit> hits_;
    std::vector<std::uint32_t> near_;
    std::vector<Cover> covers_;
    SeenPart seen_;
};

void PointView::trace(std::uint64_t seed) {
    rays_.clear();
    SobolBlocks<4> places(seed);
    for (std::uint32_t k = 0; k < options_.rays; ++k) {
        const std::array<double, 4> u = places.at(k);
        rays_.push_back({.origin = point_.position,
                         .direction = frame_.to_world(cosine_direction({u[0], u[1]})),
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

ConvexPart PointView::directions_of(const ConvexPart& part) const {
    ConvexPart directions;
    for (const Vec3& corner : part.corners())
        directions.add(frame_.to_local(corner - point_.position));
    return directions;
}

/// Returns the directions in which a facet lies in front of a target; empty where it does not.
ConvexPart PointView::cover_of(std::uint32_t facet, const Target& target) const {
    if (facet == target.facet || facet == point_.facet)
        return {};
    const ConvexPart above = in_front(part_of(mesh_.shape_of(facet)), horizon_, height_rounding);
    if (above.empty())
        return {};
    const ConvexPart cover = in_front(above, target.face.plane, height_rounding);
    return cover.empty() ? cover : directions_of(cover);
}

/// Returns whether the facet that hides the middle of a target hides all of it, as most of those do
/// that are not seen.
bool PointView::is_hidden_by_one(const Target& target, const ConvexPart& whole) {
    Vec3 middle(0.0);
    for (const Vec3& corner : whole.corners())
        middle += corner / static_cast<double>(whole.size);
    const auto hit = tree_.closest({.origin = point_.position,
                                    .direction = frame_.to_world(middle),
                                    .t_max = 1,
                                    .from = point_.facet});
    if (!hit)
        return false;
    const ConvexPart cover = cover_of(hit->facet, target);
    seen_.begin(whole);
    return !cover.empty() && seen_.hide(cover) && seen_.pieces().empty();
}

/// Collects what lies in front of a target, the largest first.
void PointView::find_covers(const Target& target, const ConvexPart& part) {
    Shaft room;
    room.add(-horizon_.normal, -glm::dot(horizon_.normal, horizon_.point) - height_rounding);
    const Plane& plane = target.face.plane;
    room.add(-plane.normal, -glm::dot(plane.normal, plane.point) - height_rounding);
    for (std::size_t k = 0; k < part.size; ++k) {
        // Corners run counter-clockwise as the point sees them.
        const Vec3 outwards =
            glm::cross(part.corner[k] - point_.position, part.next(k) - part.corner[k]);
        const double length = glm::length(outwards);
        if (length > 0)
            room.add(outwards / length, glm::dot(outwards, point_.position) / length);
    }
    Box box = box_of(part.corners());
    box.include(box_of(std::span(&point_.position, 1)));
    for (int axis = 0; axis < 3; ++axis) {
        Vec3 outwards(0.0);
        outwards[axis] = 1;
        room.add(outwards, box.high[axis]);
        room.add(-outwards, -box.low[axis]);
    }
    near_.clear();
    covers_.clear();
    tree_.facets_within(room, near_);
    for (const std::uint32_t facet : near_)
        if (const ConvexPart directions = cover_of(facet, target); !directions.empty())
            covers_.push_back({directions, factor_of(directions)});
    std::ranges::stable_sort(covers_, std::greater<>(), &Cover::factor);
}

/// Leaves in seen_ what the covers leave of a target; returns false where that is too much work.
bool PointView::cut_out(const ConvexPart& whole) {
    if (covers_.size() > max_covers)
        return false;
    seen_.begin(whole);
    return std::ranges::all_of(covers_, [this](const Cover& cover) {
        return seen_.pieces().empty() || seen_.hide(cover.part);
    });
}

/// Multiplies the free factor by the share of rays that arrive. Its variance is that of independent
/// rays, with half a ray on either side besides, so that it is never 0.
Seen PointView::by_rays(const Target& target, double free, std::uint64_t seed) const {
    constexpr std::uint32_t fewest = 64, most = 1 << 14;
    const ProjectedPolygon polygon(point_.position, frame_, target.face.shape);
    if (!(polygon.factor() > 0))
        return {};
    SobolBlocks<4> places(seed);
    std::uint32_t rays = 0, arrived = 0, above = 0;
    for (std::uint32_t until = fewest;; until *= 2) {
        for (; rays < until; ++rays) {
            const std::array<double, 4> u = places.at(rays);
            Ray ray{.origin = point_.position,
                    .direction = polygon.sample({u[0], u[1]}),
                    .from = point_.facet};
            const double fall = -glm::dot(ray.direction, target.face.plane.normal);
            if (!(fall > 0))
                continue;
            ray.t_max = target.face.plane.height(point_.position) / fall * (1 - 1e-12);
            if (tree_.occluded(ray, target.facet))
                continue;
            ++arrived;
            above += ray.direction[options_.up] > 0 ? 1 : 0;
        }
        const double p = (arrived + .5) / (rays + 1.0);
        const double variance = free * free * p * (1 - p) / (rays + 1.0);
        const double allowed = options_.error * std::max(free * p, options_.least);
        if (variance <= allowed * allowed || rays == most)
            return {free * arrived / rays, variance, free * above / rays};
    }
}

Seen PointView::see(const Target& target, std::uint64_t seed) {
    const ConvexPart part = in_front(part_of(target.face.shape), horizon_, height_rounding);
    if (part.empty())
        return {};
    const ConvexPart whole = directions_of(part);
    const double free = factor_of(whole);
    if (!(free > 0))
        return {};
    if (is_hidden_by_one(target, whole))
        return {};
    find_covers(target, part);
    if (!cut_out(whole))
        return by_rays(target, free, seed);
    Seen seen;
    for (const ConvexPart& piece : seen_.pieces()) {
        seen.factor += factor_of(piece);
        const ConvexPart above = cut_by_plane(piece, up_);
        if (!above.empty())
            seen.above += factor_of(above);
    }
    return seen;
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
    frame_ = Frame::from_normal(point.normal);
    horizon_ = {point.position, point.normal};
    Vec3 up(0.0);
    up[options_.up] = 1;
    up_ = frame_.to_local(up);
    find_candidates(hash_words({options_.seed, index, 1}));
    std::map<std::uint32_t, Seen> by_column;
    Seen all;
    for (const std::uint32_t t : candidates_) {
        const Seen seen = see(targets_[t], hash_words({options_.seed, index, 2, t}));
        if (!(seen.factor > 0 || seen.variance > 0))
            continue;
        for (Seen* sum : {&by_column[targets_[t].column], &all}) {
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
    const std::vector<Target> targets = targets_of(mesh, row_of);
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
