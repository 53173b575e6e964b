#pragma once
// The part of a strategy that changes from step to step: it is called when a step begins and ends,
// and may learn from what rays hit.

#include "bvh/tracer.h"
#include "geometry/vector.h"

#include <cstdint>
#include <span>
#include <vector>

namespace hemilux {

class StateReader;
class StateWriter;

class StepHook {
  public:
    virtual ~StepHook() = default;
    /// Is called before each step except the pilot, with estimates of the radiosity by patch [W/m2]
    /// and the power of a ray. This power is the mean of channels [W/m2 times area in local units].
    /// The radiosity of each patch is multiplied by the factor on its rays for a target, if there
    /// is one.
    virtual void prepare(std::span<const Vec3> /*radiosity*/, double /*ray_power*/) {}
    /// Is called when a step begins; the first is 0. Allocations that follow belong to it.
    virtual void begin_step(std::uint64_t /*step*/) {}
    /// Is called when a step ends, unless it was interrupted: what was learned in an interrupted
    /// step is to be forgotten.
    virtual void end_step() {}
    /// Returns the factor on the rays that power alone would give to the patch; each ray carries as
    /// much less power. The factor is positive, the same throughout a step, and on average over all
    /// power about 1.
    [[nodiscard]] virtual double rays_for_power(std::uint32_t /*patch*/) const { return 1; }

    /// Returns whether it learns in this step from what its rays hit.
    [[nodiscard]] virtual bool learns() const { return false; }
    /// Adds for each ray the cell of its receiver's hemisphere that it comes from, as `learn` takes
    /// it. It may be called from several threads.
    virtual void find_arrivals(std::span<const Ray> /*rays*/,
                               std::span<const std::uint32_t> /*receivers*/,
                               std::vector<std::uint16_t>& /*added to*/) const {}
    /// Is called in a fixed order with where the rays of a cell arrived (receivers.h).
    virtual void learn(std::uint32_t /*patch*/, std::uint16_t /*cell*/,
                       std::span<const std::uint32_t> /*receivers*/,
                       std::span<const std::uint16_t> /*arrivals*/) {}

    /// These save and load what was learned, as Solver does.
    virtual void save(StateWriter&) const {}
    virtual void load(StateReader&) {}
};

} // namespace hemilux
