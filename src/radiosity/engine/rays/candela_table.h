#pragma once
// The intensity of a light by direction, as a goniophotometer measures it: luminous intensities at
// angles of type C (LM-63, CIE 121), and bilinear in both angles between.
//
// gamma is the angle from the light's axis, which is nadir for a lamp that hangs; C is the angle
// around the axis, from the direction `side`. A table may hold a part of the circle, when the light
// is symmetric.

#include "geometry/vector.h"

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace hemilux {

class CandelaTable {
  public:
    /// Takes intensities [cd] by C and then gamma. Angles [degrees] ascend: gamma within [0, 180],
    /// C from 0 to 0 (alike all around), 90 (symmetric to both planes), 180 (to the plane of C = 0)
    /// or 360, or from 90 to 270 (to the plane of C = 90). Throws std::invalid_argument for others,
    /// with what is wrong.
    CandelaTable(std::vector<double> gamma, std::vector<double> c, std::vector<double> candela);

    /// Returns the intensity in a direction [cd]; 0 at angles gamma that the table does not hold.
    /// All vectors are of unit length, and `side` is perpendicular to the axis.
    [[nodiscard]] double towards(const Vec3& direction, const Vec3& axis, const Vec3& side) const;
    /// Returns all numbers: the angles gamma and C, the intensities.
    [[nodiscard]] std::array<std::span<const double>, 3> numbers() const {
        return {gamma_, c_, candela_};
    }
    [[nodiscard]] double largest() const { return largest_; }
    /// Returns the integral over all directions [lm].
    [[nodiscard]] double flux() const;

  private:
    [[nodiscard]] double candela(std::size_t c, std::size_t gamma) const {
        return candela_[c * gamma_.size() + gamma];
    }
    [[nodiscard]] double folded(double c) const;

    std::vector<double> gamma_, c_, candela_;
    double largest_ = 0;
};

} // namespace hemilux
