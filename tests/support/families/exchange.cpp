#include "support/families/exchange.h"

#include "geometry/frame.h"
#include "geometry/horizon_clip.h"
#include "support/families/gauss_rule.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hemilux::test {
namespace {

constexpr double in_plane = 1e-12; ///< heights below this, for scenes of size 1, are rounding

double radius(const Polygon& polygon) {
    double most = 0;
    for (const Vec3& corner : polygon.corner)
        most = std::max(most, glm::distance(corner, polygon.centre()));
    return most;
}

/// All corners in front of the plane of the other.
bool rises_above(const Polygon& polygon, const Polygon& over) {
    const Vec3 normal = over.normal();
    return std::ranges::all_of(polygon.corner, [&](const Vec3& corner) {
        return glm::dot(corner - over.corner[0], normal) > 0;
    });
}

bool is_parallelogram(const Polygon& p) {
    return glm::distance(p.corner[0] + p.corner[2], p.corner[1] + p.corner[3]) < 1e-9 * radius(p);
}

Vec3 point_of(const Polygon& p, const Vec2& u) {
    return p.corner[0] + u.x * (p.corner[1] - p.corner[0]) + u.y * (p.corner[3] - p.corner[0]);
}

/// Mean of f over a parallelogram.
template <class Function>
double mean_over(const Polygon& polygon, int points, const Function& f) {
    const std::vector<GaussPoint>& rule = gauss_rule(points);
    double sum = 0;
    for (const GaussPoint& a : rule)
        for (const GaussPoint& b : rule)
            sum += a.weight * b.weight * f(point_of(polygon, {a.at, b.at}));
    return sum;
}

double far_exchange(const Polygon& from, const Polygon& to) {
    constexpr int points = 4;
    const Vec3 n = from.normal(), m = to.normal();
    return from.area() * to.area() * mean_over(from, points, [&](const Vec3& p) {
               return mean_over(to, points, [&](const Vec3& q) {
                   const Vec3 d = q - p;
                   const double square = glm::dot(d, d);
                   return -glm::dot(d, n) * glm::dot(d, m) / (std::numbers::pi * square * square);
               });
           });
}

/// What of an outline lies in the cone of a polygon, as seen from a point; the cone behind the
/// point for the opposite side.
Outline within_cone(Outline outline, const Vec3& point, const Aperture& aperture) {
    const Polygon& shape = aperture.shape;
    if (std::abs(glm::dot(point - shape.corner[0], shape.normal())) < in_plane)
        return {};
    const Vec3 centre = shape.centre() - point;
    for (int i = 0; i < shape.size() && !outline.empty(); ++i) {
        const auto a = static_cast<std::size_t>(i);
        const auto b = static_cast<std::size_t>((i + 1) % shape.size());
        Vec3 normal = glm::normalize(glm::cross(shape.corner[a] - point, shape.corner[b] - point));
        const bool flip = (glm::dot(normal, centre) < 0) != (aperture.side == Side::opposite);
        outline = in_front(outline, {point, flip ? -normal : normal}, 0);
    }
    return outline;
}

/// Lambert's formula for an outline that does not cross the plane of the point's surface.
double lambert(const Outline& outline, const Vec3& point, const Frame& frame) {
    double sum = 0;
    for (std::size_t i = 0; i < outline.size(); ++i)
        sum += edge_term(frame.to_local(outline[i] - point),
                         frame.to_local(outline[(i + 1) % outline.size()] - point));
    return std::abs(sum) / (2 * std::numbers::pi);
}

} // namespace

double exchange_in_the_open(const Polygon& from, const Polygon& to) {
    constexpr double far = 8; // then the four-point rule is exact to about 16^-8
    const double distance = glm::distance(from.centre(), to.centre());
    if (distance > far * (radius(from) + radius(to)) && rises_above(from, to) &&
        rises_above(to, from) && is_parallelogram(from) && is_parallelogram(to))
        return far_exchange(from, to);
    const FacingPair pair = facing_parts(from, to, in_plane * std::max(1.0, distance));
    return pair.from.empty() ? 0
                             : exchange_area(pair.from, pair.to, std::min(from.area(), to.area()));
}

ExchangeTable::Key ExchangeTable::key_of(const Polygon& from, const Polygon& to) {
    const auto rounded = [](double x) { return std::llround(x * 1e9); };
    Key key{};
    std::size_t k = 0;
    for (int i = 0; i < from.size(); ++i)
        for (int j = 0; j < to.size(); ++j)
            key.at(k++) = rounded(glm::distance(from.corner[static_cast<std::size_t>(i)],
                                                to.corner[static_cast<std::size_t>(j)]));
    std::sort(key.begin(), key.begin() + static_cast<std::ptrdiff_t>(k));
    // Areas may be tiny: to nine digits of each, not of 1.
    key[16] = rounded(std::log(std::min(from.area(), to.area())));
    key[17] = rounded(std::log(std::max(from.area(), to.area())));
    key[18] = rounded(glm::dot(from.normal(), to.normal()));
    return key;
}

double ExchangeTable::operator()(const Polygon& from, const Polygon& to) {
    const auto [place, is_new] = known_.try_emplace(key_of(from, to), 0.0);
    if (is_new)
        place->second = exchange_in_the_open(from, to);
    return place->second;
}

double exchange_through(const Polygon& across, const Polygon& target,
                        std::span<const Aperture> apertures, int points) {
    const Frame frame = Frame::from_normal(across.normal());
    const double mean = mean_over(across, points, [&](const Vec3& point) {
        if (std::abs(glm::dot(point - target.corner[0], target.normal())) < in_plane)
            return 0.0;
        Outline seen = outline_of(target);
        for (const Aperture& aperture : apertures)
            seen = within_cone(std::move(seen), point, aperture);
        return lambert(seen, point, frame);
    });
    return across.area() * mean;
}

} // namespace hemilux::test
