// The paper's own experiment (section 6, figures 7 to 10): pictures after 3 and after 17 steps,
// classical beside new, and what it is about them that can be measured:
//     07_paper_section_6 [SCENE.obj [FOLDER [RUNS]]]
//
// Shows: several methods side by side, step by step, against a reference on the same patches.
// Prints: for each method after 3 and after 17 steps its rays and seconds, preprocessing included,
// its mean square error in the detailed regions and in the others relative to the classical method,
// and its memory, as a table in Markdown. FOLDER gets the pictures.

#include "bvh/wide/wide_bvh.h"
#include "io/pictures/picture_files.h"
#include "io/scene_files/obj.h"
#include "radiosity/answers/pictures/render.h"
#include "radiosity/engine/solving/method.h"
#include "radiosity/engine/solving/run.h"
#include "radiosity/paper/scene/mesh.h"

#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

using namespace hemilux;

namespace {

/// The paper does not say how many. With fewer than there are triangles, the printed rule rounds
/// most N_tr to 0.
constexpr double rays_per_step = 64;
constexpr std::array<std::uint32_t, 2> shown_steps = {3, 17};
constexpr double reference_error = .005;

struct Contender {
    const char* name; ///< of its pictures
    const char* method;
    bool literal;
    int max_runs = 1000;
};
constexpr std::array<Contender, 4> contenders = {{{"classical", "progressive-monte-carlo", false},
                                                  {"new", "hemisphere", false},
                                                  {"1997", "hemisphere-1997", false},
                                                  {"new-as-printed", "hemisphere", true, 1}}};

/// Sums over the runs, for one contender after so many steps.
struct Measured {
    int runs = 0;
    double rays = 0, seconds = 0, detail = 0, rest = 0;
    std::uint64_t bytes = 0;
    std::vector<Vec3> radiosity; ///< of the first run
};
using Table = std::array<std::array<Measured, shown_steps.size()>, contenders.size()>;

std::vector<bool> detail_of(const Mesh& mesh) {
    std::vector<bool> detail;
    for (const Patch& patch : mesh.patches()) {
        const Scene& scene = mesh.scene();
        detail.push_back(scene.groups[scene.facets[patch.facet].group].starts_with("detail"));
    }
    return detail;
}

std::vector<Vec3> reference(const Mesh& mesh, const Tracer& tracer) {
    const SolveOptions options;
    Monitor monitor;
    const SolverInput input{mesh, tracer, options, monitor};
    const auto solver = find_method("matrix")->make(input);
    run(*solver, input, {.steps = {}, .seconds = {}, .error = reference_error});
    return solver->solution().radiosity;
}

/// One run of one contender, whose figures are added to the table's row.
void measure(const Contender& contender, const Mesh& mesh, const Tracer& tracer, std::uint64_t seed,
             const std::vector<Vec3>& truth, std::array<Measured, shown_steps.size()>& row) {
    SolveOptions options;
    options.rays = rays_per_step;
    options.seed = seed;
    options.literal = contender.literal;
    const std::vector<bool> detail = detail_of(mesh);
    Monitor monitor;
    const SolverInput input{mesh, tracer, options, monitor};
    const auto start = std::chrono::steady_clock::now();
    const auto solver = find_method(contender.method)->make(input);
    const auto after_step = [&](const StepRecord& record, const Solution& solution) {
        const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
        for (std::size_t k = 0; k < shown_steps.size(); ++k) {
            if (record.step != shown_steps[k])
                continue;
            const RelativeError error = true_error(mesh, solution.radiosity, truth, detail);
            ++row[k].runs;
            row[k].rays += static_cast<double>(record.rays);
            row[k].seconds += seconds.count();
            row[k].detail += error.detail * error.detail;
            row[k].rest += error.rest * error.rest;
            row[k].bytes = solution.bytes_density;
            if (row[k].radiosity.empty())
                row[k].radiosity = solution.radiosity;
        }
    };
    run(*solver, input, {.steps = shown_steps.back(), .seconds = {}, .error = {}}, after_step);
}

void print(const Table& table, const Mesh& mesh) {
    const auto patches = static_cast<double>(mesh.patches().size());
    std::printf("%.0f patches, %.0f rays per patch and step\n\n", patches, rays_per_step);
    std::printf(
        "| method | steps | runs | rays a patch | seconds | detail: error, MSE / classical | rest: "
        "error, MSE / classical | bytes a patch |\n|---|---|---|---|---|---|---|---|\n");
    for (std::size_t k = 0; k < shown_steps.size(); ++k)
        for (std::size_t c = 0; c < contenders.size(); ++c) {
            const Measured& m = table[c][k];
            const Measured& classical = table[0][k];
            const double n = m.runs, runs_ratio = classical.runs / n;
            std::printf("| %s | %u | %d | %.1f | %.3f | %.1f %%, %.2f | %.2f %%, %.2f | %.0f |\n",
                        contenders[c].name, shown_steps[k], m.runs, m.rays / n / patches,
                        m.seconds / n, 100 * std::sqrt(m.detail / n),
                        m.detail / classical.detail * runs_ratio, 100 * std::sqrt(m.rest / n),
                        m.rest / classical.rest * runs_ratio,
                        static_cast<double>(m.bytes) / patches);
        }
}

/// One view and one exposure for all, and the reference beside them.
void draw(const Table& table, const Mesh& mesh, const Tracer& tracer,
          const std::vector<Vec3>& truth, const std::filesystem::path& folder) {
    const RenderOptions size{.width = 640, .height = 480};
    std::filesystem::create_directories(folder);
    const Camera camera = automatic_camera(mesh, tracer, truth, double(size.width) / size.height);
    const Image best = render(mesh, tracer, truth, camera, size);
    const double exposure = auto_exposure(best);
    write_png((folder / "reference.png").string(), best, exposure);
    for (std::size_t c = 0; c < contenders.size(); ++c)
        for (std::size_t k = 0; k < shown_steps.size(); ++k) {
            const std::string name =
                contenders[c].name + ("-" + std::to_string(shown_steps[k])) + ".png";
            write_png((folder / name).string(),
                      render(mesh, tracer, table[c][k].radiosity, camera, size), exposure);
        }
    std::printf("\nwrote the pictures to %s\n", folder.string().c_str());
}

int experiment(const char* scene, const char* folder, int runs) {
    const Mesh mesh(read_obj(scene).scene);
    const WideBvh bvh(mesh.soup());
    const std::vector<Vec3> truth = reference(mesh, bvh);
    Table table;
    for (int r = 0; r < runs; ++r) // the contenders take turns, so that none has the quiet hours
        for (std::size_t c = 0; c < contenders.size(); ++c)
            if (r < contenders[c].max_runs)
                measure(contenders[c], mesh, bvh, static_cast<std::uint64_t>(r + 1), truth,
                        table[c]);
    print(table, mesh);
    draw(table, mesh, bvh, truth, folder);
    // What must hold whatever the scene: an unbiased method's error falls, the printed one's
    // hardly.
    const auto fall = [&](std::size_t c) { return table[c][0].rest / table[c][1].rest; };
    return fall(0) > 3 && fall(1) > 3 && fall(3) < 3 ? 0 : 1;
}

} // namespace

int main(int argc, char** argv) {
    try {
        return experiment(argc > 1 ? argv[1] : "examples/scenes/room_1002.obj",
                          argc > 2 ? argv[2] : "paper_section_6",
                          argc > 3 ? std::atoi(argv[3]) : 4);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "07_paper_section_6: %s\n", error.what());
        return 1;
    }
}
