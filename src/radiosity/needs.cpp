#include "radiosity/needs.h"

#include "radiosity/convex_enclosure.h"
#include "radiosity/lit_facets.h"
#include "radiosity/mesh.h"
#include "radiosity/solver.h"

#include <algorithm>

namespace hemilux {
namespace {

/// So many are one leaf of the tree, tested at once; with more of them boxes pay (measured;
/// docs/results.md).
constexpr std::size_t most_triangles_without_tree = 8;
constexpr const char* few_triangles =
    "all are tested at once, as there are no more than 8 triangles "
    "(or halves of quads)";

bool is_grey(const Vec3& v) { return v.r == v.g && v.g == v.b; }
bool is_black(const Vec3& v) { return !glm::any(glm::greaterThan(v, Vec3(0.0))); }

/// By material, whether some facet is made of it.
std::vector<bool> materials_in_use(const Scene& scene) {
    std::vector<bool> used(scene.materials.size());
    for (const Facet& facet : scene.facets)
        used[facet.material] = true;
    return used;
}

/// A quad is two.
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

std::string patches(std::size_t n) { return std::to_string(n) + (n == 1 ? " patch" : " patches"); }

void add_idle_patches(const Needs& needs, const MethodWork& work, std::vector<LeftOut>& list) {
    const bool hemispheres = work.densities && needs.densities;
    if (!hemispheres && !work.pairs)
        return;
    const std::string rays = !hemispheres ? "rays"
                             : work.pairs ? "rays and densities"
                                          : "densities";
    const std::string what = rays + " of ", saved = "their " + rays;
    if (needs.black > 0)
        list.push_back({what + patches(needs.black), "they neither emit nor reflect", saved});
    if (needs.unlit > 0)
        list.push_back({what + patches(needs.unlit), "no light can reach them", saved});
}

std::vector<LeftOut> left_out_of(const Needs& needs, const MethodWork& work) {
    std::vector<LeftOut> list;
    if (!needs.colours && work.linear_systems)
        list.push_back({"two of three colour channels", "all reflectances and emissions are grey",
                        "two of three linear systems"});
    if (!needs.densities && work.densities)
        list.push_back(
            {"densities", "in a convex enclosure all are 1", "all density rays and bytes"});
    if (!needs.visibility && work.pairs)
        list.push_back({"tests of visibility", "nothing stands in a convex enclosure",
                        "all rays between two patches"});
    if (!needs.bounces && work.passes)
        list.push_back({"all passes but the first", "nothing reflects that light reaches",
                        "all steps but one, and the search for their length"});
    add_idle_patches(needs, work, list);
    if (!needs.tree)
        list.push_back({"the bounding volume hierarchy", few_triangles, "visits to boxes"});
    return list;
}

} // namespace

bool needs_tree(const Mesh& mesh) {
    return count_triangles(mesh.scene()) > most_triangles_without_tree;
}

Needs find_needs(const Mesh& mesh) {
    const Scene& scene = mesh.scene();
    const std::vector<bool> used = materials_in_use(scene);
    Needs needs;
    needs.colours = false;
    for (std::size_t m = 0; m < used.size(); ++m)
        if (used[m]) {
            const Material& material = scene.materials[m];
            needs.colours |= !is_grey(material.reflectance) || !is_grey(material.emission);
        }
    needs.closed = is_convex_enclosure(mesh);
    needs.densities = needs.visibility = !needs.closed;
    needs.tree = needs_tree(mesh);
    find_idle_patches(mesh, needs);
    return needs;
}

std::vector<LeftOut> left_out(const Needs& needs) {
    return left_out_of(needs, {true, true, true, true});
}

std::vector<LeftOut> left_out(const Needs& needs, const Method& method, const Solution& solution) {
    std::vector<LeftOut> list = left_out_of(needs, method.work);
    if (solution.unlit > 0 && solution.unlit < solution.radiosity.size())
        list.push_back({"rays of " + patches(solution.unlit) + " after the first step",
                        "no path to them from an emitter was found",
                        "their rays at random, and most of their shadow rays"});
    if (solution.rays_density_spared > 0)
        list.push_back(
            {"densities below triangles that are not divided",
             "their mean density is not above the threshold",
             std::to_string(solution.rays_density_spared) + " density rays, and as many bytes"});
    return list;
}

} // namespace hemilux
