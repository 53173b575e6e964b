#pragma once
// Shoots the part of a bounce that goes straight to the balls of a target (target_balls.h).

#include "radiosity/engine/shooting/separate_rays.h"
#include "radiosity/research/targets/target_balls.h"

#include <utility>

namespace hemilux {

class RaysToBalls final : public SeparateRays {
  public:
    RaysToBalls() = default; ///< there are no balls
    explicit RaysToBalls(TargetBalls its_balls) : balls(std::move(its_balls)) {}

    [[nodiscard]] bool carry(std::uint32_t patch, const Ray& ray) const override {
        return balls.takers(patch, ray.origin, ray.direction) > 0;
    }
    void shoot(const SolverInput& input, const BouncePower& bounce, std::uint64_t of_bounce,
               const Workers& workers,
               FunctionRef<void(const SeparateShots&)> collect) const override;

    TargetBalls balls;

  private:
    void shoot(const SolverInput& input, const BouncePower& bounce,
               std::span<const double> rays_before, double from, double to, std::uint64_t stream,
               SeparateShots& shots) const;
};

} // namespace hemilux
