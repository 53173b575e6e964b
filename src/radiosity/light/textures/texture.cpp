#include "radiosity/light/textures/texture.h"

#include "geometry/elementary.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace hemilux {
namespace {

/// The largest number of texels that an edge may cross; beyond that it matters little where its
/// polygon ends.
constexpr double max_crossings = 16384;

/// Returns the remainder that is at least 0.
std::int64_t modulo(std::int64_t i, std::int64_t n) { return (i % n + n) % n; }

/// Returns the row or column of the picture that stands at place i.
std::size_t wrapped(std::int64_t i, std::int64_t n, Wrap wrap) {
    if (i >= 0 && i < n) // as nearly always; divisions take long
        return static_cast<std::size_t>(i);
    if (wrap == Wrap::clamp)
        return static_cast<std::size_t>(std::clamp<std::int64_t>(i, 0, n - 1));
    if (wrap == Wrap::repeat)
        return static_cast<std::size_t>(modulo(i, n));
    const std::int64_t j = modulo(i, 2 * n);
    return static_cast<std::size_t>(j < n ? j : 2 * n - 1 - j);
}

/// Returns after how many texels the picture repeats; 0 means never.
double period(Wrap wrap, double n) {
    return wrap == Wrap::clamp ? 0 : wrap == Wrap::repeat ? n : 2 * n;
}

/// The places along an edge, from 0 to 1, where one coordinate is whole, in order.
class Crossings {
  public:
    /// Finds the crossings from `begin` to `end`; where the picture is clamped nothing changes
    /// outside of it.
    Crossings(double begin, double end, bool clamped, double n)
        : begin_(begin), way_(end - begin), step_(end > begin ? 1 : -1) {
        const double low = clamped ? std::max(std::min(begin, end), -1.0) : std::min(begin, end);
        const double high = clamped ? std::min(std::max(begin, end), n + 1) : std::max(begin, end);
        const double first = std::floor(low) + 1, last = std::ceil(high) - 1;
        left_ = std::max(last - first + 1, 0.0);
        at_ = step_ > 0 ? first : last;
    }
    [[nodiscard]] double left() const { return left_; }
    /// Returns the next place; 1 where there is none.
    [[nodiscard]] double next() const {
        return left_ > 0 ? std::clamp((at_ - begin_) / way_, 0.0, 1.0) : 1;
    }
    void advance() {
        at_ += step_;
        --left_;
    }

  private:
    double begin_, way_, step_, left_, at_;
};

} // namespace

Texture::Texture(std::uint32_t width, std::uint32_t height, std::vector<std::uint8_t> rgb,
                 const std::array<double, 256>& linear)
    : width_(width), height_(height), rgb_(std::move(rgb)), linear_(linear),
      blocks_((width + block - 1) / block) {
    sums_.reserve(blocks_ * height);
    for (std::size_t row = 0; row < height; ++row) {
        Vec3 sum(0.0);
        for (std::size_t column = 0; column < width; ++column) {
            if (column % block == 0)
                sums_.push_back(sum);
            sum += texel(column, row);
        }
        mean_ += sum / (double(width) * double(height));
    }
}

double Texture::bytes() const {
    return static_cast<double>(rgb_.size() + cover_.size() + sums_.size() * sizeof(Vec3));
}

Vec3 Texture::texel(std::size_t column, std::size_t row) const {
    const std::uint8_t* const bytes = &rgb_[3 * (row * width_ + column)];
    return {linear_[bytes[0]], linear_[bytes[1]], linear_[bytes[2]]};
}

/// Sums the texels from a column up to that before another.
Vec3 Texture::sum_between(std::size_t first, std::size_t column, std::size_t row) const {
    Vec3 sum(0.0);
    for (std::size_t i = first; i < column; ++i)
        sum += texel(i, row);
    return sum;
}

/// Sums the texels before a column; `column` may be the width.
Vec3 Texture::sum_before(std::size_t column, std::size_t row) const {
    const std::size_t of = std::min(column / block, blocks_ - 1);
    return sums_[row * blocks_ + of] + sum_between(of * block, column, row);
}

/// Integrates a row from `start` to x, which lies in the column.
Vec3 Texture::row_integral(double x, std::int64_t column, std::size_t row, Wrap wrap,
                           std::size_t start) const {
    if (start > 0) {
        const auto last = static_cast<std::size_t>(column);
        return (x - double(column)) * texel(last, row) + sum_between(start, last, row);
    }
    const std::int64_t n = width_;
    const std::size_t stands = wrapped(column, n, wrap);
    const Vec3 here = texel(stands, row);
    if (wrap == Wrap::clamp && column < 0)
        return x * here;
    if (wrap == Wrap::clamp && column >= n)
        return sum_before(width_, row) + (x - double(n)) * here;
    const Vec3 within = (x - double(column)) * here;
    if (column >= 0 && column < n)
        return within + sum_before(stands, row);
    const Vec3 all = sum_before(width_, row);
    const std::int64_t turns = (column - modulo(column, n)) / n;
    const bool reversed = wrap == Wrap::mirror && modulo(turns, 2) == 1;
    return double(turns) * all + within +
           (reversed ? all - sum_before(stands + 1, row) : sum_before(stands, row));
}

Vec3 Texture::at(const Vec2& place, Wraps wraps) const {
    return texel(wrapped(static_cast<std::int64_t>(std::floor(place.x)), width_, wraps.x),
                 wrapped(static_cast<std::int64_t>(std::floor(place.y)), height_, wraps.y));
}

