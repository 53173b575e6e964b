// The full matrix (paper section 2; Goral et al. 1984): the reference for all other methods.
//
// Form factors between all pairs of patches are found by well-distributed rays
// (sampled_form_factors.h), and the system B = E + rho F B is solved to a residual of 1e-12.
// Several independent batches of the factors give several solutions; their mean is the result, and
// their spread gives its standard error. Each step doubles the rays; the run ends when the
// estimated error is small enough (.002 unless asked otherwise). With --factors exact, factors
// between patches that see each other fully are found without chance, by integrals, and those of
// other pairs by lines between both (closed_form_factors.h); each step halves the errors that these
// may have. With --factors hemicube, a hemicube over each patch gives its factors (hemicube.h).
// That is one step, and its error is not estimated (linear/hemicube_matrix.h).
//
// The method is consistent: a solution depends on its factors in a non-linear way, so its bias
// falls as one over the rays, well below its error. It is good up to some ten thousand patches:
// memory is 8 bytes per batch and per pair of patches that see each other. Time and memory of exact
// factors grow as the square of the patches.

#include "radiosity/engine/form_factors/closed_form_factors.h"
#include "radiosity/engine/form_factors/factor_options.h"
#include "radiosity/engine/form_factors/sampled_form_factors.h"
#include "radiosity/engine/linear/batch_solutions.h"
#include "radiosity/engine/linear/emitter_losses.h"
#include "radiosity/engine/linear/gmres.h"
#include "radiosity/engine/linear/hemicube_matrix.h"
#include "radiosity/engine/linear/surfaces.h"
#include "radiosity/engine/linear/unsolved_light.h"
#include "radiosity/engine/solving/engine_solver.h"
#include "radiosity/engine/solving/method.h"
#include "radiosity/engine/solving/method_option.h"
#include "radiosity/engine/solving/own_options.h"
#include "radiosity/paper/pages/pages.h"
#include "radiosity/paper/rays/shot.h"
#include "radiosity/paper/sampling/rng.h"
#include "radiosity/paper/scene/mesh.h"
#include "radiosity/paper/solution/missed_light.h"
#include "radiosity/paper/solving/check_input.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace hemilux {
namespace {

/// The bytes per form factor at the peak: column, value, and the counts that they come from, with
/// room to grow.
constexpr double bytes_per_factor = 32;
/// The same for exact factors, of which only one batch is there at a time.
constexpr double bytes_per_exact_factor = 48;

constexpr std::size_t batches = 8;
/// The standard error of exact factors that may be hidden in part, times the rays: so both sorts of
/// errors fall from step to step, and the first is about what is asked for by default.
constexpr double error_by_rays = .25;
/// What the quadrature of exact factors may move the light by at most [-].
constexpr double error_of_exact = 1e-9;
/// The rays per patch and batch at which the run ends whatever the error.
constexpr std::uint32_t max_rays = 1u << 20;

/// Returns the patches whose columns get the closed form: all that emit, unless they are so many
/// that rays find them anyway.
std::vector<std::uint32_t> few_emitters(const Mesh& mesh) {
    std::vector<std::uint32_t> emitters;
    for (std::uint32_t i = 0; i < mesh.patches().size(); ++i) {
        const Vec3& emission = mesh.material(i).emission;
        if (emission.x + emission.y + emission.z > 0)
            emitters.push_back(i);
    }
    if (emitters.size() > std::max<std::size_t>(16, mesh.patches().size() / 16))
        emitters.clear();
    return emitters;
}

class MatrixSolver final : public EngineSolver {
  public:
    explicit MatrixSolver(const SolverInput& input)
        : input_(input), solution_(solution_before_steps(input)), workers_(input.options.threads),
          batches_(input, batches, solution_), surfaces_(input.mesh) {
        const std::vector<std::uint32_t> emitters = few_emitters(input.mesh);
        if (own_options<FactorOptions>(input.options).kind == FactorKind::exact)
            exact_.emplace(input.mesh, input.tracer, workers_, input.monitor);
        rays_find_emission_ = exact_ || emitters.empty();
        for (std::uint64_t r = 0; r < batches && !exact_; ++r)
            factors_.emplace_back(input.mesh, input.tracer, emitters, seed_of(r), input.needs);
        solution_.error_batches = batches;
    }

