// Monte Carlo progressive radiosity (paper section 3.3; Feda and Purgathofer 1993).
//
// Every step shoots a few further rays from each patch, towards directions that follow the cosine
// law. "If the total number of rays is k times greater, what was received before is divided by k"
// is the mean of equal steps (step_mean.h). N_hemi is a mean: patches shoot in proportion to their
// power, so that every ray carries about the same (docs/decisions.md, D10).

#include "geometry/polygon_sampler.h"
#include "radiosity/plain/plain.h"
#include "radiosity/plain/ray_numbers.h"
#include "radiosity/plain/step_mean.h"
#include "radiosity/rays/shot.h"
#include "radiosity/sampling/rng.h"
#include "radiosity/scene/mesh.h"

#include <cmath>

namespace hemilux::plain {
namespace {

class ProgressiveMonteCarlo final : public StepMean {
  public:
    explicit ProgressiveMonteCarlo(const SolverInput& input) : StepMean(input, true) {}

  private:
    /// Bounce after bounce, until nothing is left or chance has ended it.
    bool compute_radiosity(std::uint64_t step, double Phi_mean, Step& result) override {
        const auto patches = static_cast<std::uint32_t>(input_.mesh.patches().size());
        for (std::uint64_t bounce = 0; result.power_unshot() > 0; ++bounce) {
            result.shot += result.power_unshot();
            const std::uint64_t stream = hash_words({input_.options.seed, step, bounce});
            // Patches own intervals of a line, as long as the rays that they are due. A ray stands
            // at each whole number, so each number of rays is rounded up or down, right on average.
            double line = Rng(stream).uniform();
            for (std::uint32_t i = 0; i < patches; ++i) {
                if (input_.monitor.interrupted)
                    return false;
                const double begin = line;
                line += mean_of_channels(result.unshot[i]) / Phi_mean;
                shoot(i, hash_words({stream, i}), line - begin,
                      std::floor(line) - std::floor(begin), result);
            }
            result.reflect();
        }
        return true;
    }

    /// Below one ray, the ray that is shot carries the power of those that are not.
    void shoot(std::uint32_t patch, std::uint64_t key, double due, double rays, Step& result) {
        const Patch& its = input_.mesh.patches()[patch];
        const Frame frame = input_.mesh.hemisphere_frame(patch);
        const PolygonSampler points(its.shape);
        const Vec3 Phi_ray = 1 / (due >= 1 ? rays : due) * result.unshot[patch];
        for (std::uint64_t k = 0; k < static_cast<std::uint64_t>(rays); ++k) {
            RayNumbers random(key, static_cast<std::uint32_t>(k));
            const double u = random.next(), v = random.next();
            Ray ray{points.sample(random.start()), frame.to_world(cosine_direction({u, v}))};
            ray.from = its.facet;
            result.receive(input_.tracer.closest(ray), Phi_ray);
        }
    }
};

} // namespace

std::unique_ptr<Solver> progressive_monte_carlo(const SolverInput& input) {
    return std::make_unique<ProgressiveMonteCarlo>(input);
}

} // namespace hemilux::plain
