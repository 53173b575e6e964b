// The density of a patch (paper section 5a, preprocessing).
//
// Shows: a floor patch that looks at a stack of four squares on its left, and elsewhere at nothing.
// Rays through the vertices of its hemisphere count surfaces; a triangle whose mean count exceeds
// the threshold is divided.
// Prints: each triangle that is left, its level, mean density and solid angle, and what is kept in
// all. Octants without the stack stay whole.

#include "bvh/wide/wide_bvh.h"
#include "parallel/workers.h"
#include "radiosity/engine/densities/density.h"
#include "radiosity/paper/scene/mesh.h"
#include "radiosity/paper/solving/solver.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

using namespace hemilux;

namespace {

Scene stack_beside_a_patch() {
    Scene scene;
    scene.materials.push_back({});
    scene.groups.push_back("scene");
    const auto add = [&scene](const Vec3& corner, const Vec3& u, const Vec3& v) {
        const auto first = static_cast<std::uint32_t>(scene.vertices.size());
        for (const Vec3& p : {corner, corner + u, corner + u + v, corner + v})
            scene.vertices.push_back(p);
        scene.facets.push_back({{first, first + 1, first + 2, first + 3}, scene.faces++, 0, 0});
    };
    add({-.5, -.5, 0}, {1, 0, 0}, {0, 1, 0}); // the patch, facing +z
    for (int i = 0; i < 4; ++i)
        add({-1.5 - 0.2 * i, -2, 0}, {0, 4, 0}, {0, 0, 2}); // facing it
    return scene;
}

} // namespace

int main() {
    const Mesh mesh(stack_beside_a_patch());
    const WideBvh bvh(mesh.soup());
    const Hemisphere hemisphere(2);
    Monitor monitor;
    const DensityMap densities(mesh, bvh, hemisphere, 0.5, Workers(1), monitor);
    std::vector<DensityLeaf> leaves;
    densities.leaves(0, leaves);

    std::printf("level  density  solid angle [sr]\n");
    double densest = 0;
    double solid_angle = 0;
    for (const DensityLeaf& leaf : leaves) {
        const Hemisphere::Cell& cell = hemisphere.cells()[leaf.cell];
        std::printf("%5d  %7.3f  %16.5f\n", cell.level, leaf.density, cell.solid_angle);
        densest = std::max(densest, leaf.density);
        solid_angle += cell.solid_angle;
    }
    std::printf("%zu triangles cover %.6f sr (2 pi); the densest holds %g surfaces per ray\n",
                leaves.size(), solid_angle, densest);
    std::printf("%llu bytes for %zu patches\n", static_cast<unsigned long long>(densities.bytes()),
                mesh.patches().size());
    const bool partly_divided = leaves.size() > 4 && leaves.size() < 64;
    return partly_divided && std::abs(solid_angle - 2 * std::numbers::pi) < 1e-9 && densest > 0 ? 0
                                                                                                : 1;
}
