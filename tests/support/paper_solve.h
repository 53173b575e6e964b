#pragma once
// A mesh with the reading tree, and a run of a page over it: all of the paper's storey.

#include "bvh/bvh.h"
#include "radiosity/paper/pages/pages.h"
#include "radiosity/paper/scene/mesh.h"

#include <array>
#include <cstdint>
#include <memory>
#include <utility>

namespace hemilux::test {

struct PaperModel {
    Mesh mesh;
    Bvh bvh;
    explicit PaperModel(Scene scene, const MeshOptions& options = {})
        : mesh(std::move(scene), options), bvh(mesh.soup()) {}
};

struct Page {
    const char* name;
    std::unique_ptr<Solver> (*make)(const SolverInput&);
    bool has_literal = false;
    bool has_densities = false;
};

/// The pages whose steps are independent solutions of all bounces.
inline constexpr std::array<Page, 4> pages_of_steps{
    {{"section 3.2", plain::monte_carlo},
     {"section 3.3", plain::progressive_monte_carlo},
     {"section 4", plain::hemisphere_1997, true, true},
     {"section 5", plain::hemisphere, true, true}}};

/// The solution after so many steps, with rays traced by `tracer`.
[[nodiscard]] inline Solution solve_page(const Mesh& mesh, const Tracer& tracer, const Page& page,
                                         const SolveOptions& options, std::uint32_t steps) {
    Monitor monitor;
    const auto solver = page.make({mesh, tracer, options, monitor});
    for (std::uint32_t step = 0; step < steps; ++step)
        (void)solver->step();
    return solver->solution();
}

[[nodiscard]] inline Solution solve_page(const PaperModel& model, const Page& page,
                                         const SolveOptions& options, std::uint32_t steps) {
    return solve_page(model.mesh, model.bvh, page, options, steps);
}

} // namespace hemilux::test
