#include "radiosity/engine/progressive/shot_factors.h"

#include "geometry/compensated_sum.h"
#include "radiosity/paper/rays/shot.h"
#include "radiosity/paper/sampling/rng.h"
#include "radiosity/paper/scene/mesh.h"

#include <algorithm>
#include <cmath>

namespace hemilux {
namespace {

/// Fewer pairs are done before other threads could be started.
constexpr std::size_t receivers_per_chunk = 256;

/// Pairs that deserve less than this many rays are only looked at by chance, and then count for
/// those that are not.
constexpr double min_importance = .05;

} // namespace

ShotFactors::ShotFactors(const SolverInput& input, double mean_reflected)
    : input_(input), workers_(input.options.threads), mean_reflected_(mean_reflected),
      rough_(input.mesh.patches().size()), by_receiver_(input.mesh.patches().size()) {
    for (const Patch& patch : input.mesh.patches())
        mean_area_ += patch.area;
    mean_area_ /= static_cast<double>(by_receiver_.size());
}

void ShotFactors::look(std::uint32_t shooter, const Vec3& shot, double rays_per_light,
                       std::uint64_t seed) {
    shooter_ = shooter;
    guess();
    workers_.for_chunks(
        by_receiver_.size(), receivers_per_chunk, [&](std::size_t begin, std::size_t end) {
            std::uint64_t rays = 0;
            for (std::size_t i = begin; i < end && !input_.monitor.interrupted; ++i) {
                by_receiver_[i] =
                    look_from(static_cast<std::uint32_t>(i), shot, rays_per_light, seed);
                rays += by_receiver_[i].rays;
            }
            input_.monitor.rays += rays;
        });
}

EscapeFraction ShotFactors::look(const Hemicube& cube, std::uint32_t shooter) {
    shooter_ = shooter;
    const HemicubeRow row = hemicube_row(cube, input_.mesh, input_.tracer, shooter, workers_,
                                         input_.monitor.interrupted);
    input_.monitor.rays += cube.pixels();
    const auto patches = input_.mesh.patches();
    std::ranges::fill(by_receiver_, ReceiverFactor{});
    for (const HemicubeRow::Entry& entry : row.entries) {
        ReceiverFactor& factor_here = by_receiver_[entry.patch];
        factor_here.factor = entry.factor * patches[shooter].area / patches[entry.patch].area;
        factor_here.hits = entry.pixels;
    }
    return row.lost;
}

/// Guesses the factors to the shooter. None is more than the ratio of the areas, as no more arrives
/// than is shot, and all factors of a patch sum up to 1 at most. Where the guesses sum up to S > 1,
/// because patches stand in front of each other, a receiver sees the shooter with a probability of
/// about 1 / S. The standard deviation of what it sees, to which its rays should be proportional,
/// is then smaller by the root of S.
void ShotFactors::guess() {
    const auto patches = input_.mesh.patches();
    workers_.for_chunks(
        by_receiver_.size(), receivers_per_chunk, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i)
                rough_[i] = is_receiver(static_cast<std::uint32_t>(i))
                                ? std::min(rough_factor(patches[i], patches[shooter_]),
                                           patches[shooter_].area / patches[i].area)
                                : 0;
        });
    CompensatedSum<double> sum;
    for (std::uint32_t i = 0; i < rough_.size(); ++i)
        sum += rough_[i] * patches[i].area / patches[shooter_].area;
    crowding_ = std::max(1.0, sum.value());
}

/// Returns whether a patch receives light of the shot. What a patch without power absorbs is among
/// the losses.
bool ShotFactors::is_receiver(std::uint32_t patch) const {
    const auto patches = input_.mesh.patches();
    return patch != shooter_ && input_.needs.power(patch) &&
           may_see(patches[patch], patches[shooter_]);
}

ReceiverFactor ShotFactors::look_from(std::uint32_t receiver, const Vec3& shot,
                                      double rays_per_light, std::uint64_t seed) const {
    const double rough = rough_[receiver];
    if (!(rough > 0))
        return {};
    const Vec3 rho =
        glm::max(input_.mesh.material(receiver).reflectance, min_reflectance_of_receivers);
    // The error of a sum is least with rays in proportion to what each term contributes; an error
    // counts by the root of the area.
    const double importance = mean_of_channels(rho * glm::abs(shot)) * rough / mean_reflected_ *
                              std::sqrt(input_.mesh.patches()[receiver].area / mean_area_);
    const double rays = rays_per_light / std::sqrt(crowding_) * importance;
    const double chance = std::min(rays / min_importance, 1.0);
    const double at_risk = chance < 1 ? rough / crowding_ : 0;
    // This is the variance of a factor that is `rough` with a probability of 1 / crowding_, looked
    // at with the probability `chance`.
    const double left_to_chance = rays > 0 ? (1 - chance) / chance * rough * rough / crowding_ : 0;
    if (chance < 1 && !(Rng(hash_words({seed, receiver})).uniform() < chance))
        return {{}, at_risk, left_to_chance};
    ReceiverFactor f{pair_factor(input_.mesh, input_.tracer, receiver, shooter_, rays, seed,
                                 input_.needs.visibility),
                     at_risk, left_to_chance};
    f.variance = f.variance / chance + (1 - chance) * (f.factor / chance) * (f.factor / chance);
    f.factor /= chance;
    return f;
}

FactorSum ShotFactors::sum() const {
    const double area = input_.mesh.patches()[shooter_].area;
    CompensatedSum<double> sum;
    FactorSum result;
    for (std::uint32_t i = 0; i < by_receiver_.size(); ++i) {
        const double ratio = input_.mesh.patches()[i].area / area;
        sum += ratio * by_receiver_[i].factor;
        result.variance += ratio * ratio * by_receiver_[i].variance;
        result.at_risk += ratio * by_receiver_[i].at_risk;
        result.points += static_cast<double>(by_receiver_[i].points);
    }
    result.sum = sum.value();
    return result;
}

} // namespace hemilux
