#include "radiosity/engine/rays/panes.h"

#include "radiosity/paper/scene/mesh.h"

#include <algorithm>

namespace hemilux {
namespace {

/// Crossings that lie nearer to each other, or to an end of the ray, are in one place [local
/// units]. Faces that exporters write for both sides of a pane differ by rounding alone.
constexpr double one_place = 1e-9;

Bvh tree_of(const std::vector<Polygon>& panes) {
    std::vector<Vec3> vertices;
    std::vector<FacetCorners> facets;
    for (const Polygon& pane : panes) {
        const auto first = static_cast<std::uint32_t>(vertices.size());
        const std::uint32_t last = pane.is_triangle() ? 2 : 3;
        facets.push_back({first, first + 1, first + 2, first + last});
        vertices.insert(vertices.end(), pane.corner.begin(), pane.corner.end());
    }
    return Bvh({vertices, facets});
}

/// Returns the ray without what is nearer to its ends.
Ray between_ends(const Ray& ray, double gap) {
    return {.origin = ray.origin,
            .direction = ray.direction,
            .t_max = ray.t_max - gap,
            .t_min = std::max(ray.t_min, gap)};
}

double gap_of(const Ray& ray) { return one_place / glm::length(ray.direction); }

} // namespace

std::span<const Pane> panes_of(const Scene& scene) {
    return scene.panes ? std::span<const Pane>(*scene.panes) : std::span<const Pane>{};
}

std::vector<Polygon> local_panes(const Mesh& mesh) {
    std::vector<Polygon> shapes;
    for (const Pane& pane : panes_of(mesh.scene())) {
        Polygon& shape = shapes.emplace_back();
        for (std::size_t c = 0; c < shape.corner.size(); ++c)
            shape.corner[c] = mesh.frame().to_local(pane.corner[c]);
    }
    return shapes;
}

PaneCrossings::PaneCrossings(const Mesh& mesh) : tree_(tree_of(local_panes(mesh))) {
    for (const Pane& pane : panes_of(mesh.scene()))
        transmittance_.push_back(pane.transmittance);
}

double PaneCrossings::passed(const Ray& ray) const {
    const double gap = gap_of(ray);
    Ray rest = between_ends(ray, gap);
    double share = 1;
    while (const auto hit = tree_.closest(rest)) {
        share *= transmittance_[hit->facet];
        rest.t_min = hit->t + gap;
    }
    return share;
}

bool PaneCrossings::any_on(const Ray& ray) const {
    return tree_.occluded(between_ends(ray, gap_of(ray)));
}

} // namespace hemilux
