// How far the whole error that `solve --divide auto` reports can be trusted, and what it costs: the
// light as given out against paths of rays (path_reference.h) at points of the surfaces.
//
//     hemilux_division_truth --scene examples/scenes/room_1002.obj --error 0.1,0.05,0.02 --seeds 10
//
// With --for or --camera both errors are those of a target.

#include "app/command_line/option_groups.h"
#include "app/command_line/option_kinds.h"
#include "app/division/whole_error.h"
#include "app/loading/load.h"
#include "app/loading/sides.h"
#include "app/running/run_target.h"
#include "division_families.h"
#include "parallel/workers.h"
#include "path_reference.h"
#include "radiosity/answers/division/whole_error.h"
#include "radiosity/engine/rays/make_tracer.h"
#include "radiosity/light/cached_light/patch_light.h"
#include "radiosity/light/layers/layered_mesh.h"
#include "radiosity/paper/sampling/rng.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <random>
#include <string>
#include <vector>

using namespace hemilux;
using namespace hemilux::bench;

namespace {

struct Settings {
    std::vector<std::string> scenes, families, asked{"0.05"};
    std::size_t seeds = 10, points = 10000, paths = 256;
    double max_edge = 0;             ///< 0: --divide auto
    std::vector<std::string> groups; ///< that are the target
    ViewSettings view;               ///< whose picture is the target too, where it has a camera
    bool for_all = false;            ///< runs know of no target
    unsigned threads = 0;
    bool every_run = false;
};

/// Where the truth is known: a point of a facet, whatever patch holds it.
struct TruthPoint {
    Hit hit;
    SurfacePoint at;
    double area;        ///< that it stands for, in any unit
    Vec3 first, second; ///< reflected light [W/m2] by paths, twice independently
};

/// A facet's half, as a hit on it is given.
struct Half {
    std::uint32_t facet;
    bool second, front;
    std::array<Vec3, 3> corner;
    double area;
    double density; ///< of points, in any unit
};

/// Of facets that count: by patch, `weight` is that in a target; empty: 1. Half of the points are
/// spread over the area and half alike over the facets, as small ones may hold much of the light.
std::vector<Half> halves_of(const Mesh& mesh, std::span<const double> weight) {
    std::vector<Half> halves;
    std::vector<double> counts(mesh.scene().facets.size(), weight.empty() ? 1 : 0);
    for (std::size_t i = 0; i < weight.size(); ++i)
        counts[mesh.patches()[i].facet] = std::max(counts[mesh.patches()[i].facet], weight[i]);
    for (std::uint32_t f = 0; f < mesh.scene().facets.size(); ++f) {
        if (!(counts[f] > 0) ||
            mesh.scene().materials[mesh.scene().facets[f].material].reflectance == Vec3(0.0))
            continue;
        const auto p = mesh.whole_side(f, false).shape.corner;
        for (const bool front : {true, false})
            for (const bool second : {false, true}) {
                if (!front && mesh.patch_of(f, false) == none)
                    continue;
                const Vec3 a = second ? p[2] : p[1], b = second ? p[3] : p[2];
                const double area = .5 * glm::length(glm::cross(a - p[0], b - p[0]));
                if (area > 0 && counts[f] > 0)
                    halves.push_back({f, second, front, {p[0], a, b}, area, counts[f]});
            }
    }
    double whole = 0;
    for (const Half& half : halves)
        whole += half.density * half.area;
    for (Half& half : halves)
        half.density = .5 * (half.density / whole + 1 / (double(halves.size()) * half.area));
    return halves;
}

/// By systematic sampling. The mesh is not divided yet.
std::vector<TruthPoint> draw_points(const Mesh& mesh, std::span<const double> weight,
                                    std::size_t count) {
    const std::vector<Half> halves = halves_of(mesh, weight);
    double area = 0;
    for (const Half& half : halves)
        area += half.density * half.area;
    Rng rng(20240229);
    std::vector<TruthPoint> points;
    const double each = area / double(count);
    double next = each * rng.uniform(), end = 0;
    for (const Half& half : halves)
        for (end += half.density * half.area; next < end; next += each) {
            double u = rng.uniform(), v = rng.uniform();
            if (u + v > 1) {
                u = 1 - u;
                v = 1 - v;
            }
            const auto& [p, a, b] = half.corner;
            Hit hit{};
            hit.facet = half.facet;
            hit.u = u;
            hit.v = v;
            hit.second_half = half.second;
            hit.front = half.front;
            const Patch side = mesh.whole_side(half.facet, !half.front);
            points.push_back({hit,
                              {p + u * (a - p) + v * (b - p), side.normal, half.facet},
                              1 / half.density,
                              Vec3(0),
                              Vec3(0)});
        }
    return points;
}

/// What runs are for.
RunTarget target_of(const Settings& settings, const Scene& scene) {
    RunTarget target;
    for (const std::string& group : settings.groups)
        target.groups.push_back(static_cast<std::uint32_t>(std::ranges::find(scene.groups, group) -
                                                           scene.groups.begin()));
    if (settings.view.camera)
        target.picture = TargetPicture{*settings.view.camera, settings.view.size};
    return target;
}
std::vector<double> weights_of(const Settings& settings, const Mesh& mesh, const Tracer& tracer) {
    return target_weights(target_of(settings, mesh.scene()), mesh, tracer, settings.threads);
}

/// An error with one sigma of it.
struct TrueError {
    double value, uncertainty;
};

/// A scene, and the light at its points.
class Truth {
  public:
    Truth(const Scene& scene, const MeshOptions& options, const Settings& settings)
        : scene_(scene), options_(options) {
        const Mesh mesh = layered_mesh(scene, options);
        const MadeTracer made = make_tracer(mesh, settings.threads);
        points_ = draw_points(mesh, weights_of(settings, mesh, *made.tracer), settings.points);
        const PathReference reference(mesh, *made.tracer);
        constexpr std::size_t points_per_chunk = 16;
        Workers(settings.threads)
            .for_chunks(points_.size(), points_per_chunk, [&](std::size_t begin, std::size_t end) {
                for (std::size_t k = begin; k < end; ++k)
                    follow(mesh, reference, k, settings.paths);
            });
    }

