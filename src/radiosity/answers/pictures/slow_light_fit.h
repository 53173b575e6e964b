#pragma once
// Light that varies slowly, and a linear function of it.

#include "geometry/vector.h"

#include <array>

namespace hemilux {

/// Irradiance that varies slowly [W/m2].
struct SlowLight {
    glm::vec3 unshadowed{0.0f}; ///< straight from small emitters if nothing stood between
    glm::vec3 indirect{0.0f};

    void add(const SlowLight& light, float weight) {
        unshadowed += weight * light.unshadowed;
        indirect += weight * light.indirect;
    }
};

/// A linear function of the steps from a place, by weighted least squares.
class SlowLightFit {
  public:
    /// Begins with the light at the place itself, of weight 1.
    explicit SlowLightFit(const SlowLight& here) : sum_(here) {}

    void add(const Vec2& offset, const SlowLight& light, double weight) {
        weight_ += weight;
        mean_ += weight * offset;
        squares_ += weight * offset * offset;
        product_ += weight * offset.x * offset.y;
        sum_.add(light, float(weight));
        by_x_.add(light, float(weight * offset.x));
        by_y_.add(light, float(weight * offset.y));
    }
    [[nodiscard]] double weight() const { return weight_; }

    struct Linear {
        SlowLight light; ///< at the place, not negative
        std::array<SlowLight, 2> slope;
    };
    [[nodiscard]] Linear solve() const {
        const Vec2 mean = mean_ / weight_, squares = squares_ - weight_ * mean * mean;
        const double product = product_ - weight_ * mean.x * mean.y,
                     determinant = squares.x * squares.y - product * product;
        SlowLight by_x = by_x_, by_y = by_y_;
        by_x.add(sum_, float(-mean.x));
        by_y.add(sum_, float(-mean.y));
        Linear found;
        auto& [light, slope] = found;
        slope[0].add(by_x, float(squares.y / determinant));
        slope[0].add(by_y, float(-product / determinant));
        slope[1].add(by_y, float(squares.x / determinant));
        slope[1].add(by_x, float(-product / determinant));
        light = {sum_.unshadowed / float(weight_), sum_.indirect / float(weight_)};
        light.add(slope[0], float(-mean.x));
        light.add(slope[1], float(-mean.y));
        light = {glm::max(light.unshadowed, 0.0f), glm::max(light.indirect, 0.0f)};
        return found;
    }

  private:
    double weight_ = 1;
    Vec2 mean_{0.0}, squares_{.5}; ///< not 0, so that a few places do not say much of a slope
    double product_ = 0;
    SlowLight sum_, by_x_, by_y_;
};

} // namespace hemilux
