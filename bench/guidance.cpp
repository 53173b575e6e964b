// How much the densities guide: the gain g = (error of plain / error)^2 at equal rays, over
// thresholds and depths. g = 1.2 means that progressive-monte-carlo needs 1.2 times as many energy
// rays for the same error; density rays are not counted here.
//
//     guidance SCENE.obj [RUNS]
//
// Prints a row per depth and threshold for `hemisphere`, and one per depth for `stratified`, over
// all patches, over those of the groups named detail..., and over the rest. The reference is
// `matrix`.
#include "bvh/bvh.h"
#include "io/scene_files/obj.h"
#include "radiosity/engine/solving/method.h"
#include "radiosity/engine/solving/run.h"
#include "radiosity/paper/scene/mesh.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <vector>

using namespace hemilux;

namespace {

struct Bench {
    Mesh mesh;
    Bvh bvh;
    std::vector<Vec3> reference;
    std::vector<bool> detail;
    int runs;

    Bench(const std::string& path, int wanted_runs)
        : mesh(read_obj(path).scene), bvh(mesh.soup()), runs(wanted_runs) {
        for (const Patch& patch : mesh.patches())
            detail.push_back(
                mesh.scene().groups[mesh.scene().facets[patch.facet].group].starts_with("detail"));
        reference = solve("matrix", {}, {.steps = {}, .seconds = {}, .error = .002}).radiosity;
    }

    [[nodiscard]] Solution solve(const char* method, const SolveOptions& options,
                                 const StopRule& stop) const {
        Monitor monitor;
        const SolverInput input{mesh, bvh, options, monitor};
        const auto solver = find_method(method)->make(input);
        run(*solver, input, stop);
        return solver->solution();
    }

    /// Mean over the runs of squared error times rays.
    [[nodiscard]] RelativeError cost(const char* method, int depth, double threshold) const {
        RelativeError sum;
        for (int k = 0; k < runs; ++k) {
            SolveOptions options;
            options.depth = depth;
            options.threshold = threshold;
            options.seed = 1000 + static_cast<std::uint64_t>(k);
            const Solution s = solve(method, options, {.steps = 32, .seconds = {}, .error = {}});
            const RelativeError e = true_error(mesh, s.radiosity, reference, detail);
            const double rays = static_cast<double>(s.rays_energy) / runs;
            sum.all += rays * e.all * e.all;
            sum.detail += rays * e.detail * e.detail;
            sum.rest += rays * e.rest * e.rest;
        }
        return sum;
    }
};

void print_row(const char* method, int depth, const char* threshold, const RelativeError& plain,
               const RelativeError& cost) {
    std::printf("%-12s %5d %9s %6.2f %7.2f %6.2f\n", method, depth, threshold, plain.all / cost.all,
                plain.detail / cost.detail, plain.rest / cost.rest);
    std::fflush(stdout);
}

} // namespace

int main(int argc, char** argv) try {
    if (argc < 2) {
        std::fputs("usage: guidance SCENE.obj [RUNS]\n", stderr);
        return 1;
    }
    const Bench bench(argv[1], argc > 2 ? std::max(1, std::atoi(argv[2])) : 8);
    const RelativeError plain = bench.cost("progressive-monte-carlo", 0, 0);
    std::puts("method       depth threshold  g all  detail   rest");
    for (const int depth : {1, 2, 3})
        print_row("stratified", depth, "-", plain, bench.cost("stratified", depth, 0));
    for (const int depth : {1, 2, 3})
        for (const char* threshold : {"0", "1", "2", "3"})
            print_row("hemisphere", depth, threshold, plain,
                      bench.cost("hemisphere", depth, std::atof(threshold)));
    return 0;
} catch (const std::exception& error) {
    std::fprintf(stderr, "guidance: %s\n", error.what());
    return 2;
}
