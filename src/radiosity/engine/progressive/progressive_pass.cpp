#include "radiosity/engine/progressive/progressive_pass.h"

#include "geometry/elementary.h"
#include "radiosity/engine/factors/pairs/pair_factor.h"
#include "radiosity/engine/form_factors/factor_options.h"
#include "radiosity/engine/solving/own_options.h"
#include "radiosity/paper/rays/shot.h"
#include "radiosity/paper/sampling/rng.h"
#include "radiosity/paper/scene/mesh.h"
#include "radiosity/paper/solution/solve_error.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>

namespace hemilux {
namespace {

/// A pass ends when the light still to come is less than this share of the light reflected so far,
/// and hardly any emitted power is left to account for. Over all, a far larger share would do. But
/// small patches hold little power to the end, and it is what lights their small neighbours.
constexpr double finished_share = 2e-5, finished_share_of_emitted = 5e-3;

/// The limits on the number of rays from each shooter that find how much of its light leaves the
/// scene.
constexpr double min_lost_rays = 16, max_lost_rays = 16384;

/// The largest mean reflectances, so that sums of all reflections stay finite. The first is for the
/// light that a pass waits for, the second for its errors, as light in a bright room may go round
/// for longer.
constexpr double max_reflectance = .999, max_of_errors = .99999;

/// The most that overshooting adds to what is unshot, as a share of that.
constexpr double max_overshot = .8;

/// The area where the light can be.
struct ReflectingArea {
    double area = 0;
    Vec3 mean_reflectance{0.0};

