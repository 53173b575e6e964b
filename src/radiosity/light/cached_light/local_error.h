#pragma once
// How far light is off from place to place, relative to the light there. Beside the error over all
// places it tells of a dark room next to a bright one and of bright spots, which a mean hides.

#include <vector>

namespace hemilux {

class LocalErrors {
  public:
    /// Adds a place: the square of what its light is off by, which may be negative by chance, and
    /// the square of that light, in the same unit. A place counts by its weight, such as its area.
    void add(double square_off, double square_light, double weight = 1);

    /// Returns the relative error [-] that 95 of 100 places, by weight, stay within: infinite if
    /// more than the rest are off and show no light, and not a number without places. As each
    /// place's own noise is in it, it errs high where that is not small.
    [[nodiscard]] double within() const;

  private:
    struct Place {
        double square, weight;
    };
    std::vector<Place> places_;
};

} // namespace hemilux
