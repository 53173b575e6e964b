// Gathering on stored transport.
//
// Each patch looks around along well-distributed rays and keeps which patches they struck, not what
// light they brought (ray_counts.h). What two patches saw of each other is put together, all rows
// are closed (exchange_matrix.h), and all bounces are solved on the result by conjugate gradients
// (conjugate_gradients.h): no ray is traced twice for another bounce. Small lamps are reached by
// shadow rays with their exact factor (direct_light.h).
//
// Parameter: --rays, in the first step, half of them random, half to the lamps. Each step doubles
// one of the two kinds, that which the larger part of the error comes from, or both. Four
// independent sets of both give four solutions, whose spread is the standard error; the result is
// the solution of all rays together.
//
// Consistent: the solution depends on what was counted in a non-linear way, so its bias falls as
// one over the rays, and its error more slowly. Good nearly everywhere: it needs ten to fifty times
// fewer rays than shooting, most where light is even and surfaces reflect much. Costs 8 bytes per
// patch and patch that it saw, and as many to solve.

#include "radiosity/check_input.h"
#include "radiosity/conjugate_gradients.h"
#include "radiosity/direct_light.h"
#include "radiosity/energy_closing.h"
#include "radiosity/exchange_matrix.h"
#include "radiosity/mesh.h"
#include "radiosity/ray_counts.h"
#include "radiosity/ray_deal.h"
#include "radiosity/rng.h"
#include "radiosity/shot.h"
#include "radiosity/solve_error.h"
#include "radiosity/solver.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace hemilux {
namespace {

constexpr std::size_t sets = 4;

/// Rays per patch and set at which the run ends whatever the error.
constexpr double most_rays = 1u << 20;

/// A kind of ray whose error costs less than this share of the other's is not doubled. Errors of
/// well-distributed points fall about as rays^-3/4: doubling one kind takes two thirds of its
/// variance.
constexpr double worth_doubling = .35;

/// The share of the emitted power within which it must be known how much is lost, for the rest to
/// be taken for what arrives.
constexpr double surely_lost = 1e-3; // as in energy_closing.cpp

/// Bytes that are needed to put counts together, for each byte of them.
constexpr double merging = 5;

/// The share of the weights that is measured; and what a patch's area counts, see weigh().
constexpr double trust = .5, area_exponent = .42;

/// Black emitters count as if they reflected this: their rays tell where their light goes.
constexpr double least_reflectance = .1;

class GatheringSolver final : public Solver {
  public:
    explicit GatheringSolver(const SolverInput& input)
        : input_(input), workers_(input.options.threads), emitters_(small_emitters(input.mesh)) {
        check_input(input);
        const auto patches = input.mesh.patches();
        renew();
        finished_.assign(sets + 1, std::vector<Vec3>(patches.size(), Vec3(0.0)));
        std::vector<bool> small(patches.size());
        for (const std::uint32_t e : emitters_)
            small[e] = true;
        for (std::uint32_t i = 0; i < patches.size(); ++i) {
            const Material& material = input.mesh.material(i);
            area_.push_back(patches[i].area);
            reflectance_.push_back(material.reflectance);
            emission_.push_back(material.emission);
            seen_emission_.push_back(small[i] ? Vec3(0.0) : material.emission);
        }
        solution_.energy.emitted =
            input.mesh.frame().area_to_world(1.0) * emitted_power(input.mesh);
        solution_.energy.unshot = solution_.energy.emitted;
        rays_.resize(patches.size());
        samples_.resize(patches.size());
        for (std::uint32_t i = 0; i < patches.size(); ++i) {
            const double area = input.needs.power(i) ? std::pow(area_[i], area_exponent) : 0;
            direct_weights_.push_back(area * glm::length(reflectance_[i]));
            weights_.push_back(area * std::max(glm::length(reflectance_[i]), least_reflectance));
        }
        prior_weights_ = weights_;
        incident_.assign(sets + 1, std::vector<Vec3>(patches.size(), Vec3(0.0)));
        solution_.radiosity = emission_;
        solution_.standard_error.resize(patches.size());
        solution_.hits.resize(patches.size());
    }

