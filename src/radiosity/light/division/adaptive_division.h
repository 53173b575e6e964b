#pragma once
// The division of patches where the light changes within them.
//
// The division goes in rounds. The light of a rough solution is gathered at points of the patches
// that are new, and the patches on which it varies most are divided. Pieces send on what their
// patch sent, until there are so many of them that the light is solved anew. The rounds end when
// what varies within patches is as small as it is asked to be. If the solution is for a target
// (Solution::weight), patches count as division_weights() says, and others are neither measured nor
// divided.

#include "bvh/tracer.h"
#include "parallel/workers.h"
#include "radiosity/engine/solving/run.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

namespace hemilux {

class Mesh;
struct LightWithinPatches;

struct AdaptiveDivision {
    /// The relative error of the light that the division alone may leave [-].
    double error = .05;
    /// The number of patches that is not exceeded.
    std::size_t max_patches = 1'000'000;
    std::uint64_t seed = 1;
    unsigned threads = 0;     ///< 0: one per core. The result does not depend on it.
    bool keep_all = false;    ///< SolveOptions::keep_all, of the solutions of rounds
    std::uint64_t memory = 0; ///< bytes that a solution may use for its rays; 0: no limit
    /// The number of rays of all rounds after which none is begun; a solution of a round takes no
    /// more than are left.
    std::uint64_t max_rays = std::numeric_limits<std::uint64_t>::max();
};

/// This is what was found in a round, before its patches were divided.
struct DivisionRound {
    std::size_t patches;
    double error;       ///< of the division, from few points a patch
    std::uint64_t rays; ///< of the rough solution, where there was a new one, and of the points
};

/// Returns when a solution is good enough to divide by, or cannot be made so.
[[nodiscard]] StopRule rough_stop(const AdaptiveDivision& options, std::size_t patches);

/// Returns a solution that is good enough to divide by, of the mesh as it is; `target` is
/// SolverInput::target. If it has no steps, none was found.
[[nodiscard]] Solution rough_solution(const Mesh& mesh, const Tracer& tracer,
                                      const AdaptiveDivision& options, Monitor& monitor,
                                      std::span<const double> target = {});

/// This is what is known of how the light varies within patches. The tracer, which is that of the
/// mesh, remains right when patches are divided.
class Division {
  public:
    Division(Mesh& mesh, const Tracer& tracer, const AdaptiveDivision& options, Monitor& monitor);

    /// Divides until linear functions leave `error`, or nothing more can be divided. `light` is of
    /// the mesh as it is, and then of the divided one: pieces have what their patch had. Returns
    /// whether patches were divided. If it was interrupted, the mesh is divided as far as the
    /// rounds before came.
    bool divide(Solution& light, double error,
                const std::function<void(const DivisionRound&)>& after_round = {});
    /// Makes the light on patches linear functions of the place, whose noise is well below `error`.
    /// Returns the rays that this took.
    std::uint64_t add_slopes(Solution& light, double error);
    /// Returns by patch the squared error [local area x (W/m2)^2] that linear functions leave, as
    /// far as it is known.
    [[nodiscard]] std::span<const double> squares() const { return square_; }
    /// Returns by patch the slopes of the light as it was measured.
    [[nodiscard]] std::vector<Slope> slopes() const;
    /// Makes each patch be measured once more before it is divided: what was missed so far may be
    /// found.
    void doubt();

  private:
    [[nodiscard]] bool solve_if_due(Solution& light);
    void weigh(const Solution& light);
    [[nodiscard]] double counts(std::size_t patch) const {
        return weight_.empty() ? 1 : weight_[patch];
    }
    void measure(const Solution& light, double goal);
    void measure(const Solution& light, std::span<const std::uint32_t> some, unsigned rounds,
                 unsigned max_rows, double stand_for = 1);
    [[nodiscard]] bool are_even(const Solution& light, std::span<const std::uint32_t> patches,
                                std::span<const double> held, double allowed);
    [[nodiscard]] LightWithinPatches within(const Solution& light,
                                            std::span<const std::uint32_t> some, unsigned rounds,
                                            unsigned max_rows);
    [[nodiscard]] bool is_done(double goal) const;
    [[nodiscard]] bool cut(Solution& light, double goal);

    Mesh& mesh_;
    const Tracer& tracer_;
    AdaptiveDivision options_;
    Monitor& monitor_;
    Workers workers_;
    std::size_t solved_;         ///< patches of the last solution
    std::uint64_t measured_ = 0; ///< so many times
    std::uint32_t round_ = 0;
    std::uint64_t spent_ = 0; ///< rays of the rounds before
    // These belong to this round:
    std::uint64_t rays_ = 0;
    double fresh_ = 0, fresh_squares_ = 0; ///< sums of what was measured, and of its squares
    std::vector<double> weight_; ///< by patch, of its square (division_weights.h); empty: 1
    // These are, by patch, the means of what was measured there, as of light_within_patches():
    std::vector<double> square_, times_;
    std::vector<std::array<Slope, 2>> slopes_;
    std::vector<std::uint8_t> is_due_;       ///< to be measured
    std::vector<std::uint32_t> measured_at_; ///< the round, at last
};

} // namespace hemilux
