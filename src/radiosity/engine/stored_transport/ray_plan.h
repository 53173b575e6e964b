#pragma once
// Plans how many rays are to be traced next, and of which kind. From which patches is decided in
// ray_weights.h.

#include "geometry/vector.h"
#include "parallel/workers.h"
#include "radiosity/engine/stored_transport/ray_weights.h"
#include "radiosity/paper/scene/needs.h"

#include <cstdint>
#include <span>
#include <vector>

namespace hemilux {

/// The rays of each patch.
struct PlannedRays {
    std::vector<std::uint32_t> random;      ///< cosine-distributed
    std::vector<std::uint32_t> to_emitters; ///< shadow rays
};

/// The number of rays that a step adds.
struct RayGoal {
    /// A growing step adds as many as there are, or as it takes to reach `aim`; else it adds as
    /// many as the first step had.
    bool growing = true;
    /// The relative error to be reached [-]; 0 where none is asked for.
    double aim = 0;
};

/// The error of the solution so far.
struct ErrorSoFar {
    double relative = 0;               ///< error as it is reported [-]
    double variance = 0;               ///< variance in any unit
    double variance_from_emitters = 0; ///< the part of it that comes from shadow rays
    bool drained = true;               ///< the rays have seen a way out for the light
};

class RayPlan {
  public:
    /// Makes a plan from the first step's means, of one batch. `to_emitters` is 0 where there are
    /// no emitters to be reached.
    RayPlan(const Mesh& mesh, const Needs& needs, double random, double to_emitters,
            const RayGoal& goal);

    /// Plans a few rays of each patch, which show what light can reach: leave_out.
    void begin();
    /// Gives no more rays to patches that no light has reached by these rays, from the first step
    /// on.
    void leave_out(const std::vector<bool>& lit) { weights_.leave_out(lit); }
    /// Gives more rays in the following steps to patches by whose light a target is lit.
    /// `importance` is that of the variance at each patch (importance_of_rays), over that where all
    /// patches are the target; a patch with 0 gets no more rays. A step that grows begins with as
    /// many rays of important patches as there would be without a target. A plan does not save the
    /// importance.
    void aim(std::span<const double> importance);

    /// Makes the following steps that grow reach this error, as RayGoal::aim.
    void aim_at(double error) { goal_.aim = error; }

    /// Plans more rays than before, at most `room` times as many random ones, and at most
    /// `max_rays` of one batch in all, if a ray of each patch is not more. `known` is not used for
    /// the first step.
    void grow(const ErrorSoFar& known, double room, double max_rays, const Workers& workers);
    /// There is no step with less room than this.
    static constexpr double min_growth = 1.19;

    /// Returns the rays, counted from the start until the next step ends.
    [[nodiscard]] const PlannedRays& rays() const { return now_.rays; }
    [[nodiscard]] bool at_most() const;
    /// Returns whether the first step was planned.
    [[nodiscard]] bool has_begun() const { return now_.random > 0; }

    /// Gives more rays to some patches in the following steps, as RayWeights says.
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
    void allocate_all(const Workers& workers);
    /// Takes rays from the step, if it has more than it must have.
    [[nodiscard]] bool shrink();
    void choose(const ErrorSoFar& known);
    void split(double rays, const ErrorSoFar& known);
    [[nodiscard]] double predicted(const ErrorSoFar& known) const;

    RayWeights weights_;
    RayGoal goal_;
    RayBudget first_, before_, now_;
    std::vector<double> aim_; ///< factors of all weights, by patch; empty: there is no target
};

} // namespace hemilux
