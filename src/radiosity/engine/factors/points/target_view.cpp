#include "radiosity/engine/factors/points/target_view.h"

#include "geometry/projected_polygon.h"
#include "radiosity/engine/sampling/sobol.h"
#include "radiosity/paper/scene/mesh.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

namespace hemilux {
namespace {

/// A height over a plane that counts as in it, in the unit of a scene in [-1,1]^3.
constexpr double height_rounding = 1e-9;

/// So many facets in between are cut out; beyond, rays are as exact as need be.
constexpr std::size_t max_covers = 256;

/// Returns the factor of a piece of the hemisphere, whose corners are in the point's frame.
double factor_of(const ConvexPart& piece) {
    double sum = 0;
    for (std::size_t k = 0; k < piece.size; ++k)
        sum += edge_term(piece.corner[k], piece.next(k));
    return std::abs(sum) / (2 * std::numbers::pi);
}

} // namespace

double rough_factor(const FactorPoint& point, const PointTarget& target) {
    const Vec3 d = target.face.centre - point.position;
    const double height = target.face.plane.height(point.position);
    const double rise = glm::dot(d, point.normal) + target.face.radius;
    if (!(height > height_rounding && rise > height_rounding))
        return 0;
    const double radius = target.face.radius;
    const double square = std::max(glm::dot(d, d) - radius * radius, radius * radius);
    return std::min(height * rise * target.face.area / (square * square * std::numbers::pi), 1.0);
}

void TargetView::move_to(const FactorPoint& point) {
    point_ = point;
    frame_ = Frame::from_normal(point.normal);
    horizon_ = {point.position, point.normal};
    Vec3 up(0.0);
    up[options_.up] = 1;
    up_ = frame_.to_local(up);
}

ConvexPart TargetView::directions_of(const ConvexPart& part) const {
    ConvexPart directions;
    for (const Vec3& corner : part.corners())
        directions.add(frame_.to_local(corner - point_.position));
    return directions;
}

/// Returns the directions in which a facet lies in front of a target; empty where it does not.
ConvexPart TargetView::cover_of(std::uint32_t facet, const PointTarget& target) const {
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
bool TargetView::is_hidden_by_one(const PointTarget& target, const ConvexPart& whole) {
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
void TargetView::find_covers(const PointTarget& target, const ConvexPart& part) {
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
bool TargetView::cut_out(const ConvexPart& whole) {
    if (covers_.size() > max_covers)
        return false;
    seen_.begin(whole);
    return std::ranges::all_of(covers_, [this](const Cover& cover) {
        return seen_.pieces().empty() || seen_.hide(cover.part);
    });
}

/// Multiplies the free factor by the share of rays that arrive. Its variance is that of independent
/// rays, with half a ray on either side besides, so that it is never 0.
SeenFactor TargetView::by_rays(const PointTarget& target, double free, std::uint64_t seed) const {
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

SeenFactor TargetView::see(const PointTarget& target, std::uint64_t seed) {
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
    SeenFactor seen;
    for (const ConvexPart& piece : seen_.pieces()) {
        seen.factor += factor_of(piece);
        const ConvexPart above = cut_by_plane(piece, up_);
        if (!above.empty())
            seen.above += factor_of(above);
    }
    return seen;
}

} // namespace hemilux
