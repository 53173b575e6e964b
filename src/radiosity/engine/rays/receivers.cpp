#include "radiosity/engine/rays/receivers.h"

#include "radiosity/paper/scene/mesh.h"

#include <algorithm>
#include <array>

namespace hemilux {

void find_receivers(std::span<const Ray> rays, const Mesh& mesh, const Tracer& tracer,
                    std::vector<std::uint32_t>& receivers) {
    std::array<FacetHit, 256> hits; // few, as each call fills it with its defaults
    const std::size_t before = receivers.size();
    receivers.resize(before + rays.size());
    std::uint32_t* receiver = receivers.data() + before;
    while (!rays.empty()) {
        const std::size_t n = std::min(rays.size(), hits.size());
        tracer.closest_stream(rays.first(n), std::span(hits).first(n));
        for (std::size_t k = 0; k < n; ++k) {
            const auto [facet, front] = hits[k];
            std::uint32_t patch = none;
            if (facet != none)
                patch = mesh.is_divided(facet) ? mesh.patch_at(tracer.locate(rays[k], facet))
                                               : mesh.patch_of(facet, front);
            *receiver++ = facet == none ? escaped : patch == none ? absorbed : patch;
        }
        rays = rays.subspan(n);
    }
}

} // namespace hemilux
