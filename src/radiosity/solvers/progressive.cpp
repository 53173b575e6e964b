// Progressive radiosity (paper section 3.1; Cohen, Chen, Wallace and Greenberg 1988).
//
// The patch with the most unshot power shoots it to all others at once:
//
//     B_i += rho_i dB_s F_is,
//
// F_is being the form factor from the receiver i to the shooter s, so that the one from s to i need
// not be known (A_i F_is = A_s F_si). Form factors are computed on the fly as by Wallace, Elmquist
// and Haines (1989): from points of the receiver, the closed form of point and polygon times the
// visibility along a ray to the shooter, with more points where more light may come
// (pair_factor.h). Each shot draws new ones.
//
// Parameter: --rays. A step is as many shots as use up so many points per patch, one at least; and
// the form factors are the more accurate the more rays are asked for. When hardly any power is left
// unshot, a pass is done: with 64 rays it is within 1 or 2 % of the exact solution. The next one
// begins again, four times as accurate, and the result is the mean of the passes by what they are
// worth. --one-shot makes a step of each shot and ends with the first pass, --ambient shows what is
// still unshot, --overshoot shoots ahead (ProgressiveOptions in solver.h).
//
// The standard error holds that of each patch, and that of all light together spread evenly.
//
// Good for a first picture after few shots, and for the shadows of few small lamps. Bad with many
// patches and high reflectances, as each patch shoots many times. No memory to speak of. Not
// unbiased: after a finite number of shots some light is missing.

#include "geometry/compensated_sum.h"
#include "radiosity/check_input.h"
#include "radiosity/estimate.h"
#include "radiosity/largest_first.h"
#include "radiosity/mesh.h"
#include "radiosity/rng.h"
#include "radiosity/shot.h"
#include "radiosity/shot_balance.h"
#include "radiosity/shot_factors.h"
#include "radiosity/solve_error.h"
#include "radiosity/solver.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace hemilux {
namespace {

/// For each of --rays, shadow rays in a shot that gives a receiver as much light as the mean patch
/// reflects in the end; other shots get them in proportion. This many in the first pass; four times
/// as many in the next, which about halves the error.
constexpr double rays_per_light_unit = 2, growth_of_passes = 4;

/// A pass ends when the light that is still to come is less than this share of the light reflected
/// so far, and hardly any emitted power is left to account for. Over all, far more would do; but
/// small patches hold little power to the end, and it is what lights their small neighbours.
constexpr double finished_share = 2e-5, finished_share_of_emitted = 5e-3;

/// Rays from each shooter to find how much of its light leaves the scene.
constexpr double least_lost_rays = 16, most_lost_rays = 16384;

/// Of a mean, so that sums of all reflections stay finite.
constexpr double most_reflectance = .999;

/// Of patches and emitters, to guess what light reaches patches at all: a moment's work.
constexpr std::size_t most_pairs_before_shots = 10'000'000;

/// What overshooting adds at most to what is unshot.
constexpr double most_overshot = .8;

/// About the emitted power that falls on patches, were nothing between them: a sun sends most of
/// its light elsewhere, and what lights a scene is to be measured by what gets there. Emitters
/// beyond the first pairs, in the order of their power, count as a whole.
Vec3 power_to_patches(const Mesh& mesh) {
    const auto power_of = [&](std::uint32_t e) {
        return mesh.patches()[e].area * mesh.material(e).emission;
    };
    std::vector<std::uint32_t> emitters;
    for (std::uint32_t e = 0; e < mesh.patches().size(); ++e)
        if (mesh.material(e).emission != Vec3(0.0))
            emitters.push_back(e);
    std::ranges::stable_sort(emitters, std::greater{},
                             [&](std::uint32_t e) { return mean_of_channels(power_of(e)); });
    const std::size_t looked_at = 1 + most_pairs_before_shots / mesh.patches().size();
    CompensatedSum<Vec3> power;
    for (std::size_t k = 0; k < emitters.size(); ++k) {
        const Patch& emitter = mesh.patches()[emitters[k]];
        double share = 1;
        if (k < looked_at) {
            double area = 0; // times the factor to the emitter: the emitter's times that from it
            for (const Patch& patch : mesh.patches())
                if (&patch != &emitter && may_see(patch, emitter))
                    area += patch.area * rough_factor(patch, emitter);
            share = std::min(1.0, area / emitter.area);
        }
        power += share * power_of(emitters[k]);
    }
    return power.value();
}

class ProgressiveSolver final : public Solver {
  public:
    explicit ProgressiveSolver(const SolverInput& input)
        : input_(input), options_(input.options.progressive),
          brightest_(input.mesh.patches().size()), balance_(input.needs.closed),
          hits_(input.mesh.patches().size()) {
        check_input(input);
        double total_area = 0;
        for (std::uint32_t i = 0; i < hits_.size(); ++i) {
            const double area = input.mesh.patches()[i].area;
            const Vec3& reflectance = input.mesh.material(i).reflectance;
            total_area += area;
            reflecting_area_ += reflectance != Vec3(0.0) ? area : 0;
            mean_reflectance_ += area * reflectance;
        }
        if (!(reflecting_area_ > 0))
            reflecting_area_ = total_area;
        emitted_ = emitted_power(input.mesh);
        mean_reflectance_ = glm::min(mean_reflectance_ / reflecting_area_, Vec3(most_reflectance));
        const Vec3 rho = glm::max(mean_reflectance_, least_reflectance_of_receivers);
        arriving_ = power_to_patches(input.mesh);
        factors_.emplace(input, mean_of_channels(arriving_ * rho / (1.0 - rho)) / reflecting_area_);
        solution_.may_find_light = input.needs.bounces;
        begin_pass();
        publish(estimate());
        solution_.steps = 0;
    }

