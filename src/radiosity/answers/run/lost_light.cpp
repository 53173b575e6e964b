#include "radiosity/answers/run/lost_light.h"

#include "radiosity/answers/asked/text.h"
#include "radiosity/engine/rays/point_emitter.h"
#include "radiosity/light/sides/light_paths.h"
#include "radiosity/paper/scene/mesh.h"
#include "radiosity/paper/solution/solution.h"

#include <algorithm>
#include <cmath>

namespace hemilux {
namespace {

/// Returns the power that is reflected, relative to what is emitted [-]; both over all channels.
double reflected_share(const Mesh& mesh, std::span<const Vec3> radiosity) {
    const Vec3 of_points = power_of_point_emitters(mesh.scene());
    double reflected = 0;
    double emitted = glm::dot(of_points, Vec3(1.0)) / mesh.frame().area_to_world(1.0);
    for (std::uint32_t i = 0; i < radiosity.size(); ++i) {
        const Vec3 power = mesh.patches()[i].area * mesh.material(i).emission;
        emitted += glm::dot(power, Vec3(1.0));
        reflected +=
            mesh.patches()[i].area * glm::dot(radiosity[i], Vec3(1.0)) - glm::dot(power, Vec3(1.0));
    }
    return emitted > 0 ? reflected / emitted : 0;
}

bool anything_reflects(const Mesh& mesh) {
    return std::ranges::any_of(mesh.scene().facets, [&](const Facet& facet) {
        return mesh.scene().materials[facet.material].reflectance != Vec3(0.0);
    });
}

/// Suns and skies emit mostly past the scene: what escapes of their light is no loss.
bool emits_from_far(const Mesh& mesh) {
    for (std::uint32_t i = 0; i < mesh.patches().size(); ++i) {
        const Material& material = mesh.material(i);
        if (material.is_far && mesh.patches()[i].area > 0 && material.emission != Vec3(0.0))
            return true;
    }
    return false;
}

/// Returns the shares by what escaped in a run, so that all that is said of it agrees; what else is
/// lost fell on backs, or on faces that lie over others.
LightShares as_in_ledger(LightShares light, const EnergyBalance& energy) {
    const auto sum = [](const Vec3& power) { return power.r + power.g + power.b; };
    const double emitted = sum(energy.emitted), lost = light.backs + light.escaped;
    if (!(emitted > 0))
        return light;
    const double escaped = std::clamp(sum(energy.escaped) / emitted, 0.0, 1.0);
    constexpr double by_chance = .05; // three times the standard error of the paths
    const bool agrees = std::abs(light.escaped - escaped) < by_chance;
    return {agrees ? light.backs : std::max(lost - escaped, 0.0), escaped};
}

} // namespace

std::optional<Finding> lost_light_finding(const Mesh& mesh, const Tracer& tracer,
                                          const Solution& solution, Sides sides) {
    if (solution.steps == 0)
        return {};
    LightShares light = find_light_shares(mesh, tracer);
    if (!emits_from_far(mesh))
        light = as_in_ledger(light, solution.energy);
    constexpr double nearly_all = 0.9, well_lit = 0.5, hardly = 0.1;
    const double reflected = reflected_share(mesh, solution.radiosity);
    const bool lit = reflected > 0;
    if (lit && (light.backs + light.escaped <= nearly_all || reflected > well_lit))
        return {};
    if (!lit && !anything_reflects(mesh))
        return Finding{Finding::Kind::warning, "nothing is lit: all reflectances are 0",
                       "--reflectance 'MATERIAL=R,G,B' changes them"};
    const std::string how = !lit                 ? "nothing is lit: "
                            : reflected < hardly ? "hardly anything is lit: "
                                                 : "much light is lost: ";
    const std::string both = "--sides both lets both sides emit and reflect";
    return Finding{Finding::Kind::warning,
                   how + percent(light.backs) + " of the emitted light fell on backs of faces, " +
                       percent(light.escaped) + " escaped",
                   light.backs < light.escaped
                       ? "turn the lamp to the scene or move it, or try --sides both"
                   : sides == Sides::front ? "--sides auto turns faces that look away, " + both
                                           : both};
}

} // namespace hemilux
