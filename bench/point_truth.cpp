// The light at random points of a scene's surfaces by paths of rays (path_reference.h), against
// which scripts/gathered_errors.py holds what `solve --points` gives out.
//
//     hemilux_point_truth SCENE --points 2000 --paths 4096 --points-output points.txt > truth.csv

#include "app/command_line/arguments.h"
#include "app/command_line/option_kinds.h"
#include "app/loading/load.h"
#include "app/loading/sides.h"
#include "parallel/workers.h"
#include "path_reference.h"
#include "radiosity/engine/needs/find_needs.h"
#include "radiosity/engine/rays/make_tracer.h"

#include <cstdio>
#include <ctime>
#include <string>
#include <vector>

using namespace hemilux;
using namespace hemilux::bench;

namespace {

struct Settings {
    std::string scene, points_output;
    std::size_t points = 2000, paths = 4096;
    std::uint64_t seed = 1;
};

struct Truth {
    Vec3 first, second;
};

void measure(const Settings& settings) {
    SceneSettings scene;
    scene.path = settings.scene;
    ReadResult read = load_scene(scene, {});
    const Mesh mesh = divide_with_sides(std::move(read.scene), scene, {}, Verbosity::quiet).mesh;
    const MadeTracer made = make_tracer(mesh);
    const std::vector<PatchPoint> points =
        PointsOverSurface(mesh).draw(settings.points, settings.seed);
    std::FILE* const file = std::fopen(settings.points_output.c_str(), "w");
    for (const PatchPoint& point : points) {
        const Vec3 at = mesh.frame().to_world(point.at.position), n = point.at.normal;
        std::fprintf(file, "%.17g,%.17g,%.17g,%.17g,%.17g,%.17g\n", at.x, at.y, at.z, n.x, n.y,
                     n.z);
    }
    std::fclose(file);
    const PathReference reference(mesh, *made.tracer);
    std::vector<Truth> truths(points.size());
    const std::clock_t start = std::clock();
    Workers(0).for_chunks(points.size(), 4, [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k) {
            std::mt19937_64 numbers(settings.seed + k);
            truths[k].first = reference.irradiance(points[k].at, settings.paths, numbers);
            truths[k].second = reference.irradiance(points[k].at, settings.paths, numbers);
        }
    });
    const double seconds = double(std::clock() - start) / CLOCKS_PER_SEC;
    for (const auto& [a, b] : truths)
        std::printf("%.9g,%.9g,%.9g,%.9g,%.9g,%.9g\n", a.x, a.y, a.z, b.x, b.y, b.z);
    std::fprintf(stderr, "%zu paths at each of %zu points, twice: %.3g s of processor time\n",
                 settings.paths, points.size(), seconds);
}

} // namespace

int main(int count, char** words) {
    Settings settings;
    try {
        Arguments arguments("hemilux_point_truth", "Finds light at points by paths of rays.");
        const Command command = arguments.program();
        command.add_text("--scene", "FILE", settings.scene, "scene");
        command.add_text("--points-output", "FILE", settings.points_output,
                         "table of the points, as for solve --points");
        add_whole(command, "--points", settings.points, 1, 10'000'000, "points");
        add_whole(command, "--paths", settings.paths, 1, 1'000'000, "at each point, twice");
        const std::string help = arguments.parse({words + 1, words + count});
        std::fputs(help.c_str(), stdout);
        if (help.empty())
            measure(settings);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
    return 0;
}
