#pragma once
// How many rays are to be traced next, and of which kind. From which patches: ray_weights.h.

#include "geometry/vector.h"
#include "parallel/workers.h"
#include "radiosity/scene/needs.h"
#include "radiosity/stored_transport/ray_weights.h"

#include <cstdint>
#include <span>
#include <vector>

namespace hemilux {

/// Rays of each patch.
struct PlannedRays {
    std::vector<std::uint32_t> random;      ///< cosine-distributed
    std::vector<std::uint32_t> to_emitters; ///< shadow rays
};

/// How many rays a step adds.
struct RayGoal {
    /// As many as there are, or as it takes to reach `aim`; else as many as the first step had.
    bool growing = true;
    /// Relative error to be reached; 0: none is asked for.
    double aim = 0;
};

/// The error of the solution so far.
struct ErrorSoFar {
    double relative = 0;               ///< as it is reported [-]
    double variance = 0;               ///< in any unit
    double variance_from_emitters = 0; ///< the part of it that comes from shadow rays
    bool drained = true;               ///< the rays have seen a way out for the light
};

class RayPlan {
  public:
    /// The first step's means, of one batch; no `to_emitters`: there are no emitters to be reached.
    /// The mesh outlives this.
    RayPlan(const Mesh& mesh, const Needs& needs, double random, double to_emitters,
            const RayGoal& goal);

    /// Plans a few rays of each patch, which show what light can reach: leave_out.
    void begin();
    /// From the first step on, patches that no light has reached by these rays get no more.
    void leave_out(const std::vector<bool>& lit) { weights_.leave_out(lit); }
    /// From now on more rays to patches by whose light a target is lit: `importance` of the
    /// variance at each (importance_of_rays), over that where all patches are the target. A step
    /// that grows begins with as many rays of important patches as there would be without a target.
    /// 0: no more rays. A plan does not save it.
    void aim(std::span<const double> importance);

    /// From now on steps that grow are to reach this error, as RayGoal::aim.
    void aim_at(double error) { goal_.aim = error; }

    /// Plans more rays than before, at most `room` times as many random ones; `known` is not used
    /// for the first step.
    void grow(const ErrorSoFar& known, double room, const Workers& workers);
    /// With less room than this there is no step.
    static constexpr double least_growth = 1.19;

    /// Counts them from the start until the next step ends.
    [[nodiscard]] const PlannedRays& rays() const { return now_.rays; }
    [[nodiscard]] bool at_most() const;
    /// Whether the first step was planned.
    [[nodiscard]] bool has_begun() const { return now_.random > 0; }

    /// From now on more rays from some patches, as RayWeights says.
    void weigh(std::span<const Vec3> variance, const std::vector<bool>& lit) {
        weights_.weigh(variance, lit);
    }
    void weigh_emitters(std::span<const double> variance, const std::vector<bool>& lit) {
        weights_.weigh_emitters(variance, now_.rays.to_emitters, lit);
    }

    void save(StateWriter& state) const;
    /// Takes the state of a plan made with the same arguments. Throws StateError for what save()
    /// cannot have written.
    void load(StateReader& state);

  private:
    struct RayBudget {
        double random = 0, to_emitters = 0; ///< means over the patches that are to get more
        PlannedRays rays;
    };
    [[nodiscard]] bool has_target() const { return !aim_.empty(); }
    [[nodiscard]] std::vector<double> expected_rays(std::span<const double> weights) const;
    [[nodiscard]] double first_mean(double mean) const;
    [[nodiscard]] std::vector<std::uint32_t> allocate(std::span<const double> weights, double mean,
                                                      std::span<const std::uint32_t> already) const;
    void choose(const ErrorSoFar& known);
    void split(double rays, const ErrorSoFar& known);
    [[nodiscard]] double predicted(const ErrorSoFar& known) const;

    RayWeights weights_;
    RayGoal goal_;
    RayBudget first_, before_, now_;
    std::vector<double> aim_; ///< by patch, a factor of all weights; empty: there is no target
};

} // namespace hemilux