    bool step() override {
        const double mean_rays = mean_rays_, mean_samples = mean_samples_;
        choose_rays();
        std::vector<std::uint32_t> rays = deal_rays(weights_, mean_rays_, rays_);
        std::vector<std::uint32_t> samples = deal_rays(direct_weights_, mean_samples_, samples_);
        if (!fits(rays)) {
            rays = rays_;
            samples = samples_;
            mean_rays_ = mean_rays;
            mean_samples_ = mean_samples;
            begin_generation();
        }
        for (std::size_t s = 0; s < sets; ++s) {
            input_.monitor.phase = "rays";
            traced_ += counts_[s].trace_up_to(rays, workers_, input_.monitor);
            traced_ += direct_[s].sample_up_to(samples, workers_, input_.monitor);
            input_.monitor.step_share = static_cast<double>(s + 1) / (sets + 1);
            if (input_.monitor.interrupted)
                return false;
        }
        rays_ = rays;
        samples_ = samples;
        input_.monitor.phase = "solving";
        bool drained = true;
        for (std::size_t s = 0; s < sets; ++s) {
            solve(std::span(&counts_[s], 1), std::span(&direct_[s], 1), incident_[s], 1e-6);
            drained = drained && is_drained(energy_);
        }
        const ExchangeMatrix all = solve(counts_, direct_, incident_[sets], 1e-10);
        if (!drained || !is_drained(energy_)) {
            require_more_rays(!finished());
            return step();
        }
        for (const std::vector<Vec3>& incident : incident_)
            check_finite(input_.mesh, incident, "the light that reaches", solution_.steps + 1);
        combine(all);
        return true;
    }

    [[nodiscard]] bool finished() const override {
        return std::max(mean_rays_, mean_samples_) >= most_rays;
    }
    [[nodiscard]] const Solution& solution() const override { return solution_; }

  private:
    /// New rays, independent of all before.
    void renew() {
        counts_.clear();
        direct_.clear();
        for (std::uint64_t s = 0; s < sets; ++s) {
            const std::uint64_t seed = hash_words({input_.options.seed, s, generation_});
            counts_.emplace_back(input_.mesh, input_.tracer, hash_words({seed, 0}));
            direct_.emplace_back(input_.mesh, input_.tracer, input_.needs, emitters_,
                                 hash_words({seed, 1}));
        }
    }

    /// What is known is kept as a solution, and its rays are forgotten.
    void begin_generation() {
        for (std::size_t s = 0; s <= sets; ++s)
            for (std::size_t i = 0; i < area_.size(); ++i)
                finished_[s][i] += incident_[s][i];
        finished_energy_.absorbed += energy_.absorbed;
        finished_energy_.escaped += energy_.escaped;
        ++generation_;
        renew();
    }

    /// Whether so many rays may be stored.
    [[nodiscard]] bool fits(const std::vector<std::uint32_t>& rays) const {
        const auto sum = [](const std::vector<std::uint32_t>& of) {
            return std::accumulate(of.begin(), of.end(), 0.0);
        };
        if (input_.options.memory == 0 || sum(rays_) == 0)
            return true;
        std::uint64_t stored = 0;
        for (const RayCounts& set : counts_)
            stored += set.bytes();
        const double growth = sum(rays) / sum(rays_);
        return merging * growth * static_cast<double>(stored) <=
               static_cast<double>(input_.options.memory);
    }

    /// Mean over the generations; `set` == sets: of all sets together.
    [[nodiscard]] Vec3 incident(std::size_t set, std::size_t patch) const {
        return (finished_[set][patch] + incident_[set][patch]) / double(generation_ + 1);
    }

