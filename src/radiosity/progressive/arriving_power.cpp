#include "radiosity/progressive/arriving_power.h"

#include "geometry/compensated_sum.h"
#include "radiosity/form_factors/pair_factor.h"
#include "radiosity/rays/shot.h"
#include "radiosity/scene/mesh.h"

#include <algorithm>
#include <functional>
#include <vector>

namespace hemilux {
namespace {

/// Of patches and emitters. Emitters beyond the first pairs, in the order of their power, count as
/// a whole.
constexpr std::size_t most_pairs = 10'000'000;

} // namespace

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
    const std::size_t looked_at = 1 + most_pairs / mesh.patches().size();
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

} // namespace hemilux
