#pragma once
// How the triangles of a hemisphere share the rays of their patch (paper section 5b).
//
// A patch owns an interval of the line of rays (Due in step.h), and each triangle a part of that as
// long as its share N_tr / N_hemi. Shares are summed, and the sums are rounded to floats as the
// engine keeps them (engine/shooting/strategy.h): the page and the engine then have the same bits.

#include "radiosity/paper/pages/step.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace hemilux::plain {

class ShareLine {
  public:
    /// Begins without triangles. A patch is due so many rays by its power, or `N_hemi` whatever its
    /// power.
    ShareLine(const Due& due, double N_hemi) : due_(due), N_hemi_(N_hemi) {}

    /// Adds a triangle that is to get this share of the rays. Rounding leaves none without rays.
    void add(double share) {
        constexpr float most = std::numeric_limits<float>::max();
        const float before = up_to_.back(), after = static_cast<float>(sum_ += share);
        up_to_.push_back(share > 0 && !(after > before) ? std::nextafter(before, most)
                                                        : std::max(before, after));
    }
    /// Returns N_tr of triangle k as printed: rounded to the nearest whole number.
    [[nodiscard]] Rays rounded(std::size_t k) const { return rays_rounded(N_hemi_ * share(k)); }
    /// Returns N_tr of triangle k where N_hemi is what its patch is due. It is rounded up or down,
    /// as whole numbers stand on its part of the line.
    [[nodiscard]] Rays on_line(std::size_t k) const {
        const double N_hemi = due_.rays() / up_to_.back(); // all shares sum to 1, but for rounding
        const auto place = [&](float sum) {
            return sum < up_to_.back() ? due_.begin + N_hemi * sum : due_.end;
        };
        return rays_on_line(N_hemi * share(k), place(up_to_[k]), place(up_to_[k + 1]));
    }

  private:
    [[nodiscard]] double share(std::size_t k) const {
        return double(up_to_[k + 1]) - double(up_to_[k]);
    }

    Due due_;
    double N_hemi_, sum_ = 0;
    std::vector<float> up_to_{0}; ///< sums of the shares before each triangle, and of all
};

} // namespace hemilux::plain