    /// Relative to the light as it is, RMS over area and channels.
    [[nodiscard]] TrueError error_of(const Mesh& mesh, const Solution& solution) const {
        Sums sums;
        for (const TruthPoint& point : points_) {
            const std::uint32_t patch = mesh.patch_at(point.hit);
            const Vec3 light = radiosity_at(mesh, solution, patch, point.at.position) -
                               mesh.material(patch).emission;
            sums.add(solution.weight_of(patch), point, light, light);
        }
        return sums.error();
    }
    [[nodiscard]] Mesh mesh(double max_edge) const {
        MeshOptions options = options_;
        options.max_edge = max_edge;
        return layered_mesh(scene_, options);
    }

  private:
    /// Over points, of products of two independent differences.
    struct Sums {
        double sum = 0, squares = 0, size = 0;

        void add(double weight, const TruthPoint& point, const Vec3& light1, const Vec3& light2) {
            weight *= point.area;
            const double product = weight * glm::dot(light1 - point.first, light2 - point.second);
            sum += product;
            squares += product * product;
            size += weight * glm::dot(point.first, point.second);
        }
        [[nodiscard]] TrueError error() const {
            const double value = std::sqrt(std::max(sum / size, 0.0));
            return {value, .5 * std::sqrt(squares) / size / value};
        }
    };
    void follow(const Mesh& mesh, const PathReference& reference, std::size_t k,
                std::size_t paths) {
        std::mt19937_64 numbers(k + 1);
        TruthPoint& point = points_[k];
        const Vec3& rho = mesh.material(mesh.patch_at(point.hit)).reflectance;
        for (Vec3* half : {&point.first, &point.second})
            *half = rho * reference.irradiance(point.at, paths, numbers);
    }