    bool step() override {
        SearchForWayOut search(input_);
        std::optional<bool> done;
        while (!(done = try_step(search)))
            search.go_on(traced_, !finished());
        return *done;
    }

    /// Returns whether it was not interrupted; nothing if the rays have seen no way out for the
    /// light.
    [[nodiscard]] std::optional<bool> try_step(const SearchForWayOut& search) {
        const std::uint32_t rays = rays_ == 0 ? first_rays() : 2 * rays_;
        for (std::size_t r = 0; r < factors_.size(); ++r) {
            input_.monitor.phase = "rays";
            traced_ += factors_[r].trace_up_to(rays, workers_, input_.monitor);
            input_.monitor.step_share = static_cast<double>(r + 1) / batches;
            if (input_.monitor.interrupted)
                return false;
        }
        rays_of_step_ = rays;
        std::vector<std::vector<EmitterLoss>> losses(batches);
        if (!exact_) // whose rows show what is lost
            losses = emitter_losses(factors_, rays);
        const FactorTolerance tolerance = tolerance_of_light();
        const std::optional<bool> solved =
            batches_.solve(search, solution_, [&](std::size_t r, std::vector<Vec3>& radiosity) {
                return exact_ ? solve_exact(r, tolerance, radiosity)
                              : solve(factors_[r], losses[r], radiosity);
            });
        if (solved == false)
            return false;
        rays_ = rays;
        if (solved) {
            combine();
            ++solution_.steps;
        }
        return solved;
    }

    [[nodiscard]] bool finished() const override {
        return rays_ >= max_rays || (rays_ > 0 && !input_.needs.bounces);
    }
    [[nodiscard]] const Solution& solution() const override { return solution_; }

  private:
    /// Returns a power of two, for which the points are best distributed.
    [[nodiscard]] std::uint32_t first_rays() const {
        const double least = exact_ ? ClosedFormFactors::min_rays : 1.0;
        const double asked = std::clamp(input_.options.rays, least, double(max_rays));
        return std::bit_ceil(static_cast<std::uint32_t>(std::ceil(asked)));
    }

    /// Solves one batch, from its last solution on. The lost shares are those of the rows as they
    /// are, of one kind or the other as rays tell; for emitters, they are what is known best.
    SolvedBatch solve(const SampledFormFactors& factors, std::span<const EmitterLoss> losses,
                      std::vector<Vec3>& radiosity) {
        const SparseMatrix f = factors.matrix();
        const std::size_t n = radiosity.size();
        std::vector<double> rays(n, rays_of_step_);
        std::vector<EscapeFraction> lost(n);
        const std::vector<double> ones(n, 1.0);
        std::vector<double> kept(n);
        f.multiply(ones, kept, workers_);
        for (std::uint32_t i = 0; i < n; ++i) {
            const double share = std::clamp(1 - kept[i], 0.0, 1.0);
            const EscapeFraction& kinds = factors.lost()[i];
            const double scale = kinds.sum() > 0 ? share / kinds.sum() : 0;
            lost[i] = {scale * kinds.escaped, scale * kinds.absorbed};
        }
        for (std::size_t e = 0; e < losses.size(); ++e) {
            lost[factors.emitters()[e]] = losses[e].lost;
            rays[factors.emitters()[e]] = losses[e].rays;
        }
        return solve_closed([&](auto x, auto y) { f.multiply(x, y, workers_); },
                            {surfaces_.area, surfaces_.emission, surfaces_.reflectance, lost, rays},
                            input_, radiosity);
    }

