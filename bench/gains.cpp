// What guidance gains on given scenes:
//
//     gains STEPS RUNS GUIDE[,GUIDE...] SCENE.obj...
//
// GUIDE is density, pyramid, visible or learned (--guide of the method hemisphere), or the name of
// a method. Prints rows of a table in Markdown: the mean square errors after STEPS steps of 64 rays
// relative to those of progressive-monte-carlo, over all patches, those of the groups named
// detail..., and the rest; and g, how many times more rays progressive-monte-carlo needs for the
// same error, all rays counted, with its standard error by the spread of the runs. Seconds are
// those of a run relative to progressive-monte-carlo. The last rows are geometric means over the
// scenes. The reference is `matrix`.
#include "bvh/wide/wide_bvh.h"
#include "clock.h"
#include "io/scene_files/obj.h"
#include "radiosity/engine/needs/find_needs.h"
#include "radiosity/engine/shooting/additions.h"
#include "radiosity/engine/solving/method.h"
#include "radiosity/engine/solving/own_options.h"
#include "radiosity/engine/solving/run.h"
#include "radiosity/paper/scene/mesh.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

using namespace hemilux;

namespace {

constexpr double rays_per_step = 64, reference_error = .003;
constexpr const char* plain = "progressive-monte-carlo";

constexpr std::size_t parts = 3; // all, detail, rest

/// Mean and squared relative standard error of the squared error of a part.
struct SquaredError {
    double sum = 0, squares = 0, runs = 0;

    void add(double error) {
        sum += error * error, squares += error * error * error * error, runs += 1;
    }
    [[nodiscard]] double mean() const { return sum / runs; }
    [[nodiscard]] double relative_variance() const {
        return runs > 1 ? (squares / runs / (mean() * mean()) - 1) / (runs - 1) : 0;
    }
};

struct Measured {
    std::array<SquaredError, parts> error;
    double rays = 0, seconds = 0;
};

struct Variant {
    std::string name, method;
    const Guide* guide = nullptr;
};

Variant variant_of(const std::string& name) {
    if (name == "density")
        return {name, "hemisphere"};
    for (const Guide* const guide : additions().guides)
        if (guide->name == name)
            return {name, "hemisphere", guide};
    if (find_method(name) == nullptr)
        throw std::invalid_argument("neither a guide nor a method: " + name);
    return {name, name};
}

class Measurement {
  public:
    explicit Measurement(const std::string& path)
        : mesh_(read_obj(path).scene), bvh_(mesh_.soup()), needs_(find_needs(mesh_)) {
        for (const Patch& patch : mesh_.patches()) {
            const Scene& scene = mesh_.scene();
            detail_.push_back(scene.groups[scene.facets[patch.facet].group].starts_with("detail"));
        }
        SolveOptions options;
        options.seed = 12345;
        reference_ =
            solve("matrix", options, {.steps = {}, .seconds = {}, .error = reference_error})
                .radiosity;
    }

    void run_once(const Variant& variant, std::uint32_t steps, std::uint64_t seed,
                  Measured& measured) const {
        SolveOptions options;
        options.rays = rays_per_step;
        options.threads = 1;
        options.seed = seed;
        set_own_options(options, GuideChoice{.guide = variant.guide});
        const double start = bench::cpu_seconds();
        const Solution s =
            solve(variant.method, options, {.steps = steps, .seconds = {}, .error = {}});
        measured.seconds += bench::cpu_seconds() - start;
        const RelativeError error = true_error(mesh_, s.radiosity, reference_, detail_);
        measured.error[0].add(error.all);
        measured.error[1].add(error.detail);
        measured.error[2].add(error.rest);
        measured.rays += static_cast<double>(s.rays_energy + s.rays_density);
    }

    [[nodiscard]] std::size_t patches() const { return mesh_.patches().size(); }

  private:
    [[nodiscard]] Solution solve(const std::string& method, const SolveOptions& options,
                                 const StopRule& stop) const {
        Monitor monitor;
        const SolverInput input{mesh_, bvh_, options, monitor, needs_};
        const auto solver = find_method(method)->make(input);
        run(*solver, input, stop);
        return solver->solution();
    }