    explicit ReflectingArea(const Mesh& mesh) {
        double total = 0;
        for (std::uint32_t i = 0; i < mesh.patches().size(); ++i) {
            const double here = mesh.patches()[i].area;
            const Vec3& reflectance = mesh.material(i).reflectance;
            total += here;
            area += reflectance != Vec3(0.0) ? here : 0;
            mean_reflectance += here * reflectance;
        }
        if (!(area > 0))
            area = total;
        mean_reflectance = glm::min(mean_reflectance / area, Vec3(max_of_errors));
    }
};

/// The number of pairs of patches and emitters that are looked at. Emitters beyond these pairs, in
/// the order of their power, count as a whole.
constexpr std::size_t max_pairs = 10'000'000;

/// Returns the power that would arrive at patches if nothing stood between them and the emitters,
/// in W/m2 times area in local units. A sun sends most of its light elsewhere; the light of a scene
/// is to be measured by the power that arrives.
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
    const std::size_t looked_at = 1 + max_pairs / mesh.patches().size();
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

/// Returns the radiosity that the mean patch will reflect in the end [W/m2].
double mean_reflected(const Mesh& mesh) {
    const ReflectingArea reflecting(mesh);
    const Vec3 rho = glm::clamp(reflecting.mean_reflectance, Vec3(min_reflectance_of_receivers),
                                Vec3(max_reflectance));
    return mean_of_channels(power_to_patches(mesh) * rho / (1.0 - rho)) / reflecting.area;
}

} // namespace

ProgressivePass::ProgressivePass(const SolverInput& input)
    : input_(input), options_(own_options<ProgressiveOptions>(input.options)),
      emitted_(emitted_power(input.mesh)), brightest_(input.mesh.patches().size()),
      balance_(input.needs.closed), factors_(input, mean_reflected(input.mesh)),
      hits_(input.mesh.patches().size()) {
    const ReflectingArea reflecting(input.mesh);
    reflecting_area_ = reflecting.area;
    mean_reflectance_ = reflecting.mean_reflectance;
    if (own_options<FactorOptions>(input.options).kind == FactorKind::hemicube)
        hemicube_.emplace(own_options<FactorOptions>(input.options).hemicube_edge);
}

void ProgressivePass::begin(double rays_per_light) {
    rays_per_light_ = rays_per_light;
    radiosity_.clear();
    for (std::uint32_t i = 0; i < hits_.size(); ++i)
        radiosity_.push_back(input_.mesh.material(i).emission);
    unshot_ = radiosity_;
    unshot_variance_.assign(hits_.size(), Vec3(0.0));
    for (std::uint32_t i = 0; i < hits_.size(); ++i)
        rank(i);
    variance_.assign(hits_.size(), Vec3(0.0));
    left_to_chance_.assign(hits_.size(), Vec3(0.0));
    power_variance_ = Vec3(0.0);
    absorbed_ = escaped_ = by_chance_ = {};
}

bool ProgressivePass::is_done() const {
    double left = 0;
    for (std::uint32_t i = 0; i < unshot_.size(); ++i)
        left += unshot_power(i);
    const Reflected now = reflected(max_reflectance);
    const double missing = left * mean_of_channels(now.gain);
    return !(missing > finished_share * mean_of_channels(now.power)) &&
           !(left > finished_share_of_emitted * mean_of_channels(emitted_));
}

/// Ranks by the unshot power, rounded to a power of 2^(1/256) of what is emitted. So among patches
/// that are alike except for rounding errors, the first shoots first.
void ProgressivePass::rank(std::uint32_t patch) {
    const double share = unshot_power(patch) / mean_of_channels(emitted_);
    brightest_.set(
        patch, share > 0 ? elementary::exp2(std::round(256 * elementary::log2(share)) / 256) : 0);
}

/// Returns the mean of channels. Overshooting leaves negative light, which counts alike.
double ProgressivePass::unshot_power(std::uint32_t patch) const {
    return input_.mesh.patches()[patch].area * mean_of_channels(glm::abs(unshot_[patch]));
}

void ProgressivePass::shoot(std::uint32_t step) {
    const auto shooter = static_cast<std::uint32_t>(brightest_.index_of_largest());
    const Vec3 unshot = unshot_[shooter]; // dB_s
    const Vec3 shot_variance = unshot_variance_[shooter];
    Vec3 shot = unshot;
    unshot_[shooter] = unshot_variance_[shooter] = Vec3(0.0);
    if (options_.overshoot) {
        // This is limited so that it converges, as over-relaxation by less than 2 does.
        const Vec3 later = glm::clamp(input_.mesh.material(shooter).reflectance * ambient(),
                                      Vec3(0.0), glm::max(max_overshot * shot, 0.0));
        shot += later;
        unshot_[shooter] = -later;
    }
    check_finite(input_.mesh, shooter, shot, "the radiosity to be shot", step);
    rank(shooter);
    const ShotShares shares = look(shooter, shot);
    if (input_.monitor.interrupted) { // the light is still to be shot
        unshot_[shooter] = unshot;
        unshot_variance_[shooter] = shot_variance;
        rank(shooter);
        return;
    }
    receive(shot, shot_variance, shares);
    note_power_variance(shot, shares);
    const Vec3 power = shot * input_.mesh.patches()[shooter].area;
    escaped_ += shares.lost.escaped * power;
    absorbed_ += shares.lost.absorbed * power;
    by_chance_ += shares.by_chance * power;
    ++shots_;
}

/// Looks for the factors of the shot. They are void if interrupted.
ShotShares ProgressivePass::look(std::uint32_t shooter, const Vec3& shot) {
    if (hemicube_) {
        const EscapeFraction lost = factors_.look(*hemicube_, shooter);
        if (input_.monitor.interrupted)
            return {};
        points_ += hemicube_->pixels();
        rays_ += hemicube_->pixels();
        return {.lost = lost};
    }
    factors_.look(shooter, shot, rays_per_light_,
                  hash_words({input_.options.seed, shots_, shooter}));
    if (input_.monitor.interrupted)
        return {};
    return balance_.balance(factors_.sum(), look_for_losses(shooter, shot));
}

/// Receives in the order of the patches, whichever thread has looked.
void ProgressivePass::receive(const Vec3& shot, const Vec3& shot_variance,
                              const ShotShares& shares) {
    for (std::uint32_t i = 0; i < hits_.size(); ++i) {
        const ReceiverFactor& from = factors_.by_receiver()[i];
        const Vec3& rho = input_.mesh.material(i).reflectance;
        const Vec3 incident = shot * (shares.scale * from.factor);
        radiosity_[i] += rho * incident;
        unshot_[i] += rho * incident;
        if (from.factor > 0)
            rank(i);
        const double factor = shares.scale * from.factor;
        const Vec3 variance =
            rho * rho *
            (shot * shot * (shares.scale * shares.scale * from.variance) +
             incident * incident * shares.variance + shot_variance * (factor * factor));
        variance_[i] += variance;
        unshot_variance_[i] += variance;
        left_to_chance_[i] +=
            rho * shot * rho * shot * (shares.scale * shares.scale * from.left_to_chance);
        absorbed_ += (1.0 - rho) * incident * input_.mesh.patches()[i].area;
        hits_[i] += from.hits;
        points_ += from.points;
        rays_ += from.rays;
    }
}

/// Adds the variance of what the receivers of the shot reflect together. Where the factors were
/// made to sum up to what arrives, their errors only move light between receivers, whose
/// reflectances may differ.
void ProgressivePass::note_power_variance(const Vec3& shot, const ShotShares& shares) {
    Vec3 arriving(0.0), reflected(0.0);
    for (std::uint32_t i = 0; i < hits_.size(); ++i) {
        const Vec3 here = shot * (shares.scale * factors_.by_receiver()[i].factor *
                                  input_.mesh.patches()[i].area);
        arriving += here;
        reflected += input_.mesh.material(i).reflectance * here;
    }
    Vec3 mean_reflectance(0.0);
    for (int c = 0; c < 3; ++c)
        if (shares.scaled && arriving[c] > 0)
            mean_reflectance[c] = reflected[c] / arriving[c];
    power_variance_ += reflected * reflected * shares.variance;
    for (std::uint32_t i = 0; i < hits_.size(); ++i) {
        const Vec3 more = (input_.mesh.material(i).reflectance - mean_reflectance) * shot *
                          (shares.scale * input_.mesh.patches()[i].area);
        power_variance_ += more * more * factors_.by_receiver()[i].variance;
    }
}

/// Factors do not say where the rest of the light went; some rays from the shooter do.
ShotRays ProgressivePass::look_for_losses(std::uint32_t shooter, const Vec3& shot) {
    const double power = mean_of_channels(glm::abs(shot)) * input_.mesh.patches()[shooter].area;
    const double wanted = std::clamp(rays_per_light_ * power / mean_of_channels(emitted_),
                                     min_lost_rays, max_lost_rays);
    const auto count = std::bit_ceil(static_cast<std::uint32_t>(wanted));
    points_ += count;
    rays_ += count;
    input_.monitor.rays += count;
    return shoot_to_lose(input_.mesh, input_.tracer, input_.needs, shooter, count,
                         hash_words({input_.options.seed, shots_, shooter, 1}));
}

ProgressivePass::Reflected ProgressivePass::reflected(double most) const {
    Reflected result;
    Vec3 weighted(0.0), mean_reflectance = glm::min(mean_reflectance_, Vec3(most));
    for (std::uint32_t i = 0; i < radiosity_.size(); ++i) {
        const Material& material = input_.mesh.material(i);
        const Vec3 power = input_.mesh.patches()[i].area * (radiosity_[i] - material.emission);
        result.power += power;
        weighted += material.reflectance * power;
    }
    for (int c = 0; c < 3; ++c)
        if (result.power[c] > 0)
            mean_reflectance[c] =
                std::clamp(weighted[c] / result.power[c], mean_reflectance[c], most);
    result.gain = mean_reflectance / (1.0 - mean_reflectance);
    return result;
}

/// Returns the irradiance that the unshot light will bring to the mean patch: the ambient term of
/// Cohen et al. (1988).
Vec3 ProgressivePass::ambient() const {
    return power_unshot() / (1.0 - mean_reflectance_) / reflecting_area_;
}

Vec3 ProgressivePass::power_unshot() const {
    CompensatedSum<Vec3> power;
    for (std::uint32_t i = 0; i < unshot_.size(); ++i)
        power += unshot_[i] * input_.mesh.patches()[i].area;
    return power.value();
}

Estimate ProgressivePass::estimate() const {
    const Vec3 missing = ambient();
    const Vec3 gain = 1.0 / ((1.0 - mean_reflectance_) * reflecting_area_);
    const Vec3 shared = gain * gain * power_variance_;
    // What is unshot may stay where the light is, as inside a lampshade.
    const Reflected now = reflected(max_of_errors);
    Vec3 share(0.0);
    for (int c = 0; c < 3; ++c)
        if (now.power[c] > 0)
            share[c] = power_unshot()[c] * now.gain[c] / now.power[c];
    Estimate result{
        radiosity_,
        variance_,
        left_to_chance_,
        {},
        0,
        {emitted_, absorbed_.value(), escaped_.value(), power_unshot() + by_chance_.value()}};
    for (std::uint32_t i = 0; i < hits_.size(); ++i) {
        const Vec3& rho = input_.mesh.material(i).reflectance;
        const Vec3 here = share * (radiosity_[i] - input_.mesh.material(i).emission);
        result.missing.push_back(glm::max(glm::abs(rho * missing), glm::abs(here)));
        result.variance[i] += rho * rho * shared;
        result.shared += input_.mesh.patches()[i].area * glm::dot(rho * rho, shared);
        if (options_.ambient)
            result.radiosity[i] += rho * missing;
    }
    return result;
}

} // namespace hemilux
