#include "radiosity/engine/needs/find_needs.h"

#include "radiosity/engine/needs/convex_enclosure.h"
#include "radiosity/engine/needs/lit_facets.h"
#include "radiosity/paper/scene/mesh.h"

namespace hemilux {
namespace {

bool is_black(const Vec3& v) { return !glm::any(glm::greaterThan(v, Vec3(0.0))); }

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

Needs find_needs(const Mesh& mesh) {
    Needs needs;
    const Enclosure room = convex_enclosure(mesh);
    needs.closed = room == Enclosure::tight;
    needs.visibility = room == Enclosure::not_found;
    find_idle_patches(mesh, needs);
    return needs;
}

} // namespace hemilux
