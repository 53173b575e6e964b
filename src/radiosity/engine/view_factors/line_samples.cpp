#include "radiosity/engine/view_factors/line_samples.h"

#include "geometry/elementary.h"
#include "geometry/polygon_sampler.h"
#include "radiosity/paper/sampling/rng.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace hemilux {
namespace {

/// The variance of shares that n lines find, where it is known from elsewhere: p (1 - p) n^-1.3 for
/// a share p. In cities it was a quarter to three times this. It counts as so many twins, so that a
/// few twins that agree by chance do not pass for exactness.
constexpr double prior_twins = 6, prior_power = -1.3;

} // namespace

/// A line across a patch, y(t) = start + t (end - start) for t in [0,1], as a point of the other
/// patch sees it.
struct LineSamples::Line {
    Vec3 point{};
    Vec3 across{}; ///< normal of the plane through the point and the line
    /// A place p of that plane is a start + b end, relative to the point: a = dot(first, p), b =
    /// dot(second, p).
    Vec3 first{}, second{};
    double low = 0, high = 1; ///< the part in front of the point's plane

    /// The kernel along the line is (n0 + n1 u + n2 u^2) / (u^2 + m^2)^2, where u = t + shift.
    double shift = 0, m = 0, n0 = 0, n1 = 0, n2 = 0;

    /// Returns an integral of the kernel up to t.
    [[nodiscard]] double kernel_up_to(double t) const {
        const double u = t + shift, inverse = 1 / (u * u + m * m);
        const double angle = elementary::atan(u / m) / m, once = u * inverse;
        return .5 * (n0 * (once + angle) / (m * m) - n1 * inverse + n2 * (angle - once));
    }
};

LineSamples::LineSamples(const FacePlane& a, const FacePlane& b, std::span<Polygon> between)
    : points_(a.area <= b.area ? a : b), lines_(a.area <= b.area ? b : a), between_(between) {}

/// Finds the interval of the line that a facet hides. The facet meets the plane of the point and
/// the line in a segment; what of it has a + b < 1 is before the line.
bool LineSamples::hidden_by(const Polygon& facet, const Line& line, Vec2& interval) const {
    const auto corners = static_cast<std::size_t>(facet.size());
    const double offset = glm::dot(line.across, line.point);
    std::array<double, 4> height;
    bool above = false, below = false;
    for (std::size_t k = 0; k < corners; ++k) {
        height[k] = glm::dot(line.across, facet.corner[k]) - offset;
        (height[k] >= 0 ? above : below) = true;
    }
    if (!above || !below)
        return false;
    std::array<Vec2, 2> end; // of the segment, as a and b
    std::size_t ends = 0;
    for (std::size_t k = 0; k < corners && ends < 2; ++k) {
        const std::size_t next = k + 1 < corners ? k + 1 : 0;
        if ((height[k] >= 0) == (height[next] >= 0))
            continue;
        const double share = height[k] / (height[k] - height[next]);
        const Vec3 p = glm::mix(facet.corner[k], facet.corner[next], share) - line.point;
        end[ends++] = {glm::dot(line.first, p), glm::dot(line.second, p)};
    }
    if (ends < 2)
        return false;
    constexpr double nearest = 1e-12;
    Vec2 depth{end[0].x + end[0].y, end[1].x + end[1].y};
    if (depth.x > depth.y) {
        std::swap(depth.x, depth.y);
        std::swap(end[0], end[1]);
    }
    if (!(depth.x < 1 && depth.y > nearest))
        return false;
    const auto at_depth = [&](double d) {
        return glm::mix(end[0], end[1], (d - depth.x) / (depth.y - depth.x));
    };
    const Vec2 from = depth.x >= nearest ? end[0] : at_depth(nearest);
    const Vec2 to = depth.y <= 1 ? end[1] : at_depth(1);
    const double t = from.y / (from.x + from.y), s = to.y / (to.x + to.y);
    interval = {std::min(t, s), std::max(t, s)};
    return interval.x < line.high && interval.y > line.low;
}

double LineSamples::seen_of(const Line& line, double whole) {
    hidden_.clear();
    for (std::size_t k = 0; k < between_.size(); ++k) {
        Vec2 interval;
        if (!hidden_by(between_[k], line, interval))
            continue;
        if (interval.x <= line.low && interval.y >= line.high) {
            std::swap(between_[k], between_[k / 2]);
            return 0;
        }
        hidden_.push_back(interval);
    }
    if (hidden_.empty())
        return whole;
    std::ranges::sort(hidden_, {}, [](const Vec2& interval) { return interval.x; });
    double seen = 0, at = line.low;
    for (const Vec2& interval : hidden_) {
        if (interval.x > at)
            seen += line.kernel_up_to(interval.x) - line.kernel_up_to(at);
        at = std::max(at, interval.y);
    }
    if (at < line.high)
        seen += line.kernel_up_to(line.high) - line.kernel_up_to(at);
    return std::clamp(seen, 0.0, whole);
}

