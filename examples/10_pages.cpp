// All methods of the paper, each by its page, in a white furnace.
//
// Shows: a closed room whose walls all emit 1 and reflect one half has the radiosity
// E / (1 - rho) = 2 everywhere, by whatever method. The full matrix is solved once, progressive
// radiosity shoots until nearly nothing is unshot, and the others take the mean of four steps.
// Prints: a row for each section of the paper with the mean radiosity, the rays and the largest
// error of a patch. The mean is 2 but for chance and for a little light that is not shot. The
// largest error shows what the mean hides: by the printed rules it does not vanish with more rays.

#include "bvh/bvh.h"
#include "radiosity/paper/pages/pages.h"
#include "radiosity/paper/scene/mesh.h"
#include "radiosity/paper/solving/solver.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <memory>

using namespace hemilux;

namespace {

/// The inside of the unit cube, n x n squares a side, all of one material.
Scene furnace(std::uint32_t n) {
    Scene scene;
    scene.materials.push_back({"wall", Vec3(.5), Vec3(1.0)});
    scene.groups.push_back("room");
    const auto add_side = [&](const Vec3& corner, const Vec3& u, const Vec3& v) {
        for (std::uint32_t i = 0; i < n; ++i)
            for (std::uint32_t j = 0; j < n; ++j) {
                const auto first = static_cast<std::uint32_t>(scene.vertices.size());
                for (const auto& [s, t] :
                     {std::array{i, j}, {i + 1, j}, {i + 1, j + 1}, {i, j + 1}})
                    scene.vertices.push_back(corner + (double(s) * u + double(t) * v) / double(n));
                scene.facets.push_back(
                    {{first, first + 1, first + 2, first + 3}, scene.faces++, 0, 0});
            }
    };
    const Vec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1), o(0.0);
    add_side(o, x, y), add_side(o, y, z), add_side(o, z, x); // each normal, u x v, looks inside
    add_side(z, y, x), add_side(x, z, y), add_side(y, x, z);
    return scene;
}

struct Page {
    const char* name;
    std::unique_ptr<Solver> (*make)(const SolverInput&);
    int steps;            ///< 0: until it is finished
    bool literal = false; ///< by the rules as printed
};
constexpr std::array<Page, 8> pages{
    {{"2    the full matrix", plain::matrix, 1},
     {"3.1  progressive", plain::progressive, 0},
     {"3.2  Monte Carlo", plain::monte_carlo, 4},
     {"3.3  progressive Monte Carlo", plain::progressive_monte_carlo, 4},
     {"4    hemisphere of 1997", plain::hemisphere_1997, 4},
     {"4    as printed", plain::hemisphere_1997, 4, true},
     {"5    hemisphere", plain::hemisphere, 4},
     {"5    as printed", plain::hemisphere, 4, true}}};

} // namespace

int main() {
    const Mesh mesh(furnace(3));
    const Bvh bvh(mesh.soup());
    std::printf("section and method             mean B      rays  largest error of a patch\n");
    bool good = true;
    for (const Page& page : pages) {
        SolveOptions options;
        options.rays = 64;
        options.literal = page.literal;
        Monitor monitor;
        const auto solver = page.make({mesh, bvh, options, monitor});
        for (int k = 0; page.steps > 0 ? k < page.steps : !solver->finished(); ++k)
            solver->step();
        const Solution& solution = solver->solution();
        double mean = 0, largest = 0;
        for (const Vec3& B : solution.radiosity) {
            mean += B.y / double(solution.radiosity.size());
            largest = std::max(largest, std::abs(B.y - 2) / 2);
        }
        std::printf("%-29s %7.4f %9llu %8.2f %%\n", page.name, mean,
                    static_cast<unsigned long long>(solution.rays_energy + solution.rays_density),
                    100 * largest);
        good = good && std::abs(mean - 2) < (page.literal ? .2 : .01);
    }
    return good ? 0 : 1;
}