    /// Solves one batch with exact factors where there are any, from its last solution on.
    SolvedBatch solve_exact(std::size_t r, const FactorTolerance& tolerance,
                            std::vector<Vec3>& radiosity) {
        const std::optional<ClosedFactors> factors =
            exact_->batch(seed_of(r), rays_of_step_, tolerance, workers_, input_.monitor);
        if (!factors)
            return {};
        traced_ += factors->rays;
        input_.monitor.step_share = static_cast<double>(r + 1) / batches;
        const std::vector<double> rays(radiosity.size(), rays_of_step_);
        SolvedBatch batch = solve_closed(
            [&](auto x, auto y) { factors->matrix.multiply(x, y, workers_); },
            {surfaces_.area, surfaces_.emission, surfaces_.reflectance, factors->lost, rays},
            input_, radiosity);
        batch.unsolved = std::max(batch.unsolved, error_of_exact);
        if (factors->unclosed > 0) {
            double most = 0;
            for (const Vec3& rho : surfaces_.reflectance)
                most = std::max({most, rho.x, rho.y, rho.z});
            batch.unsolved = std::max(batch.unsolved, unsolved_error(factors->unclosed, 1 - most));
        }
        return batch;
    }

    /// Returns the standard error that factors between patches may have in a batch: less the
    /// brighter one of them is, compared with the light that would arrive if nothing hid the
    /// emitters, as a mean over this light. No patch counts as darker than half of that.
    [[nodiscard]] FactorTolerance tolerance_of_light() const {
        const double of_mean = error_by_rays / rays_of_step_;
        std::vector<double> light(solution_.radiosity.size());
        for (std::size_t i = 0; i < light.size() && exact_; ++i)
            light[i] = mean_of_channels(surfaces_.emission[i]);
        double power = 0, squares = 0;
        if (exact_) {
            const std::vector<double> arriving = exact_->free_light(light);
            for (std::size_t i = 0; i < light.size(); ++i) {
                power += surfaces_.area[i] * arriving[i];
                squares += surfaces_.area[i] * arriving[i] * arriving[i];
            }
        }
        if (!(power > 0))
            return {of_mean, [of_mean](std::uint32_t, std::uint32_t, double) { return of_mean; }};
        const double mean = squares / power;
        double most = mean;
        for (std::size_t i = 0; i < light.size(); ++i) {
            light[i] = std::max(mean_of_channels(solution_.radiosity[i]), .5 * mean);
            most = std::max(most, light[i]);
        }
        return {of_mean * mean / most, [light = std::move(light), whole = of_mean * mean](
                                           std::uint32_t i, std::uint32_t j, double) {
                    return whole / std::max(light[i], light[j]);
                }};
    }

    [[nodiscard]] std::uint64_t seed_of(std::uint64_t batch) const {
        return hash_words({input_.options.seed, batch});
    }

    /// Returns whether rays may have missed something. Integrals miss nothing, and in a closed
    /// scene no light is lost.
    [[nodiscard]] bool may_miss() const {
        return !input_.needs.closed && !(exact_ && exact_->other_pairs() == 0);
    }

    void combine() {
        const std::vector<Vec3> variance = batches_.combine(solution_);
        solution_.hits.assign(variance.size(), std::uint64_t{rays_} * batches);
        solution_.rays_energy = traced_;
        const std::vector<Vec3> missed = missed_light();
        const double share = missed_loss();
        solution_.missed = 0;
        for (std::uint32_t i = 0; i < missed.size(); ++i) {
            const Vec3 level = share * (solution_.radiosity[i] - surfaces_.emission[i]);
            solution_.missed += surfaces_.area[i] * glm::dot(level, level);
            solution_.standard_error[i] =
                glm::sqrt(variance[i] + level * level + missed[i] * missed[i]);
        }
        batches_.add_unsolved_to(solution_);
    }

