// A furnace: a closed L-shaped room, everything reflects rho = .5 and emits E = 1.
//
// Shows: whatever the shape, every patch must have B = E / (1 - rho) = 2. A mean over the room
// would not see a wrong law of directions; its patches do. Every method is tried. Prints: for each
// method the rays, the mean of B, the largest miss of any patch, and how many standard errors the
// largest is. None may exceed 5.

#include "bvh/wide/wide_bvh.h"
#include "io/scene_files/obj.h"
#include "radiosity/engine/solving/method.h"
#include "radiosity/engine/solving/run.h"
#include "radiosity/paper/scene/mesh.h"

#include <cmath>
#include <cstdio>

int main() {
    using namespace hemilux;
    const Mesh mesh(read_obj("examples/scenes/furnace_lshape.obj").scene);
    const WideBvh bvh(mesh.soup());
    constexpr double expected = 2, max_standard_errors = 5, rounding = 1e-9;
    SolveOptions options;
    bool good = true;
    std::printf("%-24s      rays   mean B  largest miss  in standard errors\n", "method");
    for (const Method* method : methods()) {
        Monitor monitor;
        const SolverInput input{mesh, bvh, options, monitor};
        const auto solver = method->make(input);
        StopRule stop = method->default_stop;
        if (stop.steps)
            stop.steps = 64; // enough for the standard errors to be known well
        run(*solver, input, stop);

        const Solution& solution = solver->solution();
        double sum = 0, largest_miss = 0, max_errors = 0;
        for (std::size_t i = 0; i < mesh.patches().size(); ++i) {
            const double b = solution.radiosity[i].x, miss = std::abs(b - expected);
            sum += b;
            largest_miss = std::max(largest_miss, miss);
            if (miss > rounding)
                max_errors = std::max(max_errors, miss / solution.standard_error[i].x);
        }
        std::printf("%-24.*s %9llu  %7.5f  %12.2g  %8.2f\n", static_cast<int>(method->name.size()),
                    method->name.data(), static_cast<unsigned long long>(solution.rays_energy),
                    sum / static_cast<double>(mesh.patches().size()), largest_miss, max_errors);
        good = good && max_errors < max_standard_errors && largest_miss < 0.5;
    }
    return good ? 0 : 1;
}
