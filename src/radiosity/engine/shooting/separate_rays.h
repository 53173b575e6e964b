#pragma once
// Rays of a bounce that are shot separately from those of the strategy, as straight to a small
// target. They carry a part of the power; the strategy's rays along the same directions carry none
// of it. So all of the power is shot, each part by one kind of ray.

#include "bvh/tracer.h"
#include "geometry/vector.h"
#include "parallel/function_ref.h"

#include <cstdint>
#include <span>
#include <vector>

namespace hemilux {

class Workers;
struct SolverInput;

/// The power that is shot in a bounce.
struct BouncePower {
    std::span<const std::uint32_t> senders; ///< patches that hold power, ascending
    std::span<const Vec3> unshot;           ///< power by patch, of senders
    double ray_power; ///< power that each ray is to carry on average, mean of channels
};

/// Rays, and where each arrived.
struct SeparateShots {
    std::vector<Ray> rays;
    std::vector<double> power; ///< power over that of the sender [-]
    std::vector<std::uint32_t> senders, receivers;
};

class SeparateRays {
  public:
    virtual ~SeparateRays() = default;
    /// Returns whether these rays carry the power along a ray of the strategy.
    [[nodiscard]] virtual bool carry(std::uint32_t patch, const Ray& ray) const = 0;
    /// Shoots those of a bounce. `collect` gets them in a fixed order, whichever thread shot them;
    /// when interrupted, they may not be whole.
    virtual void shoot(const SolverInput& input, const BouncePower& bounce, std::uint64_t stream,
                       const Workers& workers,
                       FunctionRef<void(const SeparateShots&)> collect) const = 0;
};

} // namespace hemilux