/// Returns the number of the texel at a place, or as many as there are where it has none.
std::size_t Texture::number_of(const Vec2& place, Wraps wraps) const {
    constexpr double farthest = 1e15; // beyond it a texel has no number
    const Vec2 at = place * Vec2(width_, height_);
    if (!(std::abs(at.x) < farthest && std::abs(at.y) < farthest))
        return std::size_t{width_} * height_;
    return wrapped(static_cast<std::int64_t>(std::floor(at.y)), height_, wraps.y) * width_ +
           wrapped(static_cast<std::int64_t>(std::floor(at.x)), width_, wraps.x);
}

Vec3 Texture::texel_at(const Vec2& place, Wraps wraps) const {
    const std::size_t number = number_of(place, wraps);
    return number < std::size_t{width_} * height_ ? texel(number, 0) : mean_;
}

double Texture::cover_at(const Vec2& place, Wraps wraps) const {
    const std::size_t number = number_of(place, wraps);
    return number < cover_.size() ? cover_[number] / 255.0 : 1;
}

/// Returns the integral of F dy along an edge.
Vec3 Texture::edge_integral(const Vec2& from, const Vec2& to, Wraps wraps,
                            std::size_t start) const {
    Crossings across(from.x, to.x, wraps.x == Wrap::clamp, width_);
    Crossings down(from.y, to.y, wraps.y == Wrap::clamp, height_);
    Vec3 sum(0.0);
    for (double begin = 0; begin < 1;) {
        const double column = across.next(), row = down.next(), end = std::min(column, row);
        if (across.left() > 0 && column <= end)
            across.advance();
        if (down.left() > 0 && row <= end)
            down.advance();
        const Vec2 middle = from + .5 * (begin + end) * (to - from);
        if (end > begin)
            sum += (end - begin) * (to.y - from.y) *
                   row_integral(
                       middle.x, static_cast<std::int64_t>(std::floor(middle.x)),
                       wrapped(static_cast<std::int64_t>(std::floor(middle.y)), height_, wraps.y),
                       wraps.x, start);
        begin = std::max(begin, end);
    }
    return sum;
}

/// Returns the mean over places between the middle and the border.
Vec3 Texture::sampled_mean(std::span<const Vec2> polygon, Wraps wraps) const {
    constexpr int steps = 8;
    constexpr double inwards = .25;
    Vec2 middle(0.0);
    for (const Vec2& corner : polygon)
        middle += corner / double(polygon.size());
    Vec3 sum(0.0);
    for (std::size_t k = 0; k < polygon.size(); ++k)
        for (int i = 0; i < steps; ++i) {
            const Vec2 on_border =
                glm::mix(polygon[k], polygon[(k + 1) % polygon.size()], (i + .5) / steps);
            sum += at(glm::mix(on_border, middle, inwards), wraps);
        }
    return sum / double(steps * polygon.size());
}

Vec3 Texture::mean_over(std::span<const Vec2> polygon, Wraps wraps) const {
    const Vec2 size(width_, height_), periods(period(wraps.x, size.x), period(wraps.y, size.y));
    std::vector<Vec2> corners(polygon.begin(), polygon.end());
    Vec2 low(1e300), high(-1e300);
    for (Vec2& corner : corners) {
        corner *= size;
        if (!std::isfinite(corner.x + corner.y))
            return mean_;
        low = glm::min(low, corner);
        high = glm::max(high, corner);
    }
    // The polygon is moved near the origin, where numbers are most precise.
    Vec2 origin(0.0);
    for (int axis = 0; axis < 2; ++axis)
        if (periods[axis] > 0)
            origin[axis] = std::floor(low[axis] / periods[axis]) * periods[axis];
    Vec2 crossed = high - low;
    for (int axis = 0; axis < 2; ++axis)
        if (periods[axis] == 0)
            crossed[axis] = std::min(high[axis], size[axis]) - std::max(low[axis], 0.0);
    const double farthest = std::max(glm::length(low), glm::length(high));
    constexpr double precise = 1e12; // texels
    if (!(std::max(crossed.x, crossed.y) <= max_crossings) || !(farthest <= precise))
        return mean_;
    double area = 0;
    Vec3 integral(0.0);
    for (Vec2& corner : corners)
        corner -= origin;
    // Any column will do as the start of all rows. One beside a small polygon saves most texels.
    const Vec2 first = low - origin, last = high - origin;
    const bool is_small = first.x >= 2 && last.x < size.x && last.x - first.x <= block;
    const std::size_t start = is_small ? static_cast<std::size_t>(first.x) - 1 : 0;
    for (std::size_t k = 0; k < corners.size(); ++k) {
        const Vec2& from = corners[k];
        const Vec2& to = corners[(k + 1) % corners.size()];
        area += .5 * cross(from - corners[0], to - corners[0]);
        if (from.y != to.y)
            integral += edge_integral(from, to, wraps, start);
    }
    const Vec2 extent = high - low;
    constexpr double thin = 1e-6;
    if (!(std::abs(area) > thin * glm::dot(extent, extent)))
        return sampled_mean(corners, wraps);
    return glm::clamp(integral / area, 0.0, 1.0);
}

const std::array<double, 256>& srgb_to_linear() {
    static const std::array<double, 256> table = [] {
        std::array<double, 256> values{};
        for (std::size_t k = 0; k < values.size(); ++k) {
            const double c = double(k) / 255;
            values[k] = c <= .04045 ? c / 12.92 : elementary::pow((c + .055) / 1.055, 2.4);
        }
        return values;
    }();
    return table;
}

} // namespace hemilux