    bool step() override {
        input_.monitor.phase = "shooting";
        const double wanted = input_.options.rays * static_cast<double>(hits_.size());
        const std::uint64_t before = points_;
        bool cut_short = false;
        while (!finished() && !cut_short) {
            if (pass_is_done()) {
                end_pass();
                continue;
            }
            const double used = static_cast<double>(points_ - before);
            input_.monitor.step_share = std::min(1.0, used / wanted);
            if (used >= wanted)
                break;
            shoot(static_cast<std::uint32_t>(brightest_.index_of_largest()));
            cut_short = input_.monitor.interrupted;
            // At the end of the time the shots of this step count.
            if (cut_short && (input_.monitor.interrupted.load() || points_ == before))
                return false;
            if (options_.one_shot)
                break;
        }
        publish(passes_ > 0 ? mean_ : estimate());
        return true;
    }

    [[nodiscard]] bool finished() const override {
        const bool sure =
            (is_lit(mean_.radiosity) || !solution_.may_find_light) &&
            std::ranges::all_of(mean_.variance, [](const Vec3& v) { return v == Vec3(0.0); });
        return (passes_ > 0 && (options_.one_shot || sure)) || emitted_ == Vec3(0.0);
    }
    [[nodiscard]] const Solution& solution() const override { return solution_; }

  private:
    void begin_pass() {
        radiosity_.clear();
        for (std::uint32_t i = 0; i < hits_.size(); ++i)
            radiosity_.push_back(input_.mesh.material(i).emission);
        unshot_ = radiosity_;
        for (std::uint32_t i = 0; i < hits_.size(); ++i)
            rank(i);
        variance_.assign(hits_.size(), Vec3(0.0));
        absorbed_ = escaped_ = by_chance_ = {};
        rays_per_light_ =
            rays_per_light_unit * input_.options.rays * std::pow(growth_of_passes, double(passes_));
    }

    /// A pass is worth as much as it has rays.
    void end_pass() {
        worth_ += rays_per_light_;
        if (passes_++ == 0)
            mean_ = estimate();
        else
            mean_.join(estimate(), rays_per_light_ / worth_);
        begin_pass();
    }

    [[nodiscard]] bool pass_is_done() const {
        double left = 0;
        for (std::uint32_t i = 0; i < unshot_.size(); ++i)
            left += unshot_power(i);
        const Reflected reflected = this->reflected();
        const double missing = left * mean_of_channels(reflected.gain);
        return !(missing > finished_share * mean_of_channels(reflected.power)) &&
               !(left > finished_share_of_emitted * mean_of_channels(emitted_));
    }

    [[nodiscard]] bool is_lit(std::span<const Vec3> radiosity) const {
        for (std::uint32_t i = 0; i < radiosity.size(); ++i)
            if (radiosity[i] != input_.mesh.material(i).emission)
                return true;
        return false;
    }

