#pragma once
// How far values at places of a plane are from a linear function of the place.

#include "geometry/vector.h"

#include <algorithm>

namespace hemilux {

class LinearFit {
  public:
    void add(const Vec2& place, double value, double weight) {
        weight_ += weight;
        at_ += weight * place;
        places_ += weight * place * place;
        across_ += weight * place.x * place.y;
        sum_ += weight * value;
        squares_ += weight * value * value;
        slope_ += weight * value * place;
    }
    [[nodiscard]] double weight() const { return weight_; }
    /// Returns the weighted mean of the values, which there must be.
    [[nodiscard]] double mean() const { return sum_ / weight_; }
    /// Returns the weighted mean of their squares.
    [[nodiscard]] double mean_square() const { return squares_ / weight_; }
    /// Returns the weighted mean square of what the function that fits best leaves.
    [[nodiscard]] double variance() const {
        const Vec2 at = at_ / weight_, places = places_ / weight_ - at * at,
                   slope = slope_ / weight_ - mean() * at;
        const double across = across_ / weight_ - at.x * at.y,
                     determinant = places.x * places.y - across * across,
                     variance = mean_square() - mean() * mean();
        double linear = 0;
        if (determinant > 0)
            linear = (slope.x * slope.x * places.y + slope.y * slope.y * places.x -
                      2 * slope.x * slope.y * across) /
                     determinant;
        return std::max(variance - linear, 0.0);
    }

  private:
    double weight_ = 0, across_ = 0, sum_ = 0, squares_ = 0;
    Vec2 at_{0.0}, places_{0.0}, slope_{0.0};
};

} // namespace hemilux