    /// How many rays of both kinds the mean patch and set is to have after this step.
    void choose_rays() {
        if (mean_rays_ == 0) {
            const double each = input_.options.rays / (sets * (emitters_.empty() ? 1 : 2));
            mean_rays_ = std::clamp(each, 1.0, most_rays);
            mean_samples_ = emitters_.empty() ? 0 : mean_rays_;
            return;
        }
        // What the next ray of either kind takes from the variance.
        const double of_rays = (variance_ - direct_variance_) / mean_rays_;
        const double of_samples = mean_samples_ > 0 ? direct_variance_ / mean_samples_ : 0;
        const bool more_rays = !(of_rays < worth_doubling * of_samples);
        if (!(of_samples < worth_doubling * of_rays) && mean_samples_ > 0)
            mean_samples_ *= 2;
        if (more_rays)
            mean_rays_ *= 2;
    }

    /// A ray is worth most where it takes most from the error. A patch counts by its area and its
    /// reflectance, and the variance of random rays is the spread of the light that comes from all
    /// sides, as far as it is known; half of the weight does not trust that.
    void weigh(const ExchangeMatrix& all) {
        const std::size_t n = area_.size();
        std::vector<Vec3> light(n), squares(n), mean(n), mean_of_squares(n);
        for (std::size_t i = 0; i < n; ++i) {
            light[i] = solution_.radiosity[i] - emission_[i] + seen_emission_[i];
            squares[i] = light[i] * light[i];
        }
        all.multiply(light, mean, workers_);
        all.multiply(squares, mean_of_squares, workers_);
        std::vector<double> spread(n);
        double sum = 0, sum_of_weights = 0;
        for (std::size_t i = 0; i < n; ++i) {
            const Vec3 variance = glm::max(mean_of_squares[i] - mean[i] * mean[i], 0.0);
            spread[i] = std::sqrt(glm::dot(reflectance_[i] * reflectance_[i], variance));
            sum += prior_weights_[i] * spread[i];
            sum_of_weights += prior_weights_[i];
        }
        if (sum > 0)
            for (std::size_t i = 0; i < n; ++i)
                weights_[i] =
                    prior_weights_[i] * (trust * spread[i] * sum_of_weights / sum + 1 - trust);
    }

    /// What arrives at each patch in the end, from these sets together.
    ExchangeMatrix solve(std::span<const RayCounts> counts, std::span<const DirectLight> direct,
                         std::vector<Vec3>& incident, double tolerance) {
        ExchangeMatrix factors(input_.mesh, counts, workers_);
        const std::size_t n = area_.size();
        std::vector<Vec3> d(n), seen(n);
        factors.multiply(seen_emission_, d, workers_);
        factors.multiply(emission_, seen, workers_);
        for (std::uint32_t i = 0; i < n; ++i) {
            if (direct[0].samples(i) == 0) // black: rays at random tell well enough what it absorbs
                d[i] = seen[i];
            for (const DirectLight& light : direct)
                d[i] += light.irradiance(i) / static_cast<double>(direct.size());
        }
        balance(factors, d);
        solve_by_gradients(factors, area_, reflectance_, d, incident, workers_,
                           {.tolerance = tolerance});
        energy_ = close_energy({area_, emission_, reflectance_, factors.lost(), factors.rays()},
                               incident);
        return factors;
    }

    /// What arrives from the emitters in all is what they sent, less what was lost. In bright rooms
    /// an error of it would be the error of the whole solution.
    void balance(const ExchangeMatrix& factors, std::vector<Vec3>& d) const {
        Vec3 sent(0.0), arrived(0.0), all_sent(0.0), uncertain(0.0);
        for (std::uint32_t i = 0; i < area_.size(); ++i) {
            const Vec3 power = area_[i] * emission_[i];
            const LostShare share = factors.lost()[i];
            const double lost = share.escaped + share.absorbed;
            all_sent += power;
            sent += (1 - lost) * power;
            arrived += area_[i] * d[i];
            uncertain += power * power * (lost * (1 - lost) / std::max(rays_[i], 1u));
        }
        for (int c = 0; c < 3; ++c)
            if (arrived[c] > 0 && std::sqrt(uncertain[c]) < surely_lost * all_sent[c])
                for (Vec3& incident : d)
                    incident[c] *= sent[c] / arrived[c];
    }

