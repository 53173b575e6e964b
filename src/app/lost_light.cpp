#include "app/lost_light.h"

#include "app/text.h"

#include <algorithm>

namespace hemilux {

namespace {

bool anything_is_lit(const Mesh& mesh, std::span<const Vec3> radiosity) {
    for (std::uint32_t i = 0; i < radiosity.size(); ++i)
        if (glm::any(glm::greaterThan(radiosity[i], mesh.material(i).emission)))
            return true;
    return false;
}

bool anything_reflects(const Mesh& mesh) {
    return std::ranges::any_of(mesh.scene().facets, [&](const Facet& facet) {
        return mesh.scene().materials[facet.material].reflectance != Vec3(0.0);
    });
}

} // namespace

std::string lost_light_text(const Mesh& mesh, std::span<const Vec3> radiosity,
                            const LightShares& light, Sides sides) {
    constexpr double nearly_all = 0.9;
    const bool lit = anything_is_lit(mesh, radiosity);
    if (lit && light.backs + light.escaped <= nearly_all)
        return "";
    if (!lit && !anything_reflects(mesh))
        return "nothing is lit: all reflectances are 0; --reflectance 'MATERIAL=R,G,B' changes "
               "them";
    std::string text = (lit ? "hardly anything is lit: " : "nothing is lit: ") +
                       percent(light.backs) + " of the emitted light fell on backs of faces, " +
                       percent(light.escaped) + " left the scene; ";
    if (light.backs < light.escaped)
        return text + "turn the lamp to the scene or move it, or try --sides both";
    return text + (sides == Sides::front ? "--sides auto turns faces that look away, --sides both "
                                           "lets both sides emit and reflect"
                                         : "--sides both lets both sides emit and reflect");
}

} // namespace hemilux