Vec2 LineSamples::sample(const Polygon& shape, const Vec3& x, double s) {
    const auto& [a, b, c, d] = shape.corner;
    const double height = lines_.plane.height(x);
    const Vec3 start = glm::mix(a, d, s) - x, end = glm::mix(b, c, s) - x, along = end - start;
    const double length2 = glm::dot(along, along);
    const double h0 = glm::dot(points_.plane.normal, start),
                 h1 = glm::dot(points_.plane.normal, end);
    if (!(height > 0 && length2 > 0 && (h0 > 0 || h1 > 0)))
        return Vec2(0.0);
    Line line;
    line.point = x;
    if (h0 < 0)
        line.low = h0 / (h0 - h1);
    if (h1 < 0)
        line.high = h0 / (h0 - h1);
    line.across = glm::cross(start, end);
    const double square = glm::dot(line.across, line.across);
    if (!(square > 0))
        return Vec2(0.0);
    // Area per s and t, and height over the point's plane, are linear in t.
    const double j0 = glm::length(glm::cross(d - a, along)),
                 dj = glm::length(glm::cross(c - b, along)) - j0, dh = h1 - h0;
    line.shift = glm::dot(start, along) / length2;
    line.m = std::sqrt(square) / length2;
    const double h = h0 - dh * line.shift, j = j0 - dj * line.shift;
    const double scale = height / (length2 * length2);
    line.n0 = scale * h * j;
    line.n1 = scale * (h * dj + j * dh);
    line.n2 = scale * dh * dj;
    const double whole = line.kernel_up_to(line.high) - line.kernel_up_to(line.low);
    if (!(whole > 0))
        return Vec2(0.0);
    line.first = glm::cross(end, line.across) / square;
    line.second = glm::cross(line.across, start) / square;
    return {seen_of(line, whole), whole};
}

SeenShare LineSamples::estimate(unsigned cells, LinesAlong along, std::uint64_t seed) {
    const PolygonSampler points(points_.shape);
    Polygon shape = lines_.shape;
    if (along == LinesAlong::second_edge) {
        const auto& [a, b, c, d] = lines_.shape.corner;
        shape = lines_.shape.is_triangle() ? Polygon{{b, c, a, a}} : Polygon{{b, c, d, a}};
    }
    Rng random(seed);
    const double cell = 1.0 / cells;
    SeenShare result;
    sums_.clear();
    Vec2 sum(0.0);
    for (unsigned u = 0; u < cells; ++u)
        for (unsigned v = 0; v < cells; ++v)
            for (unsigned s = 0; s < cells; ++s)
                for (int twin = 0; twin < 2; ++twin) {
                    const double x = (u + random.uniform()) * cell,
                                 y = (v + random.uniform()) * cell,
                                 z = (s + random.uniform()) * cell;
                    sums_.push_back(sample(shape, points.sample({x, y}), z));
                    sum += sums_.back();
                    result.clear_lines += sums_.back().x == sums_.back().y;
                }
    result.lines = static_cast<std::uint32_t>(sums_.size());
    result.share = sum.y > 0 ? sum.x / sum.y : 0;
    double squares = 0, whole_squares = 0;
    for (std::size_t k = 0; k < sums_.size(); k += 2) {
        const Vec2 difference = sums_[k] - sums_[k + 1];
        const double error = difference.x - result.share * difference.y;
        squares += error * error;
        whole_squares += sums_[k].y * sums_[k].y + sums_[k + 1].y * sums_[k + 1].y;
    }
    // Where a few lines have most of the kernel, they count as so many of equal weight.
    const double n = whole_squares > 0 ? sum.y * sum.y / whole_squares : 0;
    const double own = sum.y > 0 ? squares / (sum.y * sum.y) : 0;
    const double p = (n * result.share + .5) / (n + 1),
                 prior = p * (1 - p) * elementary::pow(std::max(n, 1.0), prior_power);
    result.variance = (own * n / 2 + prior * prior_twins) / (n / 2 + prior_twins);
    return result;
}

} // namespace hemilux