    /// To the nearest power of 2^(1/256) of what is emitted: of patches that are alike but for
    /// rounding errors the first shoots first.
    void rank(std::uint32_t patch) {
        const double share = unshot_power(patch) / mean_of_channels(emitted_);
        brightest_.set(patch, share > 0 ? std::exp2(std::round(256 * std::log2(share)) / 256) : 0);
    }

    /// Mean of channels. Overshooting leaves negative light, which counts alike.
    [[nodiscard]] double unshot_power(std::uint32_t patch) const {
        return input_.mesh.patches()[patch].area * mean_of_channels(glm::abs(unshot_[patch]));
    }

    void shoot(std::uint32_t shooter) {
        Vec3 shot = unshot_[shooter]; // dB_s
        unshot_[shooter] = Vec3(0.0);
        if (options_.overshoot) {
            // At most so much that it converges: as over-relaxation by less than 2 does.
            const Vec3 later = glm::clamp(input_.mesh.material(shooter).reflectance * ambient(),
                                          Vec3(0.0), glm::max(most_overshot * shot, 0.0));
            shot += later;
            unshot_[shooter] = -later;
        }
        check_finite(input_.mesh, shooter, shot, "the radiosity to be shot", solution_.steps + 1);
        rank(shooter);
        factors_->look(shooter, shot, rays_per_light_,
                       hash_words({input_.options.seed, shots_, shooter}));
        if (input_.monitor.interrupted)
            return;
        const ShotShares shares = balance_.settle(factors_->sum(), look_for_losses(shooter, shot));
        receive(shot, shares.scale);
        const Vec3 power = shot * input_.mesh.patches()[shooter].area;
        escaped_ += shares.lost.escaped * power;
        absorbed_ += shares.lost.absorbed * power;
        by_chance_ += shares.by_chance * power;
        ++shots_;
    }

    /// In the order of the patches, whatever thread has looked.
    void receive(const Vec3& shot, double scale) {
        for (std::uint32_t i = 0; i < hits_.size(); ++i) {
            const Sight& seen = factors_->sights()[i];
            const Vec3& rho = input_.mesh.material(i).reflectance;
            const Vec3 incident = shot * (scale * seen.factor);
            radiosity_[i] += rho * incident;
            unshot_[i] += rho * incident;
            if (seen.factor > 0)
                rank(i);
            variance_[i] += rho * shot * rho * shot * (scale * scale * seen.variance);
            absorbed_ += (1.0 - rho) * incident * input_.mesh.patches()[i].area;
            hits_[i] += seen.hits;
            points_ += seen.points;
            rays_ += seen.rays;
        }
    }

    /// Factors do not tell where the rest of the light went; some rays from the shooter do.
    [[nodiscard]] ShotRays look_for_losses(std::uint32_t shooter, const Vec3& shot) {
        const double power = mean_of_channels(glm::abs(shot)) * input_.mesh.patches()[shooter].area;
        const double wanted = std::clamp(rays_per_light_ * power / mean_of_channels(emitted_),
                                         least_lost_rays, most_lost_rays);
        const auto count = std::bit_ceil(static_cast<std::uint32_t>(wanted));
        points_ += count;
        rays_ += count;
        input_.monitor.rays += count;
        return shoot_to_lose(input_.mesh, input_.tracer, input_.needs, shooter, count,
                             hash_words({input_.options.seed, shots_, shooter, 1}));
    }

    /// The light that was reflected so far, over all patches.
    struct Reflected {
        Vec3 power{0.0};
        Vec3 gain{0.0}; ///< what all reflections add to light where this is, relative to it
    };
    [[nodiscard]] Reflected reflected() const {
        Reflected result;
        Vec3 weighted(0.0), usual = mean_reflectance_;
        for (std::uint32_t i = 0; i < radiosity_.size(); ++i) {
            const Material& material = input_.mesh.material(i);
            const Vec3 power = input_.mesh.patches()[i].area * (radiosity_[i] - material.emission);
            result.power += power;
            weighted += material.reflectance * power;
        }
        for (int c = 0; c < 3; ++c)
            if (result.power[c] > 0)
                usual[c] = std::clamp(weighted[c] / result.power[c], usual[c], most_reflectance);
        result.gain = usual / (1.0 - usual);
        return result;
    }

