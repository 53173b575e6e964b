#include "radiosity/answers/pictures/slow_light.h"

#include "radiosity/answers/pictures/linear_fit.h"
#include "radiosity/answers/pictures/slow_light_fit.h"
#include "radiosity/engine/rays/shadow_rays.h"
#include "radiosity/paper/rays/shot.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace hemilux {
namespace {

/// The share of the harmonic mean distance within which the light is taken to be about the same.
constexpr double reach_share = .25;

/// A point has neighbours up to this many times their spacing, whatever is near.
constexpr double min_steps = 2.5;

/// Returns the weight of a step within a window. Points at its ends count half, so that the window
/// is as wide as squares of the sequence of samples.
double ends(int step) { return std::abs(step) == reach_points ? .5 : 1; }

/// Returns the inverse of the distance within which points share their light.
double inverse_reach(const GridPoint& here, const GridPoint& there) {
    return double(std::max(here.nearness, there.nearness)) / reach_share;
}

/// Returns whether points are so near each other that nothing can stand between them.
bool is_near(const GridPoint& here, const GridPoint& there) {
    const Vec3 way = (there.at.position - here.at.position) * inverse_reach(here, there);
    return glm::dot(way, way) < free_reach * free_reach;
}

/// Returns the weight of a point for the mean around another; 0 or less where it is too far away or
/// of another surface. `most` is the inverse of a distance within which none is too far.
double weight_of(const GridPoint& here, const GridPoint* there, double most) {
    if (!there || !here.is_of_surface(*there))
        return 0;
    const Vec3 way =
        (there->at.position - here.at.position) * std::min(inverse_reach(here, *there), most);
    return 1 - glm::dot(way, way);
}

/// A point around another.
struct Neighbour {
    Vec2 offset;
    std::size_t number; ///< of the point
    double weight;
};

} // namespace

double reach_of(double nearness) { return reach_share / nearness; }

double SlowLightField::noise_around(const GridPoint& here, int x, int y) const {
    const double most = 1 / (min_steps * grid_.spacing(x, y));
    LinearFit fit;                            // to the light of all points around
    double all = 0, weights = 0, squares = 0; // weights as those of fits
    Vec2 at(0.0), around(0.0);                // mean offset and its square
    for (int dy = -reach_points; dy <= reach_points; ++dy)
        for (int dx = -reach_points; dx <= reach_points; ++dx) {
            const GridPoint* const there = grid_.point(x + dx, y + dy);
            if (!there || !here.is_of_surface(*there))
                continue;
            const SlowLight& light = gathered_[grid_.number_of(*there)];
            const Vec2 offset(dx, dy);
            fit.add(offset, mean_of_channels(Vec3(light.indirect + light.unshadowed)), 1);
            all += double(there->light);
            const double weight = there == &here ? 1 : std::max(weight_of(here, there, most), 0.0);
            weights += weight;
            squares += weight * weight;
            at += weight * offset;
            around += weight * offset * offset;
        }
    if (!(all > 0))
        return 0;
    at /= weights;
    around = around / weights - at * at;
    // At the edge of a surface the slope is read as well, far from the middle of what it is by.
    double beside = 1;
    for (int axis = 0; axis < 2; ++axis)
        if (around[axis] > 0)
            beside += at[axis] * at[axis] / around[axis];
    return std::sqrt(fit.variance() * squares * beside) / weights / (all / fit.weight());
}

void SlowLightField::fit(int stride, const std::vector<SlowLight>& light,
                         std::vector<SlowLight>& fitted, int first, int end,
                         const std::function<void()>& check, const Workers& workers) {
    grid_.for_each_point(
        first, end, workers,
        [&](const GridPoint& here, int x, int y) {
            const double most = 1 / (min_steps * grid_.spacing(x, y));
            const std::size_t number = grid_.number_of(here);
            SlowLightFit fit(light[number]);
            const auto add = [&](const Neighbour& neighbour) {
                fit.add(neighbour.offset, light[neighbour.number], neighbour.weight);
            };
            ShadowRays<Neighbour> doubtful; // something may hide them
            for (int dy = -reach_points; dy <= reach_points; ++dy)
                for (int dx = -reach_points; dx <= reach_points; ++dx) {
                    const GridPoint* const there = grid_.point(x + stride * dx, y + stride * dy);
                    const double weight = ends(dx) * ends(dy) * weight_of(here, there, most);
                    if (!(weight > 0) || there == &here)
                        continue;
                    const Neighbour neighbour{{dx, dy}, grid_.number_of(*there), weight};
                    if (is_near(here, *there))
                        add(neighbour);
                    else
                        doubtful.add(ray_between(here.at, there->at), none, neighbour);
                }
            doubtful.trace(tracer_, [&](const Neighbour& neighbour, double share) {
                if (share > 0)
                    add(neighbour);
                else
                    at_barrier_[number] = 1;
            });
            const auto& [mean, slope] = fit.solve();
            fitted[number] = mean;
            constexpr double enough = 10; // points that are wide apart know a slope better
            if (stride == 1 || fit.weight() > enough)
                for (std::size_t k = 0; k < slope.size(); ++k)
                    slope_[number][k] = {slope[k].unshadowed / float(stride),
                                         slope[k].indirect / float(stride)};
        },
        check);
}

std::optional<SlowLightField::Around>
SlowLightField::interpolate(const SurfacePoint& at, const Vec2& pixel, std::uint32_t part) const {
    const double x = pixel.x / GatherGrid::step - .5, y = pixel.y / GatherGrid::step - .5;
    const int left = static_cast<int>(std::floor(x)), top = static_cast<int>(std::floor(y));
    constexpr double least = 1e-3; // on an edge of the square of points both sides count
    for (int ring = 0; ring <= 1; ++ring) {
        Around around;
        SlowLight& sum = around.light;
        double weights = 0;
        for (int dy = -ring; dy <= 1 + ring; ++dy)
            for (int dx = -ring; dx <= 1 + ring; ++dx) {
                const GridPoint* const there = grid_.point(left + dx, top + dy);
                if (!there || !there->is_of_surface(at, part) ||
                    (at_barrier_[grid_.number_of(*there)] != 0 &&
                     tracer_.occluded(ray_between(there->at, at))))
                    continue;
                const Vec3 way = there->at.position - at.position;
                const double share = double(there->nearness) / reach_share;
                const double across = std::max(1 - std::abs(x - left - dx), 0.0),
                             down = std::max(1 - std::abs(y - top - dy), 0.0);
                const double weight =
                    (least + across * down) / (1 + share * share * glm::dot(way, way));
                const std::size_t of = grid_.number_of(*there);
                sum.add(twice_[of], float(weight));
                sum.add(slope_[of][0], float(weight * (x - left - dx)));
                sum.add(slope_[of][1], float(weight * (y - top - dy)));
                weights += weight;
                around.shadow |= there->shadow;
                around.is_coarse = around.is_coarse || there->is_coarse;
                around.reach = std::min(around.reach, reach_of(double(there->nearness)));
            }
        if (!(weights > 0))
            continue;
        sum.unshadowed = glm::max(sum.unshadowed / float(weights), 0.0f);
        sum.indirect = glm::max(sum.indirect / float(weights), 0.0f);
        return around;
    }
    return {};
}

} // namespace hemilux
