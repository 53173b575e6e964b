// Shows the methods of the paper side by side, each by its page, in a furnace: in a closed room
// whose walls all emit 1 and reflect one half, the radiosity is 1 / (1 - 0.5) = 2 everywhere.
//
//   examples/10_pages
//
// It prints the mean radiosity, the root mean square of what patches are off, as it is and as the
// method estimates it, the number of rays, and a hash of all bits of the radiosity, which is the
// same on every machine. It stands on the storey of the paper alone.
#include "bvh/bvh.h"
#include "radiosity/paper/pages/pages.h"
#include "radiosity/paper/scene/mesh.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>

using namespace hemilux;

namespace {

/// A cube from the inside, n x n quads a side.
Scene furnace(std::uint32_t n) {
    Scene scene;
    scene.materials = {{.name = "wall", .reflectance = Vec3(0.5), .emission = Vec3(1.0)}};
    scene.groups = {"room"};
    const auto add_side = [&](const Vec3& corner, const Vec3& x, const Vec3& y) {
        const auto first = static_cast<std::uint32_t>(scene.vertices.size());
        for (std::uint32_t j = 0; j <= n; ++j)
            for (std::uint32_t i = 0; i <= n; ++i)
                scene.vertices.push_back(corner + (double(i) * x + double(j) * y) / double(n));
        for (std::uint32_t j = 0; j < n; ++j)
            for (std::uint32_t i = 0; i < n; ++i) {
                const std::uint32_t a = first + j * (n + 1) + i, c = a + n + 2;
                scene.facets.push_back({{a, a + 1, c, c - 1}, scene.faces++, 0, 0});
            }
    };
    const Vec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
    add_side({0, 0, 0}, x, y), add_side({0, 0, 1}, y, x);
    add_side({0, 0, 0}, y, z), add_side({1, 0, 0}, z, y);
    add_side({0, 0, 0}, z, x), add_side({0, 1, 0}, x, z);
    return scene;
}

/// FNV-1a of Fowler, Noll and Vo.
std::uint64_t hash_of(const std::vector<Vec3>& radiosity) {
    std::uint64_t hash = 0xcbf29ce484222325;
    for (const Vec3& B : radiosity)
        for (int c = 0; c < 3; ++c) {
            std::uint64_t bits;
            std::memcpy(&bits, &B[c], sizeof bits);
            for (int byte = 0; byte < 8; ++byte) {
                hash ^= bits >> (8 * byte) & 0xff;
                hash *= 0x100000001b3;
            }
        }
    return hash;
}

struct Page {
    const char* section;
    const char* name;
    std::unique_ptr<Solver> (*make)(const SolverInput&);
    std::uint32_t steps;
};
constexpr std::array<Page, 6> pages{{
    {"2", "matrix", plain::matrix, 1},
    {"3.1", "progressive", plain::progressive, 200}, // a step is one shot
    {"3.2", "monte-carlo", plain::monte_carlo, 8},
    {"3.3", "progressive-monte-carlo", plain::progressive_monte_carlo, 8},
    {"4", "hemisphere-1997", plain::hemisphere_1997, 8},
    {"5", "hemisphere", plain::hemisphere, 8},
}};

} // namespace

int main() {
    const Mesh mesh(furnace(2));
    const Bvh tree(mesh.soup());
    std::printf("section  method                   mean B   off [%%]  estimated      rays  hash\n");
    bool right = true;
    for (const Page& page : pages) {
        const SolveOptions options{.rays = 64};
        Monitor monitor;
        const SolverInput input{mesh, tree, options, monitor};
        const auto solver = page.make(input);
        for (std::uint32_t step = 0; step < page.steps && !solver->finished(); ++step)
            if (!solver->step())
                return 1;
        const Solution& solution = solver->solution();
        const std::vector<Vec3> truth(solution.radiosity.size(), Vec3(2.0));
        double mean = 0;
        for (const Vec3& B : solution.radiosity)
            mean += B.x / double(truth.size());
        const double off = true_error(mesh, solution.radiosity, truth).all,
                     estimated = estimated_error(mesh, solution);
        std::printf("%-7s  %-23s  %.4f  %7.2f  %9.2f  %8llu  %016llx\n", page.section, page.name,
                    mean, 100 * off, 100 * estimated,
                    static_cast<unsigned long long>(solution.rays_energy + solution.rays_density),
                    static_cast<unsigned long long>(hash_of(solution.radiosity)));
        right = right && std::abs(mean - 2) < 0.05 && off < 3 * estimated;
    }
    std::printf("%s\n", right ? "all as expected" : "NOT as expected: B = 2 everywhere");
    return right ? 0 : 1;
}
