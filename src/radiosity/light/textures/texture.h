#pragma once
// Stores a picture on surfaces: texels of one colour each, in linear light. It gives their exact
// mean over any polygon.
//
// The integral over a polygon follows from its border (Green's theorem). With F(x, y) the integral
// of the row at y from 0 to x, it is the sum over the edges of the integral of F dy. Within a texel
// F is linear in x, so the trapezoid rule is exact there. Only texels on the border are visited,
// and sums along rows stand for those inside. Instead of 0 the rows may begin at any column.

#include "geometry/vector.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace hemilux {

/// The ways in which a picture continues beyond its border.
enum class Wrap : std::uint8_t { repeat, clamp, mirror };
struct Wraps {
    Wrap x = Wrap::repeat, y = Wrap::repeat;
};

class Texture {
  public:
    /// Makes a texture of `rgb`, three bytes per texel, row by row from the top. `linear` gives the
    /// light that a byte means [-], by byte.
    Texture(std::uint32_t width, std::uint32_t height, std::vector<std::uint8_t> rgb,
            const std::array<double, 256>& linear);

    [[nodiscard]] std::uint32_t width() const { return width_; }
    [[nodiscard]] std::uint32_t height() const { return height_; }
    /// Returns the mean of the whole picture.
    [[nodiscard]] const Vec3& mean() const { return mean_; }
    /// Returns the mean over a polygon of three or more places; x runs from 0 (left) to 1, y from 0
    /// (top) to 1. Where edges cross more than 16384 texels it is the picture's mean; polygons
    /// without area are sampled.
    [[nodiscard]] Vec3 mean_over(std::span<const Vec2> polygon, Wraps wraps) const;
    /// Returns the colour of the texel at a place, as mean_over() has them. It is the mean of the
    /// picture where the place is not finite.
    [[nodiscard]] Vec3 texel_at(const Vec2& place, Wraps wraps) const;
    /// Gives each texel what it covers of what lies behind it, by byte: 255 is all of it. Light
    /// does not know of it; files that show the texture do.
    void set_cover(std::vector<std::uint8_t> cover) { cover_ = std::move(cover); }
    /// Returns what the texel at a place covers [-]: 1 where no cover was set.
    [[nodiscard]] double cover_at(const Vec2& place, Wraps wraps) const;
    [[nodiscard]] double bytes() const;

  private:
    [[nodiscard]] std::size_t number_of(const Vec2& place, Wraps wraps) const;
    [[nodiscard]] Vec3 texel(std::size_t column, std::size_t row) const;
    [[nodiscard]] Vec3 sum_between(std::size_t first, std::size_t column, std::size_t row) const;
    [[nodiscard]] Vec3 sum_before(std::size_t column, std::size_t row) const;
    /// Integrates a row from the column `start` to x. `start` is above 0 for polygons within the
    /// picture and right of this column.
    [[nodiscard]] Vec3 row_integral(double x, std::int64_t column, std::size_t row, Wrap wrap,
                                    std::size_t start) const;
    [[nodiscard]] Vec3 at(const Vec2& place, Wraps wraps) const;
    [[nodiscard]] Vec3 edge_integral(const Vec2& from, const Vec2& to, Wraps wraps,
                                     std::size_t start) const;
    [[nodiscard]] Vec3 sampled_mean(std::span<const Vec2> polygon, Wraps wraps) const;

    static constexpr std::size_t block = 16; ///< columns between sums that are kept
    std::uint32_t width_, height_;
    std::vector<std::uint8_t> rgb_, cover_;
    std::array<double, 256> linear_;
    std::size_t blocks_;     ///< of a row
    std::vector<Vec3> sums_; ///< of each row before each block
    Vec3 mean_{0.0};
};

/// Returns the light that bytes mean by the sRGB curve (IEC 61966-2-1).
[[nodiscard]] const std::array<double, 256>& srgb_to_linear();

} // namespace hemilux
