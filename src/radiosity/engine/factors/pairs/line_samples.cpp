#include "radiosity/engine/factors/pairs/line_samples.h"

#include "geometry/elementary.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace hemilux {
namespace {

/// What the mean square of the differences of 1, 2, 4, ... 32 pairs of blocks says of its
/// expectation: the mean and the variance of the logarithm of the ratio, as that of the chi-square
/// distribution with 0.7 times as many degrees of freedom, as a few blocks often differ most; and
/// 0.15 besides, as the expectation is no exact power of the number of lines.
struct LogOfSquares {
    double mean, variance;
};
constexpr std::array<LogOfSquares, 6> log_of_squares = {{{-1.9212, 9.3905},
                                                         {-0.8633, 2.9840},
                                                         {-0.3979, 1.1754},
                                                         {-0.1891, 0.5783},
                                                         {-0.0919, 0.3455},
                                                         {-0.0453, 0.2434}}};

/// The logarithm of that expectation changes by so much where blocks are joined in pairs, from pair
/// of patches to pair: the variance of n lines falls as n^-1.4, give or take 0.4.
constexpr double log_growth = .4, spread_of_growth = .3;

/// The variance that is known from elsewhere, p (1 - p) n^-1.6 for a share p and n lines, is about
/// so many times too large by its logarithm, give or take the spread.
constexpr double log_excess_of_prior = 1, spread_of_prior = 1.5;

Polygon across(const Polygon& shape, LinesAlong along) {
    if (along == LinesAlong::first_edge)
        return shape;
    const auto& [a, b, c, d] = shape.corner;
    return shape.is_triangle() ? Polygon{{b, c, a, a}} : Polygon{{b, c, d, a}};
}

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

LineSamples::LineSamples(const FacePlane& a, const FacePlane& b, std::span<Polygon> between,
                         LinesAlong along, std::uint64_t seed)
    : points_(a.area <= b.area ? a : b), lines_(a.area <= b.area ? b : a), between_(between),
      sampler_(points_.shape), shape_(across(lines_.shape, along)), places_(seed) {}

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

Vec2 LineSamples::sample(const Vec3& x, double s) {
    const auto& [a, b, c, d] = shape_.corner;
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

void LineSamples::go_on_to(std::uint32_t lines) {
    for (; lines > max_blocks * of_block_; of_block_ *= 2)
        for (std::size_t k = 0; k < max_blocks; ++k)
            sums_[k] = 2 * k < max_blocks ? sums_[2 * k] + sums_[2 * k + 1] : Vec2(0.0);
    for (; count_ < lines; ++count_) {
        const std::array<double, 4> u = places_.at(count_);
        const Vec2 kernel = sample(sampler_.sample({u[0], u[1]}), u[2]);
        sums_[count_ / of_block_] += kernel;
        whole_squares_ += kernel.y * kernel.y;
        clear_ += kernel.x == kernel.y ? 1 : 0;
    }
}

// The difference of two blocks of m lines next to each other has a variance that grows with m as a
// power which each pair of patches has of its own: smaller than m where lines change steadily, m
// where edges of shadows are many and all lines independent. So its logarithm is a line over log m.
// It is fitted to all levels of blocks, and what it says of blocks of all lines is twice the
// variance of their sum. The fit is Bayesian: the slope and the end of the line are known a little
// beforehand.
double LineSamples::variance_of_blocks(const Vec2& sum, double prior) const {
    std::array<double, max_blocks> error;
    std::size_t blocks = count_ / of_block_;
    for (std::size_t k = 0; k < blocks; ++k)
        error[k] = (sums_[k].x - sum.x / sum.y * sums_[k].y) / sum.y;
    constexpr double of_prior = 1 / (spread_of_prior * spread_of_prior),
                     of_growth = 1 / (spread_of_growth * spread_of_growth), smallest = 1e-24;
    // Sums of weights by the powers of the level, and of weighted logarithms.
    double w0 = of_prior, w1 = 0, w2 = of_growth;
    double y0 = of_prior * (elementary::log(2 * prior) - log_excess_of_prior),
           y1 = of_growth * log_growth;
    for (; blocks > 1; blocks /= 2) {
        const std::size_t pairs = blocks / 2;
        double squares = 0;
        for (std::size_t k = 0; k < pairs; ++k) {
            const double difference = error[2 * k] - error[2 * k + 1];
            squares += difference * difference;
            error[k] = error[2 * k] + error[2 * k + 1];
        }
        const auto level = static_cast<std::size_t>(std::countr_zero(pairs));
        const double y = elementary::log(std::max(squares / static_cast<double>(pairs), smallest)) -
                         log_of_squares[level].mean;
        const double weight = 1 / log_of_squares[level].variance,
                     x = -static_cast<double>(level) - 1; // joins of all lines have x = 0
        w0 += weight;
        w1 += weight * x;
        w2 += weight * x * x;
        y0 += weight * y;
        y1 += weight * x * y;
    }
    const double determinant = w0 * w2 - w1 * w1;
    const double end = (y0 * w2 - y1 * w1) / determinant, variance = w2 / determinant;
    return elementary::exp(end + variance / 2) / 2;
}

SeenShare LineSamples::seen() const {
    Vec2 sum(0.0);
    for (const Vec2& block : sums_)
        sum += block;
    SeenShare result{.lines = count_, .clear_lines = clear_};
    if (!(sum.y > 0))
        return result;
    result.share = sum.x / sum.y;
    // Where a few lines have most of the kernel, they count as so many of equal weight.
    const double n = std::max(sum.y * sum.y / whole_squares_, 1.0);
    const double p = (n * result.share + .5) / (n + 1),
                 prior = p * (1 - p) * elementary::pow(n, -1.6);
    // Two fifths of a line may be elsewhere, above all where all lines agree.
    const double least = .4 / n;
    result.variance = std::max(variance_of_blocks(sum, prior), least * least);
    return result;
}

} // namespace hemilux