    Scene scene_;
    MeshOptions options_;
    std::vector<TruthPoint> points_;
};

struct Outcome {
    double reported = 0, truth = 0, doubt = 0, sampling = 0, division = 0, seconds = 0;
    std::uint64_t rays = 0; ///< all of them
    std::size_t patches = 0;
};

Outcome run_once(const Truth& truth, const Settings& settings, double error, std::uint64_t seed) {
    constexpr std::uint64_t max_rays = 2'000'000'000;
    const std::clock_t start = std::clock();
    RunWatcher nobody;
    Monitor monitor;
    Problem problem = prepare(std::make_shared<Mesh>(truth.mesh(settings.max_edge)), {},
                              {.threads = settings.threads}, nobody);
    if (!settings.for_all)
        problem.aim_at(target_of(settings, problem.mesh->scene()));
    const Method& standard = method_of(Role::standard);
    RunChoices choices{.method = &standard, .sampling = share_of_sampling * error};
    choices.options.seed = seed;
    choices.options.threads = settings.threads;
    Divided divided;
    if (settings.max_edge == 0)
        divided = divide(std::move(problem), choices, {.error = error, .standard = &standard},
                         monitor, nobody);
    else
        divided.problem = std::make_shared<const Problem>(std::move(problem));
    Run run = divided.run ? *std::move(divided.run) : begin(divided.problem, choices, monitor);
    go_on(run,
          {.steps = {},
           .seconds = {},
           .error = divided.sampling.value_or(*choices.sampling),
           .rays = max_rays},
          nobody);
    Solution solution = run.solution();
    solution.slope = divided.slope;
    WholeError whole = error_of_sampling(run.mesh(), solution);
    find_error_of_division(whole, divided, solution,
                           {.is_asked_for = true, .seed = seed, .threads = settings.threads},
                           monitor.interrupted);
    Outcome done;
    done.seconds = double(std::clock() - start) / CLOCKS_PER_SEC;
    done.reported = whole.error();
    done.sampling = whole.sampling;
    done.division = whole.division.error;
    done.patches = run.mesh().patches().size();
    done.rays = solution.rays_energy + divided.work.rays + divided.work.rays_error + whole.rays;
    solution.weight = weights_of(settings, run.mesh(), *run.problem->tracer);
    const TrueError off = truth.error_of(run.mesh(), solution);
    done.truth = off.value;
    done.doubt = off.uncertainty;
    return done;
}

void print_run(const Outcome& run) {
    std::printf("    %7zu patches, reported %6.3f %% (sampling %6.3f, division %6.3f), true %6.3f "
                "+- %.3f %%, ratio %.3f, %.3g M rays, %.3g s\n",
                run.patches, 100 * run.reported, 100 * run.sampling, 100 * run.division,
                100 * run.truth, 100 * run.doubt, run.reported / run.truth, double(run.rays) / 1e6,
                run.seconds);
}

double median(std::vector<double> values) {
    std::ranges::sort(values);
    const std::size_t n = values.size();
    return n == 0 ? std::nan("") : .5 * (values[n / 2] + values[(n - 1) / 2]);
}

void measure(const std::string& name, const Scene& scene, const MeshOptions& options,
             const Settings& settings) {
    const Truth truth(scene, options, settings);
    std::printf("%s: %zu points\n", name.c_str(), settings.points);
    for (const std::string& asked : settings.asked) {
        const double error = parse_number(asked).value();
        std::vector<double> ratio, patches, rays, seconds, whole, reported;
        std::size_t right = 0;
        for (std::uint64_t seed = 1; seed <= settings.seeds; ++seed) {
            const Outcome run = run_once(truth, settings, error, seed);
            if (settings.every_run)
                print_run(run);
            ratio.push_back(run.reported / run.truth);
            right += ratio.back() >= .8 && ratio.back() <= 1.25;
            patches.push_back(double(run.patches));
            rays.push_back(double(run.rays) / 1e6);
            seconds.push_back(run.seconds);
            whole.push_back(run.truth);
            reported.push_back(run.reported);
        }
        std::printf("  asked %5.3g %%: true %6.3f %%, reported %6.3f %%, ratio %.3f to %.3f, %zu "
                    "of %zu right, %7.0f patches, %6.3g M rays, %6.3g s\n",
                    100 * error, 100 * median(whole), 100 * median(reported),
                    *std::ranges::min_element(ratio), *std::ranges::max_element(ratio), right,
                    ratio.size(), median(patches), median(rays), median(seconds));
        std::fflush(stdout);
    }
}

Mesh read_mesh(const std::string& path) {
    SceneSettings scene;
    scene.path = path;
    ReadResult read = load_scene(scene, {});
    return divide_with_sides(std::move(read.scene), scene, {}, Verbosity::quiet).mesh;
}

void add_options(Command command, Settings& settings) {
    command.add_texts("--scene", "FILE,...", settings.scenes, "scenes in files").separated_by(',');
    command.add_texts("--family", "NAME,...", settings.families, "made scenes; all: all of them")
        .separated_by(',');
    command
        .add_texts("--error", "X,...", settings.asked,
                   "whole errors asked for, one after the other [0.05]")
        .separated_by(',');
    add_whole(command, "--seeds", settings.seeds, 1, 1000, "runs of each [10]");
    add_whole(command, "--points", settings.points, 100, 10'000'000, "of the truth [10000]");
    add_whole(command, "--paths", settings.paths, 1, 100'000, "at each point, twice [256]");
    add_number(command, "--divide", "LENGTH", settings.max_edge, positive,
               "patches of one size instead of --divide auto");
    add_whole(command, "--threads", settings.threads, 0, 1024, "0: all cores");
    command.add_texts("--for", "GROUP,...", settings.groups, "groups that are the target")
        .separated_by(',');
    add_camera_options(command, settings.view);
    command.add_flag("--for-all", settings.for_all,
                     "runs are for all alike, and the true error is still that of the target");
    command.add_flag("--every-run", settings.every_run, "a line for each run too");
}

} // namespace

int main(int count, char** words) {
    Settings settings;
    try {
        Arguments arguments("hemilux_division_truth",
                            "Compares the whole error of --divide auto with the true one.");
        add_options(arguments.program(), settings);
        const std::string help = arguments.parse({words + 1, words + count});
        std::fputs(help.c_str(), stdout);
        if (!help.empty())
            return 0;
        for (const std::string& path : settings.scenes) {
            const Mesh mesh = read_mesh(path);
            const bool two_sided = mesh.patch_of(0, false) != none;
            measure(path, mesh.scene(), {.max_edge = 0, .two_sided = two_sided}, settings);
        }
        for (const DivisionFamily& family : division_families())
            if (std::ranges::any_of(settings.families, [&](const std::string& name) {
                    return name == "all" || family.name == name;
                }))
                measure(family.name, family.make(), {.max_edge = 0, .two_sided = family.two_sided},
                        settings);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
    return 0;
}