    void combine(const ExchangeMatrix& all) {
        variance_ = direct_variance_ = 0;
        for (std::uint32_t i = 0; i < area_.size(); ++i) {
            Vec3 mean(0.0), squares(0.0), direct_mean(0.0), direct_squares(0.0);
            std::uint64_t hits = 0;
            for (std::size_t s = 0; s < sets; ++s) {
                mean += incident(s, i) / double(sets);
                direct_mean += direct_[s].irradiance(i) / double(sets);
                hits += direct_[s].hits(i);
            }
            for (std::size_t s = 0; s < sets; ++s) {
                const Vec3 off = incident(s, i) - mean;
                const Vec3 direct_off = direct_[s].irradiance(i) - direct_mean;
                squares += off * off;
                direct_squares += direct_off * direct_off;
            }
            const Vec3 rho = reflectance_[i];
            solution_.radiosity[i] = emission_[i] + rho * incident(sets, i);
            solution_.standard_error[i] = rho * glm::sqrt(squares / double(sets * (sets - 1)));
            solution_.hits[i] = hits + std::uint64_t{rays_[i]} * sets;
            variance_ += area_[i] * glm::dot(rho * rho, squares);
            direct_variance_ +=
                area_[i] * glm::dot(rho * rho, direct_squares) / double(generation_ + 1);
        }
        variance_ = std::max(variance_, direct_variance_);
        weigh(all);
        account();
        solution_.rays_energy = traced_;
        solution_.bytes_transport = all.bytes();
        for (std::size_t s = 0; s < sets; ++s)
            solution_.bytes_transport += counts_[s].bytes() + direct_[s].bytes();
        ++solution_.steps;
    }

    /// Mean over the generations, as of the light that arrives.
    void account() {
        const double to_world = input_.mesh.frame().area_to_world(1.0);
        const double generations = double(generation_ + 1);
        solution_.energy = {to_world * energy_.emitted,
                            to_world / generations * (finished_energy_.absorbed + energy_.absorbed),
                            to_world / generations * (finished_energy_.escaped + energy_.escaped),
                            Vec3(0.0)};
    }

    SolverInput input_;
    Workers workers_;
    std::vector<std::uint32_t> emitters_; ///< those reached by shadow rays
    std::vector<double> area_;
    std::vector<Vec3> reflectance_, emission_;
    std::vector<Vec3> seen_emission_; ///< of those that rays at random are to find
    std::vector<RayCounts> counts_;
    std::vector<DirectLight> direct_;
    std::vector<std::vector<Vec3>> incident_; ///< of each set, at last of all together
    std::vector<std::vector<Vec3>> finished_; ///< sums over the generations before
    EnergyBalance energy_, finished_energy_;  ///< of what was solved last; of those sums; local
    std::uint64_t generation_ = 0;
    double mean_rays_ = 0, mean_samples_ = 0; ///< per patch and set
    std::vector<std::uint32_t> rays_, samples_;
    std::vector<double> weights_, direct_weights_; ///< what a ray or a sample is worth
    std::vector<double> prior_weights_;            ///< of rays, before anything is known
    double variance_ = 0, direct_variance_ = 0;
    std::uint64_t traced_ = 0;
    Solution solution_;
};

std::unique_ptr<Solver> make_gathering(const SolverInput& input) {
    return std::make_unique<GatheringSolver>(input);
}

} // namespace

extern const Method gathering_method;
const Method gathering_method{
    .name = "gathering",
    .summary = "rays are kept and all bounces solved on them; lamps by shadow rays",
    .has_literal = false,
    .unbiased = false,
    .default_stop = {.steps = {}, .seconds = {}, .error = .01},
    .make = make_gathering,
    .strategy = nullptr,
    .work = {.pairs = true},
};

} // namespace hemilux
