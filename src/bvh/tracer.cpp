#include "bvh/tracer.h"

namespace hemilux {
namespace {

FacetHit hit_record_of(const Tracer& tracer, const Ray& ray) {
    const auto hit = tracer.closest(ray);
    return hit ? FacetHit{hit->facet, hit->front} : FacetHit{};
}

} // namespace

void Tracer::closest_stream(std::span<const Ray> rays, std::span<FacetHit> out) const {
    for (std::size_t k = 0; k < rays.size(); ++k)
        out[k] = hit_record_of(*this, rays[k]);
}

void Tracer::occluded_stream(std::span<const Ray> rays, std::span<const std::uint32_t> targets,
                             std::span<std::uint8_t> out) const {
    for (std::size_t k = 0; k < rays.size(); ++k)
        out[k] = occluded(rays[k], targets[k]);
}

Hit Tracer::locate(const Ray& ray, std::uint32_t) const { return closest(ray).value(); }

} // namespace hemilux
