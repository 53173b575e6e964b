#pragma once
// Tests every ray against every facet. This is slow and obviously right, so it is the referee of
// the BVH.

#include "bvh/intersect.h"

namespace hemilux {

class BruteForce final : public Tracer {
  public:
    explicit BruteForce(const FacetSoup& soup) : soup_(soup) {}

    [[nodiscard]] std::optional<Hit> closest(const Ray& ray) const override;
    [[nodiscard]] bool occluded(const Ray& ray, std::uint32_t target) const override;
    [[nodiscard]] std::uint32_t count(const Ray& ray) const override;

  private:
    FacetSoup soup_;
};

} // namespace hemilux
