#include "geometry/polar_warp.h"

#include "geometry/elementary.h"
#include "geometry/numeric.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hemilux {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

/// Returns the z of a x b, which is positive where the edge runs counter-clockwise about the pole.
double turn(const Vec3& a, const Vec3& b) { return difference_of_products(a.x, b.y, a.y, b.x); }

double angle_of(Vec2 azimuth) { return elementary::atan2(azimuth.y, azimuth.x); }

} // namespace

PolarWarp::PolarWarp(const Vec3& a, const Vec3& b, const Vec3& c) {
    const std::array<Vec3, 3> vertex{a, b, c};
    const std::array<double, 3> turns{turn(a, b), turn(b, c), turn(c, a)};
    const auto backward = std::count_if(turns.begin(), turns.end(), [](double t) { return t < 0; });
    fan_ = backward == 0;
    if (fan_) {
        // The sector at which the pole lies on or near the edge comes last, so that the azimuth's
        // swing across it is at the rim of the unit square.
        const auto last = std::min_element(turns.begin(), turns.end()) - turns.begin();
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t i = (static_cast<std::size_t>(last) + 1 + k) % 3;
            if (turns[i] > 0)
                sector_[k] = fan_sector(vertex[i], vertex[(i + 1) % 3]);
            area_ += sector_[k].area;
        }
        return;
    }
    // One edge spans the whole range of azimuth. If only one edge runs backward, it is the inner
    // boundary; if only one runs forward, it is the outer boundary.
    const auto spans = [&](double t) { return backward == 1 ? t < 0 : !(t < 0); };
    const auto spanning = std::find_if(turns.begin(), turns.end(), spans);
    if (spanning == turns.end())
        return; // clockwise: no area
    const auto i = static_cast<std::size_t>(spanning - turns.begin());
    const Vec3& from = vertex[backward == 1 ? (i + 1) % 3 : i];
    const Vec3& to = vertex[backward == 1 ? i : (i + 1) % 3];
    const Vec3& middle = vertex[(i + 2) % 3];
    sector_[0] = wedge(from, middle, to, 1.0);
    sector_[1] = wedge(to, middle, from, -1.0);
    area_ = sector_[0].area + sector_[1].area;
}

Vec3 PolarWarp::sample(Vec2 u) const {
    const double target = u.x * area_;
    if (fan_)
        return sample_fan(target, u.y);
    if (target < sector_[0].area || !(sector_[1].area > 0))
        return sample_wedge(sector_[0], target, u.y);
    return sample_wedge(sector_[1], (1.0 - u.x) * area_, u.y);
}

// ---- arcs and sectors ------------------------------------------------------------------------

PolarWarp::Sector PolarWarp::sector(const Vec3& apex, double side) {
    Sector result;
    result.rho = elementary::hypot(apex.x, apex.y);
    result.height = apex.z;
    if (result.rho > 0)
        result.axis = Vec2(apex.x, apex.y) / result.rho;
    result.across = side * Vec2(-result.axis.y, result.axis.x);
    return result;
}

/// Finds m = apex x end = apex x (end - apex); the difference keeps short edges accurate.
PolarWarp::Arc PolarWarp::arc(const Sector& s, const Vec3& apex, const Vec3& end) {
    const Vec3 d = end - apex;
    const double along = glm::dot(s.axis, Vec2(d.x, d.y));
    const double sideways = std::max(0.0, glm::dot(s.across, Vec2(d.x, d.y)));
    Arc result;
    result.h_0 = -s.height * sideways;
    result.h_1 = s.height * along - s.rho * d.z;
    result.m_z = s.rho * sideways;
    result.length = glm::length(Vec3(result.h_0, result.h_1, result.m_z));
    return result;
}

/// Returns the length of the arc from the apex to a meridian. It is symmetric in the two ends:
/// tan(Gamma) = m_z |m| sin / ((m_z^2 + h_0^2) cos + h_0 h_1 sin).
double PolarWarp::Arc::gamma(Vec2 azimuth) const {
    return elementary::atan2(m_z * length * azimuth.y,
                             (m_z * m_z + h_0 * h_0) * azimuth.x + h_0 * h_1 * azimuth.y);
}

double PolarWarp::Arc::area(Vec2 azimuth) const {
    return m_z > 0 ? 0.5 * m_z / length * gamma(azimuth) : 0.0;
}

Vec2 PolarWarp::Sector::azimuth_of(const Vec3& d) const {
    const Vec2 v(d.x, d.y);
    return {glm::dot(axis, v), glm::dot(across, v)};
}

Vec3 PolarWarp::Sector::direction(Vec2 azimuth, double r, double z) const {
    const Vec2 v = r * (azimuth.x * axis + azimuth.y * across);
    return {v.x, v.y, z};
}

