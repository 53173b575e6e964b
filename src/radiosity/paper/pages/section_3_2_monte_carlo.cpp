// Monte Carlo radiosity (paper section 3.2; Shirley 1991, "Radiosity via ray tracing", Graphics
// Gems II).
//
// The patch with the largest unshot energy shoots first, all of it at once. Its rays start at
// random points of the patch, in directions that follow the cosine law, each with the same power.
// No form factor is computed: a patch receives what the rays that hit it bring.

#include "radiosity/paper/pages/pages.h"
#include "radiosity/paper/pages/step.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace hemilux::plain {
namespace {

/// The number of rays of a shot that share a stream of random numbers.
constexpr std::uint64_t rays_per_stream = 512;

class MonteCarlo final : public StepSolver {
  public:
    explicit MonteCarlo(const SolverInput& input) : StepSolver(input, true) {}

  private:
    bool compute_radiosity(std::uint64_t step, double Phi_mean, Step& result) override {
        std::vector<CompensatedSum<Vec3>> unshot(result.unshot.size());
        std::vector<double> energy; // A_i B_i that is unshot, mean of channels
        for (std::size_t i = 0; i < unshot.size(); ++i) {
            unshot[i] += result.unshot[i];
            energy.push_back(mean_of_channels(result.unshot[i]));
        }
        for (std::uint64_t shot = 0;; ++shot) {
            const auto shooter = static_cast<std::uint32_t>(
                std::max_element(energy.begin(), energy.end()) - energy.begin());
            if (!(energy[shooter] > 0))
                break;
            if (input_.monitor.interrupted)
                return false;
            const Vec3 Phi = std::exchange(unshot[shooter], {}).value();
            result.shot += std::exchange(energy[shooter], 0.0);
            // Fractions of a ray are rounded by chance: this is right on average, and the series
            // ends.
            const std::uint64_t stream = hash_words({input_.options.seed, step, shot});
            const double due = mean_of_channels(Phi) / Phi_mean;
            const double rays = std::floor(due + Rng(stream).uniform());
            const Vec3 Phi_ray = Phi / (due >= 1 ? rays : due);
            const auto start = PatchStart::in_any_axes(input_.mesh, shooter);
            Rng random(0);
            for (std::uint64_t k = 0; k < static_cast<std::uint64_t>(rays); ++k) {
                if (k % rays_per_stream == 0)
                    random = Rng(hash_words({stream, k / rays_per_stream}));
                const std::uint32_t i = result.shoot(start.cosine_ray(random), Phi_ray);
                if (i == none)
                    continue;
                unshot[i] += input_.mesh.material(i).reflectance * Phi_ray;
                energy[i] = mean_of_channels(unshot[i].value());
            }
        }
        result.reflect();
        return true;
    }
};

} // namespace

std::unique_ptr<Solver> monte_carlo(const SolverInput& input) {
    return std::make_unique<MonteCarlo>(input);
}

} // namespace hemilux::plain
