#include "radiosity/engine/rays/tracer_with_panes.h"

#include "radiosity/paper/sampling/rng.h"

#include <bit>
#include <utility>

namespace hemilux {
namespace {

/// Returns a number uniform in (0,1) by the origin and the direction of a ray.
double number_of(const Ray& ray) {
    const auto bits = [](double x) { return std::bit_cast<std::uint64_t>(x); };
    return Rng(hash_words({bits(ray.origin.x), bits(ray.origin.y), bits(ray.origin.z),
                           bits(ray.direction.x), bits(ray.direction.y), bits(ray.direction.z)}))
        .uniform();
}

} // namespace

TracerWithPanes::TracerWithPanes(std::unique_ptr<Tracer> facets, const Mesh& mesh)
    : facets_(std::move(facets)), panes_(mesh) {}

/// Returns whether a ray passes the panes before a facet at distance t.
bool TracerWithPanes::goes_through(const Ray& ray, double t) const {
    const double share = passed_up_to(ray, t);
    return share == 1 || number_of(ray) < share;
}

std::optional<Hit> TracerWithPanes::closest(const Ray& ray) const {
    const std::optional<Hit> hit = facets_->closest(ray);
    return hit && goes_through(ray, hit->t) ? hit : std::nullopt;
}

bool TracerWithPanes::occluded(const Ray& ray, std::uint32_t target) const {
    return facets_->occluded(ray, target);
}

std::uint32_t TracerWithPanes::count(const Ray& ray) const { return facets_->count(ray); }

void TracerWithPanes::count_stream(std::span<const Ray> rays, std::span<std::uint32_t> out) const {
    facets_->count_stream(rays, out);
}

/// Distances are found only for rays that have a pane on their line.
void TracerWithPanes::closest_stream(std::span<const Ray> rays, std::span<FacetHit> out) const {
    facets_->closest_stream(rays, out);
    for (std::size_t k = 0; k < rays.size(); ++k)
        if (out[k].facet != none && panes_.any_on(rays[k]) &&
            !goes_through(rays[k], facets_->locate(rays[k], out[k].facet).t))
            out[k] = {};
}

void TracerWithPanes::occluded_stream(std::span<const Ray> rays,
                                      std::span<const std::uint32_t> targets,
                                      std::span<std::uint8_t> out) const {
    facets_->occluded_stream(rays, targets, out);
}

Hit TracerWithPanes::locate(const Ray& ray, std::uint32_t facet) const {
    return facets_->locate(ray, facet);
}

double TracerWithPanes::passed(const Ray& ray) const { return panes_.passed(ray); }

} // namespace hemilux
