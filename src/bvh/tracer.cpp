#include "bvh/tracer.h"

namespace hemilux {

void Tracer::closest_stream(std::span<const Ray> rays, std::span<FacetHit> out) const {
    for (std::size_t k = 0; k < rays.size(); ++k)
        out[k] = facet_hit(closest(rays[k]));
}

void Tracer::occluded_stream(std::span<const Ray> rays, std::span<const std::uint32_t> targets,
                             std::span<std::uint8_t> out) const {
    for (std::size_t k = 0; k < rays.size(); ++k)
        out[k] = occluded(rays[k], targets[k]);
}

void Tracer::count_stream(std::span<const Ray> rays, std::span<std::uint32_t> out) const {
    for (std::size_t k = 0; k < rays.size(); ++k)
        out[k] = count(rays[k]);
}

Hit Tracer::locate(const Ray& ray, std::uint32_t) const { return closest(ray).value(); }

} // namespace hemilux