    /// Returns the share of all light that three rays stand for which were not lost and might have
    /// been. What is emitted is all that is used, and one ray carries its part of what leaves all
    /// patches.
    [[nodiscard]] double missed_loss() const {
        if (!may_miss())
            return 0;
        double leaving = 0, emitted = 0, rays = 0;
        for (std::uint32_t i = 0; i < solution_.radiosity.size(); ++i) {
            if (solution_.radiosity[i] == Vec3(0.0))
                continue;
            leaving += surfaces_.area[i] * mean_of_channels(solution_.radiosity[i]);
            emitted += surfaces_.area[i] * mean_of_channels(surfaces_.emission[i]);
            rays += double(rays_) * double(batches);
        }
        return emitted > 0 ? rule_of_three * leaving / (rays * emitted) : 0;
    }

    /// Returns what dark patches may receive besides. Emission with a closed form does not wait for
    /// a ray to find it.
    [[nodiscard]] std::vector<Vec3> missed_light() const {
        const std::size_t n = solution_.radiosity.size();
        if (!may_miss())
            return std::vector<Vec3>(n, Vec3(0.0));
        const std::vector<double> rays(n, double(rays_) * batches);
        std::vector<Vec3> incident(n);
        for (std::size_t i = 0; i < n; ++i) // of the same order: what is reflected of it
            incident[i] = solution_.radiosity[i] - surfaces_.emission[i];
        const std::vector<Vec3>& leaving = rays_find_emission_ ? solution_.radiosity : incident;
        return missed_by_rays({surfaces_.area, surfaces_.reflectance, incident, leaving, rays});
    }

    SolverInput input_;
    Solution solution_;
    Workers workers_;
    BatchSolutions batches_;
    Surfaces surfaces_;
    std::vector<SampledFormFactors> factors_;
    std::optional<ClosedFormFactors> exact_;
    bool rays_find_emission_ = true; ///< no column has the closed form
    std::uint32_t rays_ = 0;         ///< rays per patch and batch
    std::uint32_t rays_of_step_ = 0; ///< those of the step under way
    std::uint64_t traced_ = 0;
};

std::unique_ptr<EngineSolver> make_matrix(const SolverInput& input) {
    if (own_options<FactorOptions>(input.options).kind == FactorKind::hemicube)
        return make_hemicube_matrix(input);
    return std::make_unique<MatrixSolver>(input);
}

std::vector<MethodOption> options() { return {exact_option(), factors_option(true)}; }

/// Returns the bytes of the vectors that solvers keep (gmres.h), of all channels of the batches
/// that are solved at once.
double bytes_of_solvers(const SolveOptions& options, double patches) {
    constexpr double channels = 3;
    const double at_once = std::min<double>(Workers(options.threads).threads(), batches);
    return channels * at_once * sizeof(double) * patches *
           std::min(double(GmresOptions{}.max_restart), patches);
}

double bytes(const SolveOptions& options, double patches) {
    const auto& factors = own_options<FactorOptions>(options);
    if (factors.kind == FactorKind::hemicube)
        return bytes_per_factor * patches *
               std::min(patches, 3.0 * factors.hemicube_edge * factors.hemicube_edge);
    if (factors.kind == FactorKind::exact)
        return bytes_per_exact_factor * patches * patches + bytes_of_solvers(options, patches);
    return double(batches) * bytes_per_factor * patches * std::min(patches, options.rays) +
           bytes_of_solvers(options, patches);
}

} // namespace

extern const Method matrix_method{
    .name = "matrix",
    .summary = "all form factors and a linear solver (Goral et al. 1984); the reference",
    .unbiased = false,
    .default_stop = {.steps = {}, .seconds = {}, .error = .002},
    .make = make_matrix,
    .work = {.pairs = true, .linear_systems = true, .passes = true},
    .plain = plain::matrix,
    .max_plain_patches = plain::max_patches_of_matrix,
    .role = Role::reference,
    .options = options,
    .adapt = adapt_to_factors,
    .bytes = bytes,
};

} // namespace hemilux
