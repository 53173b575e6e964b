// Monte Carlo progressive radiosity (paper section 3.3; Feda and Purgathofer 1993).
//
// Every step shoots a few further rays from each patch, towards directions that follow the cosine
// law. "If the total number of rays is k times greater, what was received before is divided by k"
// is the mean of equal steps (mean_of_steps.h). N_hemi is a mean: patches shoot in proportion to
// their power, so that every ray carries about the same (docs/paper/decisions.md, D10).

#include "radiosity/paper/pages/pages.h"
#include "radiosity/paper/pages/step.h"

namespace hemilux::plain {

void shoot_plainly(const Due& due, const Rays& rays, Step& result) {
    const PatchStart start(result.input.mesh, due.patch);
    const Vec3 Phi_ray = 1 / rays.divisor * result.unshot[due.patch];
    for (std::uint64_t k = 0; k < rays.number; ++k) {
        RayNumbers random(due.key, static_cast<std::uint32_t>(k));
        const double u = random.next(), v = random.next();
        result.shoot(start.ray(random.start(), cosine_direction({u, v})), Phi_ray);
    }
}

namespace {

class ProgressiveMonteCarlo final : public StepSolver {
  public:
    explicit ProgressiveMonteCarlo(const SolverInput& input) : StepSolver(input, true) {}

  private:
    /// Shoots bounce after bounce, until nothing is left or chance has ended it.
    bool compute_radiosity(std::uint64_t step, double Phi_mean, Step& result) override {
        for (std::uint64_t bounce = 0; result.power_unshot() > 0; ++bounce) {
            const std::uint64_t stream = hash_words({input_.options.seed, step, bounce});
            for (const Due& due : result.due(stream, Phi_mean)) {
                if (input_.monitor.interrupted)
                    return false;
                shoot_plainly(due, rays_on_line(due), result);
            }
            result.reflect();
        }
        return true;
    }
};

} // namespace

std::unique_ptr<Solver> progressive_monte_carlo(const SolverInput& input) {
    return std::make_unique<ProgressiveMonteCarlo>(input);
}

} // namespace hemilux::plain
