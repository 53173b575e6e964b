#include "radiosity/engine/factors/points/sunlit.h"

#include "geometry/frame.h"
#include "geometry/polygon_sampler.h"
#include "radiosity/engine/factors/points/seen_part.h"
#include "radiosity/engine/sampling/sobol.h"
#include "radiosity/paper/sampling/rng.h"
#include "radiosity/paper/scene/mesh.h"
#include "radiosity/paper/solving/solver.h"

#include <algorithm>
#include <cmath>

namespace hemilux {
namespace {

/// A height over a patch that counts as in it, in the unit of a scene in [-1,1]^3.
constexpr double above_patch = 1e-9;

/// The smallest cosine of incidence at which a patch is not edge-on.
constexpr double edge_on = 1e-9;

/// So many shadows are cut out; beyond, rays are as exact as need be.
constexpr std::size_t max_shadows = 256;

/// Returns the area of a piece whose corners are (x, y, 1).
double area_across(const ConvexPart& piece) {
    double twice = 0;
    for (std::size_t k = 0; k < piece.size; ++k)
        twice += piece.corner[k].x * piece.next(k).y - piece.corner[k].y * piece.next(k).x;
    return std::abs(twice) / 2;
}

/// Finds the sunlit fractions of one direction, with its memory; one for each thread.
class SunView {
  public:
    SunView(const Mesh& mesh, const WideBvh& tree, const SunlitOptions& options)
        : mesh_(mesh), tree_(tree), options_(options) {}

    [[nodiscard]] OpenShare fraction_of(std::uint32_t patch, const Vec3& sun, std::uint64_t seed);

  private:
    struct Shadow {
        ConvexPart outline;
        double area;
    };
    [[nodiscard]] ConvexPart across(const ConvexPart& part) const;
    [[nodiscard]] ConvexPart shadow_of(std::uint32_t facet) const;
    [[nodiscard]] bool is_hidden_by_one(const Vec3& sun, const ConvexPart& whole);
    void find_shadows(const Vec3& sun);
    [[nodiscard]] OpenShare by_rays(const Vec3& sun, std::uint64_t seed) const;

    const Mesh& mesh_;
    const WideBvh& tree_;
    const SunlitOptions& options_;

    const Patch* patch_ = nullptr;
    Frame frame_{}; ///< its z points to the sun
    Plane plane_{};
    std::vector<std::uint32_t> near_;
    std::vector<Shadow> shadows_;
    SeenPart seen_;
};

ConvexPart SunView::across(const ConvexPart& part) const {
    ConvexPart outline;
    for (const Vec3& corner : part.corners()) {
        const Vec3 at = corner - patch_->centre;
        outline.add({glm::dot(frame_.x, at), glm::dot(frame_.y, at), 1});
    }
    return outline;
}

/// Returns the outline of what a facet has in front of the patch; empty where it has nothing there.
ConvexPart SunView::shadow_of(std::uint32_t facet) const {
    if (facet == patch_->facet)
        return {};
    const ConvexPart part = in_front(part_of(mesh_.shape_of(facet)), plane_, above_patch);
    return part.empty() ? part : across(part);
}

/// Returns whether the facet that hides the middle of the patch hides all of it.
bool SunView::is_hidden_by_one(const Vec3& sun, const ConvexPart& whole) {
    const auto hit =
        tree_.closest({.origin = patch_->centre, .direction = sun, .from = patch_->facet});
    if (!hit)
        return false;
    const ConvexPart shadow = shadow_of(hit->facet);
    seen_.begin(whole);
    return !shadow.empty() && seen_.hide(shadow) && seen_.pieces().empty();
}

/// Collects the shadows that may fall on the patch, the largest first.
void SunView::find_shadows(const Vec3& sun) {
    Shaft room;
    room.add(-plane_.normal, -glm::dot(plane_.normal, plane_.point) - above_patch);
    const ConvexPart part = part_of(patch_->shape);
    for (std::size_t k = 0; k < part.size; ++k) {
        const Vec3 outwards = glm::cross(part.next(k) - part.corner[k], sun);
        const double length = glm::length(outwards);
        if (length > 0)
            room.add(outwards / length, glm::dot(outwards, part.corner[k]) / length);
    }
    near_.clear();
    shadows_.clear();
    tree_.facets_within(room, near_);
    for (const std::uint32_t facet : near_)
        if (const ConvexPart outline = shadow_of(facet); !outline.empty())
            shadows_.push_back({outline, area_across(outline)});
    std::ranges::stable_sort(shadows_, std::greater<>(), &Shadow::area);
}

/// The variance is that of independent rays, with half a ray on either side besides, so that it is
/// never 0.
OpenShare SunView::by_rays(const Vec3& sun, std::uint64_t seed) const {
    constexpr std::uint32_t fewest = 64, most = 1 << 14;
    const PolygonSampler points(patch_->shape);
    SobolBlocks<4> places(seed);
    std::uint32_t rays = 0, arrived = 0;
    for (std::uint32_t until = fewest;; until *= 2) {
        for (; rays < until; ++rays) {
            const std::array<double, 4> u = places.at(rays);
            arrived += tree_.occluded({.origin = points.sample({u[0], u[1]}),
                                       .direction = sun,
                                       .from = patch_->facet})
                           ? 0
                           : 1;
        }
        const double p = (arrived + .5) / (rays + 1.0);
        const double deviation = std::sqrt(p * (1 - p) / (rays + 1.0));
        if (deviation <= options_.error || rays == most)
            return {static_cast<double>(arrived) / rays, deviation};
    }
}

OpenShare SunView::fraction_of(std::uint32_t patch, const Vec3& sun, std::uint64_t seed) {
    patch_ = &mesh_.patches()[patch];
    if (!(glm::dot(patch_->normal, sun) > edge_on))
        return {};
    frame_ = Frame::from_normal(sun);
    plane_ = {patch_->shape.corner[0], patch_->normal};
    const ConvexPart whole = across(part_of(patch_->shape));
    if (is_hidden_by_one(sun, whole))
        return {};
    find_shadows(sun);
    if (shadows_.empty())
        return {1, 0};
    if (shadows_.size() > max_shadows)
        return by_rays(sun, seed);
    seen_.begin(whole);
    for (const Shadow& shadow : shadows_)
        if (!seen_.hide(shadow.outline))
            return by_rays(sun, seed);
    double lit = 0;
    for (const ConvexPart& piece : seen_.pieces())
        lit += area_across(piece);
    constexpr double rounding = 1e-11;
    const double share = lit / area_across(whole);
    return {share > 1 - rounding ? 1 : share > rounding ? share : 0, 0};
}

} // namespace

std::vector<OpenShare> sunlit_patches(const Vec3& sun, const Mesh& mesh, const WideBvh& tree,
                                      const SunlitOptions& options, const Workers& workers,
                                      Monitor& monitor) {
    std::vector<OpenShare> fractions(mesh.patches().size());
    workers.for_chunks_with(
        fractions.size(), 64, [&] { return SunView(mesh, tree, options); },
        [&](SunView& view, std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end && !monitor.interrupted; ++i)
                fractions[i] = view.fraction_of(static_cast<std::uint32_t>(i), sun,
                                                hash_words({options.seed, i}));
        });
    return fractions;
}

bool is_sunlit(const FactorPoint& point, const Vec3& sun, const Tracer& tracer) {
    return glm::dot(point.normal, sun) > edge_on &&
           !tracer.occluded({.origin = point.position, .direction = sun, .from = point.facet});
}

} // namespace hemilux