/// Returns where a meridian crosses both arcs. The difference of r^2 is zero at the apex, where
/// both arcs meet. There h_0 / m_z is the same for both, so the terms with cos cancel before
/// anything is computed. At the apex of an edge along a meridian nothing but the apex is known.
PolarWarp::Crossing PolarWarp::Sector::crossing(Vec2 azimuth) const {
    const double h = first.h_0 * azimuth.x + first.h_1 * azimuth.y;
    const double k = second.h_0 * azimuth.x + second.h_1 * azimuth.y;
    const double d = first.m_z * first.m_z + h * h;
    const double e = second.m_z * second.m_z + k * k;
    if (!(d > 0 && e > 0))
        return {Vec2(rho * rho), Vec2(height * height), 0};
    const double twist = difference_of_products(first.m_z, second.h_1, second.m_z, first.h_1);
    return {{first.m_z * first.m_z / d, second.m_z * second.m_z / e},
            {h * h / d, k * k / e},
            azimuth.y * twist * (first.m_z * k + second.m_z * h) / (d * e)};
}

// ---- the pole inside or on the edge ----------------------------------------------------------

PolarWarp::Sector PolarWarp::fan_sector(const Vec3& from, const Vec3& to) {
    Sector result = sector(from, 1.0);
    result.first = arc(result, from, to);
    const Vec2 end = result.azimuth_of(to);
    result.range = angle_of(end);
    result.area = std::max(0.0, result.first.area(end));
    return result;
}

/// Walks along the arc to the length Gamma whose area is the target, and then out from the pole.
Vec3 PolarWarp::sample_fan(double target, double radial) const {
    std::size_t i = 0;
    while (i < 2 && target >= sector_[i].area)
        target -= sector_[i++].area;
    while (i > 0 && !(sector_[i].area > 0)) // rounding led past the last edge
        target = sector_[--i].area;
    const Sector& s = sector_[i];
    const Arc& m = s.first;
    const double gamma = m.m_z > 0 ? 2.0 * target * m.length / m.m_z : 0.0;
    const Vec2 turn = elementary::on_circle(gamma);
    const double c = turn.x, d = turn.y / m.length;
    const Vec2 point(s.rho * c + m.h_1 * s.height * d, (m.m_z * s.rho - m.h_0 * s.height) * d);
    const double height = s.height * c - m.h_1 * s.rho * d;
    return s.direction(point, std::sqrt(radial),
                       safe_sqrt(1.0 - radial + radial * height * height));
}

// ---- the pole outside ------------------------------------------------------------------------

PolarWarp::Sector PolarWarp::wedge(const Vec3& apex, const Vec3& middle, const Vec3& far,
                                   double side) {
    Sector result = sector(apex, side);
    result.first = arc(result, apex, middle);
    result.second = arc(result, apex, far);
    const Vec2 end = result.azimuth_of(middle);
    if (!(end.y > 4 * epsilon)) // the first edge lies on a meridian: the other wedge is all
        return result;
    result.range = angle_of(end);
    result.area = result.area_before(elementary::on_circle(result.range));
    return result;
}

double PolarWarp::Sector::area_before(Vec2 azimuth) const {
    return std::abs(first.area(azimuth) - second.area(azimuth));
}

/// Finds the root of area_before(angle) = target. Near the apex the area grows with the square of
/// the angle, which gives the first guess. Halley's step is kept inside the bracket.
double PolarWarp::Sector::azimuth_at(double target) const {
    constexpr int max_steps = 60;
    double low = 0, high = range;
    double angle = std::min(range, range * std::sqrt(target / area));
    for (int i = 0; i < max_steps; ++i) {
        const Vec2 azimuth = elementary::on_circle(angle);
        const double first_area = first.area(azimuth), second_area = second.area(azimuth);
        const double f = std::abs(first_area - second_area) - target;
        if (!(std::abs(f) > epsilon * (first_area + second_area)))
            return angle;
        (f < 0 ? low : high) = angle;
        // The derivatives are f' = |r1^2 - r2^2| / 2 and (r^2)' = -2 m_z^2 h h' / (m_z^2 + h^2)^2.
        const Crossing at = crossing(azimuth);
        const auto change = [&](const Arc& m, double r_squared) {
            const double h = m.h_0 * azimuth.x + m.h_1 * azimuth.y;
            const double h_change = m.h_1 * azimuth.x - m.h_0 * azimuth.y;
            return -2.0 * r_squared * h * h_change / (m.m_z * m.m_z + h * h);
        };
        const double slope = 0.5 * std::abs(at.difference);
        const double bend = std::copysign(0.5, at.difference) *
                            (change(first, at.r_squared.x) - change(second, at.r_squared.y));
        const double step = -2.0 * f * slope / (2.0 * slope * slope - f * bend);
        if (std::abs(step) <= 1e-10 * range) // what is left is of the order of its third power
            return std::clamp(angle + step, low, high);
        const bool inside = angle + step > low && angle + step < high;
        angle = inside ? angle + step : 0.5 * (low + high);
    }
    return angle;
}

Vec3 PolarWarp::sample_wedge(const Sector& wedge, double target, double radial) const {
    const Vec2 azimuth = elementary::on_circle(target > 0 ? wedge.azimuth_at(target) : 0.0);
    const Crossing at = wedge.crossing(azimuth);
    const double second = at.difference > 0 ? 1.0 - radial : radial; // its share
    return wedge.direction(azimuth, std::sqrt(glm::mix(at.r_squared.x, at.r_squared.y, second)),
                           std::sqrt(glm::mix(at.z_squared.x, at.z_squared.y, second)));
}

} // namespace hemilux
