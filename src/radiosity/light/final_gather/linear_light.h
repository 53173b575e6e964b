#pragma once
// The light on a patch as a linear function of the place.
//
// The linear function that is nearest to the light has the patch's mean in its centre of mass and
// two slopes. They are found by least squares from the light at some points of the patch. Points
// that share their random numbers have noise that is much the same, which slopes do not see.

#include "radiosity/light/final_gather/surface_points.h"
#include "radiosity/paper/scene/mesh.h"
#include "radiosity/paper/solution/solution.h"

#include <array>
#include <span>
#include <vector>

namespace hemilux {

/// Two independent estimates of the irradiance at each of some points of one patch, in turn, with
/// the linear functions that are nearest to them.
class LinearLight {
  public:
    LinearLight(const Patch& patch, std::span<const PatchPoint> points,
                std::span<const Vec3> irradiance);

    /// Returns the variance over the patch that the linear function leaves, by channel. It is an
    /// estimate free of noise, which may be negative.
    [[nodiscard]] Vec3 variance_left() const;
    /// Returns the slope by either estimate.
    [[nodiscard]] const std::array<Slope, 2>& slopes() const { return slope_; }

    /// Fewer points leave nothing to judge a linear function by.
    static constexpr std::size_t min_points = 4;

  private:
    [[nodiscard]] double count() const { return static_cast<double>(at_.size()); }

    std::vector<Vec2> at_; ///< from the mean of the points
    double xx_ = 0, xy_ = 0, yy_ = 0;
    std::span<const Vec3> irradiance_;
    std::array<Vec3, 2> mean_{};
    std::array<Slope, 2> slope_{};
};

/// Returns the variance of a linear function over its patch, summed over channels. A quad counts as
/// a parallelogram.
[[nodiscard]] double variance_of(const Patch& patch, const Slope& slope);

/// The mean of two estimates of a slope, reduced where they do not agree. `noise` is area times the
/// variance over the patch that it has from their noise, summed over channels.
struct AgreedSlope {
    Slope slope;
    double noise;
};
[[nodiscard]] AgreedSlope agreed_slope(const Patch& patch, const std::array<Slope, 2>& estimates);

} // namespace hemilux
