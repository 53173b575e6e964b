#pragma once
// How many rays are to be traced next, of which kind, and from which patches.

#include "geometry/vector.h"
#include "parallel/workers.h"
#include "radiosity/scene/needs.h"

#include <cstdint>
#include <span>
#include <vector>

namespace hemilux {

class Mesh;
class StateReader;
class StateWriter;

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
    void leave_out(const std::vector<bool>& lit);
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

    /// From now on more to patches to which light comes that is uneven; none to those that no light
    /// reaches (`lit`), as far as all rays know. `variance`: of the light over the directions of
    /// each patch, by channel.
    ///
    /// How many rays a patch gets must not depend on what its own rays have found: where they
    /// missed something rare, their variance is too small, fewer rays would follow, and the mean of
    /// all would stay wrong. So a patch is weighed by its neighbours, and but once, by the first
    /// rays that found light, which are soon a small part of all.
    void weigh(std::span<const Vec3> variance, const std::vector<bool>& lit);

    /// From now on more shadow rays from patches whose light from emitters is uncertain.
    /// `variance`: of each patch, times its area, in any unit; negative: it takes none.
    void weigh_emitters(std::span<const double> variance, const std::vector<bool>& lit);

    void save(StateWriter& state) const;
    /// Takes the state of a plan made with the same arguments. Throws StateError for what save()
    /// cannot have written.
    void load(StateReader& state);

  private:
    struct RayBudget {
        double random = 0, to_emitters = 0; ///< means over the patches that are to get more
        PlannedRays rays;
    };
    [[nodiscard]] double of_neighbours(std::uint32_t patch, std::span<const double> known) const;
    void learn(std::span<const Vec3> variance);
    [[nodiscard]] bool has_target() const { return !aim_.empty(); }
    [[nodiscard]] std::vector<double> expected_rays(std::span<const double> weights) const;
    [[nodiscard]] double first_mean(double mean) const;
    [[nodiscard]] std::vector<std::uint32_t> allocate(std::span<const double> weights, double mean,
                                                      std::span<const std::uint32_t> already) const;
    static void mix(std::span<const double> known, std::span<const double> prior,
                    std::vector<double>& weights);
    void choose(const ErrorSoFar& known);
    void split(double rays, const ErrorSoFar& known);
    [[nodiscard]] double predicted(const ErrorSoFar& known) const;

    const Mesh& mesh_;
    RayGoal goal_;
    RayBudget first_, before_, now_;
    std::vector<Vec3> reflectance_;
    std::vector<double> weights_, emitter_weights_; ///< importance of a ray
    std::vector<double> learned_weights_;           ///< of random rays, were all patches lit
    bool has_learned_ = false;
    std::vector<double> aim_; ///< by patch, a factor of all weights; empty: there is no target
    std::vector<double> prior_weights_;         ///< of random rays, before anything is known
    std::vector<double> prior_emitter_weights_; ///< likewise of shadow rays
};

} // namespace hemilux
