// Progressive radiosity (paper section 3.1; Cohen, Chen, Wallace and Greenberg 1988).
//
// The patch with the most unshot power shoots it to all others at once:
//
//     B_i += rho_i dB_s F_is,
//
// where F_is is the form factor from the receiver i to the shooter s, so that the one from s to i
// need not be known (A_i F_is = A_s F_si). Form factors are computed on the fly as by Wallace,
// Elmquist and Haines (1989). At a point of the receiver, this is the closed form of point and
// polygon times the visibility along a ray to the shooter. There are more points where more light
// may come (pair_factor.h). Each shot draws new ones.
//
// The parameter is --rays. A step is as many shots as use up so many points per patch, one at
// least. The form factors are the more accurate, the more rays are asked for. When hardly any power
// is left unshot, a pass is done: with 64 rays it is within 1 or 2 % of the exact solution. The
// next one begins again, four times as accurate, and the result is the mean of the passes, weighted
// by their rays. --one-shot makes a step of each shot and ends with the first pass. --ambient shows
// what is still unshot, and --overshoot shoots ahead (ProgressiveOptions).
//
// With --factors hemicube, the shooter's hemicube shows the form factors to all others at once,
// with one ray per pixel, as in Cohen et al. (1988): F_is = F_si A_s / A_i. Another pass would see
// the same, so the run ends with the first; its error is not random, and is not estimated
// (hemicube.h).
//
// The standard error has three parts: that of each patch, pooled with its neighbours that are like
// it; that of all light together, spread evenly; and what is still unshot (progressive_pass.h).
//
// The method is good for a first picture after few shots, and for the shadows of few small
// emitters. It is bad with many patches and high reflectances, as each patch shoots many times. It
// needs hardly any memory. It is not unbiased: after a finite number of shots some light is
// missing.

#include "geometry/elementary.h"
#include "radiosity/engine/form_factors/factor_options.h"
#include "radiosity/engine/progressive/progressive_options.h"
#include "radiosity/engine/progressive/progressive_pass.h"
#include "radiosity/engine/solving/engine_solver.h"
#include "radiosity/engine/solving/method_option.h"
#include "radiosity/engine/solving/one_shot.h"
#include "radiosity/engine/solving/own_options.h"
#include "radiosity/paper/pages/pages.h"
#include "radiosity/paper/scene/alike_neighbours.h"
#include "radiosity/paper/scene/mesh.h"
#include "radiosity/paper/solution/error_spread.h"
#include "radiosity/paper/solution/solve_error.h"
#include "radiosity/paper/solving/check_input.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <vector>

namespace hemilux {
namespace {

/// For each of --rays, a receiver traces this many shadow rays in a shot that gives it as much
/// light as the mean patch reflects in the end. Other shots get them in proportion. This holds for
/// the first pass; the next has four times as many, which about halves the error.
constexpr double rays_per_light_unit = 2, growth_of_passes = 4;

/// The error is known to about a quarter, as from so many independent samples. Pairs have two to
/// four sets of points, and what becomes of the light later is guessed from the mean reflectance.
constexpr double samples_of_error = 9;

class ProgressiveSolver final : public EngineSolver {
  public:
    explicit ProgressiveSolver(const SolverInput& input)
        : input_(input), solution_(solution_before_steps(input)),
          is_one_shot_(is_one_shot(input.options)),
          by_hemicubes_(own_options<FactorOptions>(input.options).kind == FactorKind::hemicube),
          pass_(input) {
        solution_.error_batches = samples_of_error;
        pass_.begin(rays_per_light());
        publish(pass_.estimate());
        solution_.steps = 0;
    }

    bool step() override {
        input_.monitor.phase = "shooting";
        const double wanted =
            input_.options.rays * static_cast<double>(input_.mesh.patches().size());
        const std::uint64_t before = pass_.points();
        bool cut_short = false;
        while (!finished() && !cut_short) {
            if (pass_.is_done()) {
                end_pass();
                continue;
            }
            const double used = static_cast<double>(pass_.points() - before);
            input_.monitor.step_share = std::min(1.0, used / wanted);
            if (used >= wanted)
                break;
            pass_.shoot(solution_.steps + 1);
            cut_short = bool(input_.monitor.interrupted);
            // At the end of the time, the shots of this step count.
            if (cut_short && (input_.monitor.interrupted.is_wished() || pass_.points() == before))
                return false;
            if (is_one_shot_)
                break;
        }
        publish(passes_ > 0 ? mean_ : pass_.estimate());
        return true;
    }

