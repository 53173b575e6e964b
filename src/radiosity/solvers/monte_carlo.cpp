// Monte Carlo radiosity (paper section 3.2; Shirley 1991, "Radiosity via ray tracing", Graphics
// Gems II).
//
// The patch with the largest unshot energy A_i B_i shoots first, all of it at once, by rays from
// random points in cosine-distributed directions. Each ray carries about the same power, the same
// throughout the run, so a patch shoots rays in proportion to what it has gathered. No form factor
// is computed: a patch receives what the rays that strike it bring. Fractions of a ray are settled
// by chance, which keeps the estimate unbiased and ends the step by itself: a patch with a third of
// a ray shoots a whole one in a third of all cases.
//
// Each step is such a solution from emission on; the result is their mean (stepwise.h).
//
// Parameter: --rays, the mean number of rays per patch and step.
// Good as a yardstick: nothing but rays. Bad where small patches matter, whose error is that of
// counting few hits, and with many threads: a shot depends on the one before, so only the rays of
// one patch are traced at once. Costs one ray after the other and no memory to speak of.

#include "geometry/frame.h"
#include "radiosity/plain/plain.h"
#include "radiosity/rays/shot.h"
#include "radiosity/sampling/largest_first.h"
#include "radiosity/sampling/workers.h"
#include "radiosity/shooting/stepwise.h"
#include "radiosity/solving/solve_error.h"

#include <cmath>
#include <utility>

namespace hemilux {
namespace {

/// Rays with a random stream of their own, which one thread traces.
constexpr std::size_t rays_per_stream = 512;
/// Rays whose receivers are kept until they are summed; whole streams. A lamp may shoot millions.
constexpr std::size_t rays_per_volley = 2048 * rays_per_stream;
/// Fewer than this are traced sooner than other threads would be started.
constexpr std::size_t rays_for_one_thread = 2048;

class MonteCarloSolver final : public StepwiseSolver {
  public:
    explicit MonteCarloSolver(const SolverInput& input) : StepwiseSolver(input, true) {}

  private:
    [[nodiscard]] bool steps_are_alike() const override { return true; }
    bool solve_once(const StepTask& task, StepResult& result) override {
        const auto patches = static_cast<std::uint32_t>(input_.mesh.patches().size());
        std::vector<CompensatedSum<Vec3>> unshot(patches), received(patches);
        std::vector<std::uint32_t> receivers; // of some of a shot's rays, ray by ray
        LargestFirst order(patches);
        for (std::uint32_t i = 0; i < patches; ++i) {
            unshot[i] += result.radiosity[i] * input_.mesh.patches()[i].area;
            order.set(i, mean_of_channels(unshot[i].value()));
        }
        for (std::uint64_t shots = 0; order.largest() > 0; ++shots) {
            if (input_.monitor.interrupted)
                return false;
            const auto shooter = static_cast<std::uint32_t>(order.index_of_largest());
            const Vec3 power = std::exchange(unshot[shooter], {}).value();
            order.set(shooter, 0);
            check_finite(input_.mesh, shooter, power, "the power to be shot", task.number);
            check_bounces(input_.mesh, shots / patches, task.number);
            result.shot += mean_of_channels(power);
            const Shot shot = whole_rays(shooter, power, task.rays(shooter, power),
                                         hash_words({input_.options.seed, task.stream, shots}));
            for (std::size_t first = 0; first < shot.rays; first += rays_per_volley) {
                shoot(shot, first, task.workers, receivers);
                if (input_.monitor.interrupted)
                    return false;
                for (const std::uint32_t i : receivers)
                    if (i < patches) {
                        received[i] += shot.each;
                        unshot[i] += input_.mesh.material(i).reflectance * shot.each;
                        order.set(i, mean_of_channels(unshot[i].value()));
                        ++result.hits[i];
                    } else {
                        (i == escaped ? result.escaped : result.absorbed) += shot.each;
                    }
                count(receivers.size(), result);
            }
            result.sent += double(shot.rays) * shot.each;
        }
        reflect(received, result);
        return true;
    }

    struct Shot {
        std::uint32_t shooter;
        std::size_t rays;
        Vec3 each; ///< power of a ray
        std::uint64_t stream;
    };

    [[nodiscard]] static Shot whole_rays(std::uint32_t shooter, const Vec3& power, double expected,
                                         std::uint64_t stream) {
        const double n = std::floor(expected + Rng(stream).uniform());
        // Below one ray, the ray that is shot carries the power of those that are not.
        return {shooter, static_cast<std::size_t>(n), power / (expected >= 1 ? n : expected),
                stream};
    }

    /// Some of the shot's rays, from `first` on.
    void shoot(const Shot& shot, std::size_t first, const Workers& all,
               std::vector<std::uint32_t>& receivers) const {
        const std::size_t rays = std::min(shot.rays - first, rays_per_volley);
        receivers.resize(rays);
        const Workers workers = rays < rays_for_one_thread ? Workers(1) : all;
        workers.for_chunks(rays, rays_per_stream, [&](std::size_t begin, std::size_t end) {
            if (input_.monitor.interrupted)
                return;
            Rng rng(hash_words({shot.stream, (first + begin) / rays_per_stream}));
            const Patch& from = input_.mesh.patches()[shot.shooter];
            const PolygonSampler origins(from.shape);
            const Frame frame = Frame::from_normal(from.normal);
            std::vector<Ray> drawn;
            std::vector<std::uint32_t> hits;
            for (std::size_t k = begin; k < end; ++k)
                drawn.push_back(cosine_ray(from, origins, frame, rng));
            find_receivers(drawn, input_.mesh, input_.tracer, hits);
            std::ranges::copy(hits, receivers.begin() + static_cast<std::ptrdiff_t>(begin));
        });
    }

    /// Radiosity from all power that each patch received.
    void reflect(const std::vector<CompensatedSum<Vec3>>& received, StepResult& result) const {
        for (std::uint32_t i = 0; i < received.size(); ++i) {
            const Vec3& reflectance = input_.mesh.material(i).reflectance;
            const Vec3 power = received[i].value();
            const double area = input_.mesh.patches()[i].area;
            result.absorbed += (1.0 - reflectance) * power;
            if (area > 0)
                result.radiosity[i] += reflectance * power / area;
        }
    }

    void count(std::size_t rays, StepResult& result) const {
        result.rays += rays;
        input_.monitor.rays += rays;
        input_.monitor.step_share = std::min(
            1.0, static_cast<double>(result.rays) /
                     (input_.options.rays * static_cast<double>(input_.mesh.patches().size())));
    }
};

std::unique_ptr<Solver> make_monte_carlo(const SolverInput& input) {
    return std::make_unique<MonteCarloSolver>(input);
}

} // namespace

extern const Method monte_carlo_method;
const Method monte_carlo_method{
    .name = "monte-carlo",
    .summary = "the brightest patch shoots all it holds by random rays (Shirley 1991; paper 3.2)",
    .has_literal = false,
    .unbiased = true,
    .default_stop = {.steps = 16, .seconds = {}, .error = {}},
    .make = make_monte_carlo,
    .strategy = nullptr,
    .work = {.passes = true},
    .saves = true,
    .plain = plain::monte_carlo,
    .aims = true,
};

} // namespace hemilux
