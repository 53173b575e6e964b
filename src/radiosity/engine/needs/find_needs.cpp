#include "radiosity/engine/needs/find_needs.h"

#include "radiosity/engine/needs/convex_enclosure.h"
#include "radiosity/engine/needs/lit_facets.h"
#include "radiosity/engine/rays/point_emitter.h"
#include "radiosity/paper/scene/mesh.h"

#include <algorithm>

namespace hemilux {
namespace {

bool is_grey(const Vec3& v) { return v.r == v.g && v.g == v.b; }
bool is_black(const Vec3& v) { return !glm::any(glm::greaterThan(v, Vec3(0.0))); }

/// Counts triangles; a quad counts as two.
std::size_t count_triangles(const Scene& scene) {
    std::size_t count = 0;
    for (const Facet& facet : scene.facets)
        count += facet.is_triangle() ? 1 : 2;
    return count;
}

void find_idle_patches(const Mesh& mesh, Needs& needs) {
    const std::vector<bool> lit = find_lit_patches(mesh);
    needs.idle.resize(lit.size());
    needs.bounces = false;
    for (std::uint32_t i = 0; i < lit.size(); ++i) {
        const Material& material = mesh.material(i);
        needs.bounces |= lit[i] && !is_black(material.reflectance);
        if (!is_black(material.emission))
            continue;
        needs.idle[i] = !lit[i] || is_black(material.reflectance);
        needs.unlit += !lit[i];
        needs.black += lit[i] && needs.idle[i];
    }
    if (needs.unlit + needs.black == 0)
        needs.idle.clear();
}

} // namespace

bool needs_tree(const Mesh& mesh) {
    return count_triangles(mesh.scene()) > max_triangles_without_tree;
}

Needs find_needs(const Mesh& mesh) {
    Needs needs;
    needs.colours = std::ranges::any_of(mesh.patches(), [&](const Patch& patch) {
        const Material& material = mesh.material(patch);
        return !is_grey(material.reflectance) || !is_grey(material.emission);
    });
    for (const PointEmitter& emitter : point_emitters_of(mesh.scene()))
        needs.colours |= !is_grey(emitter.intensity);
    const Enclosure room = convex_enclosure(mesh);
    needs.closed = room == Enclosure::tight;
    needs.visibility = room == Enclosure::not_found;
    needs.tree = needs_tree(mesh);
    find_idle_patches(mesh, needs);
    return needs;
}

} // namespace hemilux
