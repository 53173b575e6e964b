#pragma once
// What aims the rays of steps where only a target must be right (SolverInput::target). The engine
// has none; a library above it may add one (additions.h).

#include <memory>

namespace hemilux {

class MeanOfSteps;
class SeparateRays;
class StateReader;
class StateWriter;
struct SolverInput;
struct StepResult;
struct StepTask;

/// Made for one run. The numbers of rays that it finds are MeanOfSteps::aimed.
class Aimer {
  public:
    virtual ~Aimer() = default;
    /// Shoots the rays of the pilot, finds what is important to the target, and sets `mean.aimed`.
    /// Returns false when interrupted.
    virtual bool shoot_pilot(const StepTask& task, StepResult& pilot, MeanOfSteps& mean) = 0;
    /// Returns the rays that are shot separately in each bounce; nullptr if there are none.
    [[nodiscard]] virtual const SeparateRays* separate_rays() const = 0;

    /// These save and load `mean.aimed` and what else was found, as Solver does. Power per ray and
    /// radiosity are loaded before.
    virtual void save(StateWriter& state, const MeanOfSteps& mean) const = 0;
    virtual void load(StateReader& state, MeanOfSteps& mean) = 0;
};

/// Makes the aimer of a run that has a target. Only if `separately` may it have separate rays.
using MakeAimer = std::unique_ptr<Aimer> (*)(const SolverInput&, bool separately);

} // namespace hemilux