    [[nodiscard]] bool finished() const override {
        const auto is_zero = [](const Vec3& v) { return v == Vec3(0.0); };
        const bool sure = (is_lit(mean_.radiosity) || !solution_.may_find_light) &&
                          std::ranges::all_of(mean_.variance, is_zero) &&
                          std::ranges::all_of(mean_.missing, is_zero);
        return (passes_ > 0 && (is_one_shot_ || sure || by_hemicubes_)) || is_zero(pass_.emitted());
    }
    [[nodiscard]] const Solution& solution() const override { return solution_; }

  private:
    [[nodiscard]] double rays_per_light() const {
        return rays_per_light_unit * input_.options.rays *
               elementary::whole_power(growth_of_passes, passes_);
    }

    /// A pass is weighted by its rays.
    void end_pass() {
        const double rays = rays_per_light();
        weight_ += rays;
        if (passes_++ == 0)
            mean_ = pass_.estimate();
        else
            mean_.join(pass_.estimate(), rays / weight_);
        pass_.begin(rays_per_light());
    }

    [[nodiscard]] bool is_lit(std::span<const Vec3> radiosity) const {
        for (std::uint32_t i = 0; i < radiosity.size(); ++i)
            if (radiosity[i] != input_.mesh.material(i).emission)
                return true;
        return false;
    }

    void publish(const Estimate& estimate) {
        check_finite(input_.mesh, estimate.radiosity, "the radiosity", solution_.steps + 1);
        solution_.radiosity = estimate.radiosity;
        note_errors(estimate);
        solution_.hits.assign(pass_.hits().begin(), pass_.hits().end());
        const double to_world = input_.mesh.frame().area_to_world(1.0);
        solution_.energy = {to_world * pass_.emitted(), to_world * estimate.energy.absorbed,
                            to_world * estimate.energy.escaped, to_world * estimate.energy.unshot};
        solution_.rays_energy = pass_.rays();
        ++solution_.steps;
    }

    /// Notes the errors of the patches. Each patch has an error of its own, except for the part
    /// that is shared. That makes one part of the error (error_spread.h), however many patches
    /// there are.
    void note_errors(const Estimate& estimate) {
        if (by_hemicubes_) {
            constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
            solution_.standard_error.assign(estimate.radiosity.size(), Vec3(unknown));
            return;
        }
        const std::vector<Vec3> pooled = pooled_over_neighbours(input_.mesh, estimate.variance);
        solution_.standard_error.resize(pooled.size());
        std::vector<double> of_patch;
        double missing = 0;
        for (std::uint32_t i = 0; i < estimate.radiosity.size(); ++i) {
            const double area = input_.mesh.patches()[i].area;
            const Vec3& light = estimate.missing[i];
            of_patch.push_back(area * glm::dot(estimate.variance[i], Vec3(1.0)));
            missing += area * glm::dot(light, light);
            solution_.standard_error[i] =
                glm::sqrt(glm::max(pooled[i], estimate.left_to_chance[i]) + light * light);
        }
        const double variance = std::accumulate(of_patch.begin(), of_patch.end(), 0.0);
        solution_.variance = variance;
        solution_.missed = missing;
        solution_.effective_freedom.reset();
        if (variance > 0)
            solution_.effective_freedom = effective_freedom_of(of_patch, estimate.shared);
    }

    SolverInput input_;
    Solution solution_; ///< light after the last step
    bool is_one_shot_;
    bool by_hemicubes_; ///< another pass would see the same
    ProgressivePass pass_;
    // These are of all passes before.
    Estimate mean_;
    double weight_ = 0;
    std::uint32_t passes_ = 0;
};

std::vector<MethodOption> options() {
    MethodOption overshoot =
        flag_option("--overshoot", "also shoot what a patch will probably receive later",
                    &ProgressiveOptions::overshoot);
    overshoot.on_page = false;
    return {factors_option(false), one_shot_option(),
            flag_option("--ambient", "show an estimate of the light that is still unshot",
                        &ProgressiveOptions::ambient),
            overshoot};
}

void adapt(MethodWork& work, const SolveOptions& options) {
    adapt_to_factors(work, options);
    work.ends_by_itself = is_one_shot(options);
}

} // namespace

extern const Method progressive_method{
    .name = "progressive",
    .summary = "the brightest patch shoots by explicit form factors (Cohen et al. 1988; paper 3.1)",
    .unbiased = false,
    .default_stop = {.steps = {}, .seconds = {}, .error = .01},
    .make = make_solver_of<ProgressiveSolver>,
    .work = {.pairs = true},
    .plain =
        [](const SolverInput& input) {
            return plain::progressive(input,
                                      own_options<ProgressiveOptions>(input.options).ambient);
        },
    .options = options,
    .adapt = adapt,
};

} // namespace hemilux