    /// Irradiance that the unshot light will bring to the mean patch: the ambient term of Cohen et
    /// al. (1988).
    [[nodiscard]] Vec3 ambient() const {
        return power_unshot() / (1.0 - mean_reflectance_) / reflecting_area_;
    }

    [[nodiscard]] Vec3 power_unshot() const {
        CompensatedSum<Vec3> power;
        for (std::uint32_t i = 0; i < unshot_.size(); ++i)
            power += unshot_[i] * input_.mesh.patches()[i].area;
        return power.value();
    }

    /// After the last shot of this pass.
    [[nodiscard]] Estimate estimate() const {
        const Vec3 missing = ambient();
        Vec3 power_variance(0.0);
        for (std::uint32_t i = 0; i < hits_.size(); ++i)
            power_variance += std::pow(input_.mesh.patches()[i].area, 2.0) * variance_[i];
        const Vec3 gain = 1.0 / ((1.0 - mean_reflectance_) * reflecting_area_);
        const Vec3 shared = missing * missing + gain * gain * power_variance;
        // What is unshot may stay where the light is now, as in the shade around a lamp.
        const Reflected now = reflected();
        Vec3 share(0.0);
        for (int c = 0; c < 3; ++c)
            if (now.power[c] > 0)
                share[c] = power_unshot()[c] * now.gain[c] / now.power[c];
        Estimate result{
            radiosity_,
            variance_,
            {emitted_, absorbed_.value(), escaped_.value(), power_unshot() + by_chance_.value()}};
        for (std::uint32_t i = 0; i < hits_.size(); ++i) {
            const Vec3& rho = input_.mesh.material(i).reflectance;
            const Vec3 here = share * (radiosity_[i] - input_.mesh.material(i).emission);
            result.variance[i] += glm::max(rho * rho * shared, here * here);
            if (options_.ambient)
                result.radiosity[i] += rho * missing;
        }
        return result;
    }

    void publish(const Estimate& estimate) {
        check_finite(input_.mesh, estimate.radiosity, "the radiosity", solution_.steps + 1);
        solution_.radiosity = estimate.radiosity;
        solution_.standard_error.clear();
        for (const Vec3& variance : estimate.variance)
            solution_.standard_error.push_back(glm::sqrt(variance));
        solution_.hits = hits_;
        const double to_world = input_.mesh.frame().area_to_world(1.0);
        solution_.energy = {to_world * emitted_, to_world * estimate.energy.absorbed,
                            to_world * estimate.energy.escaped, to_world * estimate.energy.unshot};
        solution_.rays_energy = rays_;
        ++solution_.steps;
    }

    SolverInput input_;
    ProgressiveOptions options_;
    std::optional<ShotFactors> factors_;
    double reflecting_area_ = 0;
    Vec3 mean_reflectance_{0.0}; ///< of that, by area
    Vec3 emitted_{0.0};
    Vec3 arriving_{0.0}; ///< about what of it would fall on patches if nothing stood between
    // The present pass after its last shot; solution_ is that after the last step.
    std::vector<Vec3> radiosity_, unshot_;                ///< B and dB
    LargestFirst brightest_;                              ///< unshot power
    std::vector<Vec3> variance_;                          ///< of B by sampling
    CompensatedSum<Vec3> absorbed_, escaped_, by_chance_; ///< power, local units
    ShotBalance balance_;
    double rays_per_light_ = 0;
    // All passes before.
    Estimate mean_;
    double worth_ = 0;
    std::uint32_t passes_ = 0;
    std::vector<std::uint64_t> hits_;
    std::uint64_t points_ = 0, rays_ = 0, shots_ = 0;
    Solution solution_;
};

std::unique_ptr<Solver> make_progressive(const SolverInput& input) {
    return std::make_unique<ProgressiveSolver>(input);
}

} // namespace

extern const Method progressive_method;
const Method progressive_method{
    .name = "progressive",
    .summary = "the brightest patch shoots by explicit form factors (Cohen et al. 1988; paper 3.1)",
    .has_literal = false,
    .unbiased = false,
    .default_stop = {.steps = {}, .seconds = {}, .error = .01},
    .make = make_progressive,
    .strategy = nullptr,
    .work = {.pairs = true},
};

} // namespace hemilux
