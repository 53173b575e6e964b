#include "radiosity/engine/needs/find_needs.h"

#include "radiosity/engine/needs/convex_enclosure.h"
#include "radiosity/engine/needs/lit_facets.h"
#include "radiosity/engine/rays/point_emitter.h"
#include "radiosity/paper/scene/mesh.h"

#include <algorithm>

namespace hemilux {
namespace {

bool is_black(const Vec3& v) { return !glm::any(glm::greaterThan(v, Vec3(0.0))); }

/// Returns whether two channels are alike, or one is dark if `other` is Needs::dark.
bool has_solution_of(int channel, int other, const Mesh& mesh) {
    const auto emitted_alike = [&](const Vec3& v) {
        return v[channel] == (other == Needs::dark ? 0 : v[other]);
    };
    const auto patch_alike = [&](const Patch& patch) {
        const Material& material = mesh.material(patch);
        return emitted_alike(material.emission) &&
               (other == Needs::dark ||
                material.reflectance[channel] == material.reflectance[other]);
    };
    const auto emitter_alike = [&](const PointEmitter& emitter) {
        return emitted_alike(emitter.intensity);
    };
    return std::ranges::all_of(mesh.patches(), patch_alike) &&
           std::ranges::all_of(point_emitters_of(mesh.scene()), emitter_alike);
}

void find_channels(const Mesh& mesh, Needs& needs) {
    for (const int c : {0, 1, 2})
        for (const int other : {Needs::dark, 0, 1})
            if ((other < c || other == Needs::dark) && needs.solves(c) &&
                has_solution_of(c, other, mesh))
                needs.channel[static_cast<std::size_t>(c)] = other;
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

Needs find_needs(const Mesh& mesh) {
    Needs needs;
    find_channels(mesh, needs);
    const Enclosure room = convex_enclosure(mesh);
    needs.closed = room == Enclosure::tight;
    needs.visibility = room == Enclosure::not_found;
    find_idle_patches(mesh, needs);
    return needs;
}

} // namespace hemilux