    Mesh mesh_;
    WideBvh bvh_;
    Needs needs_;
    std::vector<bool> detail_;
    std::vector<Vec3> reference_;
};

/// Logarithms of a row's ratios.
struct Row {
    std::array<double, parts> error{}, gain{};
    double seconds = 0;
};

void print(const std::string& scene, const std::string& variant, std::size_t patches,
           const Row& row, const std::array<double, parts>& deviation) {
    std::printf("| %s | %s | ", scene.c_str(), variant.c_str());
    if (patches > 0)
        std::printf("%zu", patches);
    std::printf(" | %.2f, %.2f, %.2f |", std::exp(row.error[0]), std::exp(row.error[1]),
                std::exp(row.error[2]));
    for (std::size_t part = 0; part < parts; ++part)
        std::printf("%s %.2f ± %.2f", part > 0 ? "," : "", std::exp(row.gain[part]),
                    std::exp(row.gain[part]) * deviation[part]);
    std::printf(" | %.2f |\n", std::exp(row.seconds));
    std::fflush(stdout);
}

Row print_row(const std::string& scene, const std::string& variant, std::size_t patches,
              const Measured& base, const Measured& measured) {
    Row row;
    std::array<double, parts> deviation;
    for (std::size_t part = 0; part < parts; ++part) {
        row.error[part] = std::log(measured.error[part].mean() / base.error[part].mean());
        row.gain[part] = -row.error[part] - std::log(measured.rays / base.rays);
        deviation[part] = std::sqrt(measured.error[part].relative_variance() +
                                    base.error[part].relative_variance());
    }
    row.seconds = std::log(measured.seconds / base.seconds);
    print(scene, variant, patches, row, deviation);
    return row;
}

void measure(const std::vector<Variant>& variants, const std::vector<std::string>& paths,
             std::uint32_t steps, int runs) {
    std::puts("| scene | guide | patches | MSE / plain: all, detail, rest | g: all, detail, rest | "
              "seconds / plain |\n|---|---|---|---|---|---|");
    std::vector<std::vector<Row>> rows(variants.size());
    for (const std::string& path : paths) {
        const Measurement scene(path);
        std::vector<Measured> measured(variants.size() + 1);
        for (int r = 0; r < runs; ++r) {
            scene.run_once({plain, plain}, steps, static_cast<std::uint64_t>(1000 + r),
                           measured.back());
            for (std::size_t v = 0; v < variants.size(); ++v)
                scene.run_once(variants[v], steps, static_cast<std::uint64_t>(1 + r), measured[v]);
        }
        for (std::size_t v = 0; v < variants.size(); ++v)
            rows[v].push_back(print_row(std::filesystem::path(path).stem().string(),
                                        variants[v].name, scene.patches(), measured.back(),
                                        measured[v]));
    }
    for (std::size_t v = 0; v < variants.size(); ++v) {
        Row mean;
        std::array<double, parts> deviation{};
        const auto n = static_cast<double>(rows[v].size());
        for (const Row& row : rows[v]) {
            mean.seconds += row.seconds / n;
            for (std::size_t part = 0; part < parts; ++part) {
                mean.error[part] += row.error[part] / n;
                mean.gain[part] += row.gain[part] / n;
            }
        }
        for (const Row& row : rows[v])
            for (std::size_t part = 0; part < parts; ++part)
                deviation[part] += std::pow(row.gain[part] - mean.gain[part], 2);
        for (double& d : deviation)
            d = n > 1 ? std::sqrt(d / (n - 1) / n) : 0;
        print("mean", variants[v].name, 0, mean, deviation);
    }
}

} // namespace

int main(int argc, char** argv) try {
    if (argc < 5) {
        std::fputs("usage: gains STEPS RUNS GUIDE[,GUIDE...] SCENE.obj...\n", stderr);
        return 1;
    }
    std::vector<Variant> variants;
    std::istringstream names(argv[3]);
    for (std::string name; std::getline(names, name, ',');)
        variants.push_back(variant_of(name));
    measure(variants, {argv + 4, argv + argc}, static_cast<std::uint32_t>(std::atoi(argv[1])),
            std::atoi(argv[2]));
    return 0;
} catch (const std::exception& error) {
    std::fprintf(stderr, "gains: %s\n", error.what());
    return 2;
}
