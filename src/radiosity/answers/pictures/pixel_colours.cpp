#include "radiosity/answers/pictures/pixel_colours.h"

#include "radiosity/paper/scene/mesh.h"

#include <array>
#include <cmath>

namespace hemilux {

Colours pixel_colours(const Mesh& mesh, const VisibleFacets& visible, std::uint32_t half,
                      std::uint32_t patch, const Vec2& place) {
    const Material& of_patch = mesh.material(patch);
    const Colours mean{of_patch.reflectance, of_patch.emission};
    if (!mesh.scene().colours_vary_on(mesh.patches()[patch].material))
        return mean;
    constexpr std::array<Vec2, 4> corners{Vec2(-.5, -.5), Vec2(.5, -.5), Vec2(.5, .5),
                                          Vec2(-.5, .5)};
    std::array<Vec2, 4> on_facet{};
    for (std::size_t k = 0; k < corners.size(); ++k) {
        const Hit hit = visible.hit_at(half, visible.direction(place + corners.at(k)));
        if (!(hit.t > 0) || !std::isfinite(hit.u + hit.v))
            return mean;
        on_facet.at(k) = {hit.u, hit.v};
    }
    return colours_over(mesh.scene(), half / 2, half % 2 == 1, on_facet);
}

} // namespace hemilux
