// How soon pictures of the paper's section 6 are useful, by what people see: the structural
// similarity (ssim.h) of the picture after each step to that of the reference.
//
//     useful_pictures SCENE.obj FOLDER [RUNS [STEPS [CAMERA]]]
//
// CAMERA is that of --camera; without it the program's own is used. Progressive Monte Carlo
// beside the hemisphere subdivision, steps of 64 rays a patch. Prints rows of tables in Markdown:
// the index after 3 and 17 steps, over the whole picture, where it shows groups named detail...,
// and elsewhere; and the first step after which the mean index of the runs is 0.95, and 0.99, with
// rays a patch and processor seconds until then. FOLDER gets the part of the pictures that shows
// the details.
#include "bvh/wide/wide_bvh.h"
#include "clock.h"
#include "io/pictures/camera_text.h"
#include "io/pictures/picture_files.h"
#include "io/scene_files/obj.h"
#include "radiosity/answers/images/ssim.h"
#include "radiosity/answers/images/tone.h"
#include "radiosity/answers/pictures/render.h"
#include "radiosity/engine/solving/method.h"
#include "radiosity/engine/solving/run.h"
#include "radiosity/light/layers/layered_mesh.h"
#include "radiosity/paper/scene/mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

using namespace hemilux;

namespace {

constexpr double rays_per_step = 64, reference_error = .003;
constexpr std::array<double, 2> thresholds = {.95, .99};
constexpr std::array<std::uint32_t, 2> shown_steps = {3, 17};
constexpr const char* part_names[] = {"whole", "detail", "elsewhere"};
constexpr std::size_t parts = 3;
const RenderOptions size{.width = 640, .height = 480, .threads = 1};

struct Variant {
    const char* name; ///< of its pictures
    const char* method;
};
constexpr std::array<Variant, 2> methods = {
    {{"classical", "progressive-monte-carlo"}, {"new", "hemisphere"}}};

/// Over the runs, after a step.
struct Step {
    double rays = 0, seconds = 0;
    std::array<double, parts> index{}, squares{};
};

class View {
  public:
    View(const Mesh& mesh, const Tracer& tracer, std::span<const Vec3> reference,
         const char* camera)
        : mesh_(mesh), tracer_(tracer),
          camera_(camera != nullptr ? parse_camera(camera).value()
                                    : automatic_camera(mesh, tracer, reference,
                                                       double(size.width) / size.height)) {
        const Image best = render(mesh, tracer, reference, camera_, size);
        exposure_ = auto_exposure(best);
        reference_ = luma(best);
        find_details();
    }

    [[nodiscard]] Image picture(std::span<const Vec3> radiosity) const {
        return render(mesh_, tracer_, radiosity, camera_, size);
    }

    /// The mean index of the windows around pixels that show detail, of the others, and of all.
    [[nodiscard]] std::array<double, parts> compare(const Image& image) const {
        const std::vector<double> map = ssim_map(luma(image), reference_);
        const int width = size.width - 2 * ssim_margin;
        std::array<double, parts> sum{}, count{};
        for (std::size_t k = 0; k < map.size(); ++k) {
            const int x = static_cast<int>(k) % width, y = static_cast<int>(k) / width;
            const bool detail = shows_detail_.at(x + ssim_margin, y + ssim_margin).x > 0;
            for (const std::size_t part : {std::size_t{0}, std::size_t{detail ? 1u : 2u}})
                sum[part] += map[k], count[part] += 1;
        }
        for (std::size_t part = 0; part < parts; ++part)
            sum[part] /= count[part];
        return sum;
    }

    [[nodiscard]] double detail_share() const {
        const auto pixels =
            std::ranges::count_if(shows_detail_.pixels, [](const glm::vec3& p) { return p.x > 0; });
        return double(pixels) / double(shows_detail_.pixels.size());
    }

    /// What shows detail, and a little around it, each pixel four times as wide and high.
    void write_crop(const std::string& path, const Image& image) const {
        constexpr int margin = 12, scale = 4;
        int left = size.width, right = 0, top = size.height, bottom = 0;
        for (int y = 0; y < size.height; ++y)
            for (int x = 0; x < size.width; ++x)
                if (shows_detail_.at(x, y).x > 0) {
                    left = std::min(left, x), right = std::max(right, x);
                    top = std::min(top, y), bottom = std::max(bottom, y);
                }
        left = std::max(0, left - margin), right = std::min(size.width - 1, right + margin);
        top = std::max(0, top - margin), bottom = std::min(size.height - 1, bottom + margin);
        Image crop(scale * (right - left + 1), scale * (bottom - top + 1));
        for (int y = 0; y < crop.height; ++y)
            for (int x = 0; x < crop.width; ++x)
                crop.at(x, y) = image.at(left + x / scale, top + y / scale);
        write_png(path, crop, exposure_);
    }

  private:
    /// As the bytes of a PNG have it, rounded.
    [[nodiscard]] LumaPicture luma(const Image& image) const {
        return luma_of(image, Display(exposure_));
    }

    void find_details() {
        std::vector<Vec3> mark;
        for (const Patch& patch : mesh_.patches()) {
            const Scene& scene = mesh_.scene();
            const std::string& group = scene.groups[scene.facets[patch.facet].group];
            mark.emplace_back(group.starts_with("detail") ? 1 : 0);
        }
        RenderOptions flat = size;
        flat.smooth = false;
        shows_detail_ = render(mesh_, tracer_, mark, camera_, flat);
    }

    const Mesh& mesh_;
    const Tracer& tracer_;
    Camera camera_;
    double exposure_ = 1;
    LumaPicture reference_;
    Image shows_detail_;
};

std::vector<Vec3> reference(const Mesh& mesh, const Tracer& tracer) {
    SolveOptions options;
    options.seed = 12345;
    Monitor monitor;
    const SolverInput input{mesh, tracer, options, monitor};
    const auto solver = find_method("matrix")->make(input);
    run(*solver, input, {.steps = {}, .seconds = {}, .error = reference_error});
    return solver->solution().radiosity;
}

/// One run, whose figures are added to those of its steps; the first run's pictures are kept.
void measure(const Variant& method, const Mesh& mesh, const Tracer& tracer, const View& view,
             std::uint64_t seed, std::vector<Step>& steps, const std::string& folder) {
    SolveOptions options;
    options.rays = rays_per_step;
    options.seed = seed;
    options.threads = 1;
    Monitor monitor;
    const SolverInput input{mesh, tracer, options, monitor};
    double looking = 0;
    const double start = bench::cpu_seconds();
    const auto solver = find_method(method.method)->make(input);
    const auto after_step = [&](const StepRecord& record, const Solution& solution) {
        const double now = bench::cpu_seconds();
        Step& step = steps[record.step - 1];
        step.rays += static_cast<double>(record.rays);
        step.seconds += now - start - looking;
        const Image picture = view.picture(solution.radiosity);
        const std::array<double, parts> index = view.compare(picture);
        for (std::size_t part = 0; part < parts; ++part)
            step.index[part] += index[part], step.squares[part] += index[part] * index[part];
        if (seed == 1 && std::ranges::find(shown_steps, record.step) != shown_steps.end())
            view.write_crop(folder + "/detail-" + method.name + "-" + std::to_string(record.step) +
                                ".png",
                            picture);
        looking += bench::cpu_seconds() - now;
    };
    run(*solver, input,
        {.steps = static_cast<std::uint32_t>(steps.size()), .seconds = {}, .error = {}},
        after_step);
}

void print_after(const char* name, std::uint32_t number, const Step& step, double runs) {
    std::printf("| %s | %u |", name, number);
    for (std::size_t part = 0; part < parts; ++part) {
        const double mean = step.index[part] / runs;
        const double variance = std::max(0.0, step.squares[part] / runs - mean * mean);
        std::printf(" %.4f ± %.4f |", mean, runs > 1 ? std::sqrt(variance / (runs - 1)) : 0);
    }
    std::puts("");
}

void print_first(const char* name, double threshold, const std::vector<Step>& steps, double runs,
                 double patches) {
    std::printf("| %s | %.2f |", name, threshold);
    for (std::size_t part = 0; part < parts; ++part) {
        const auto first = std::ranges::find_if(
            steps, [&](const Step& s) { return s.index[part] / runs >= threshold; });
        if (first == steps.end())
            std::printf(" not in %zu |", steps.size());
        else
            std::printf(" %td: %.0f, %.3f s |", first - steps.begin() + 1,
                        first->rays / runs / patches, first->seconds / runs);
    }
    std::puts("");
}

void experiment(const char* path, const std::string& folder, int runs, int max_steps,
                const char* camera) {
    const Mesh mesh = layered_mesh(read_obj(path).scene);
    const WideBvh bvh(mesh.soup());
    const std::vector<Vec3> truth = reference(mesh, bvh);
    const View view(mesh, bvh, truth, camera);
    std::filesystem::create_directories(folder);
    view.write_crop(folder + "/detail-reference.png", view.picture(truth));
    std::array<std::vector<Step>, methods.size()> steps;
    for (std::size_t m = 0; m < methods.size(); ++m) {
        steps[m].resize(static_cast<std::size_t>(max_steps));
        for (int r = 0; r < runs; ++r)
            measure(methods[m], mesh, bvh, view, static_cast<std::uint64_t>(r + 1), steps[m],
                    folder);
    }
    std::printf("%.2f %% of the pixels show details\n\n| method | steps | %s | %s | %s "
                "|\n|---|---|---|---|---|\n",
                100 * view.detail_share(), part_names[0], part_names[1], part_names[2]);
    for (const std::uint32_t number : shown_steps)
        for (std::size_t m = 0; m < methods.size(); ++m)
            print_after(methods[m].name, number, steps[m][number - 1], runs);
    std::printf("\n| method | index | %s: steps: rays a patch, seconds | %s | %s "
                "|\n|---|---|---|---|---|\n",
                part_names[0], part_names[1], part_names[2]);
    for (const double threshold : thresholds)
        for (std::size_t m = 0; m < methods.size(); ++m)
            print_first(methods[m].name, threshold, steps[m], runs,
                        static_cast<double>(mesh.patches().size()));
}

} // namespace

int main(int argc, char** argv) try {
    if (argc < 3) {
        std::fputs("usage: useful_pictures SCENE.obj FOLDER [RUNS [STEPS [CAMERA]]]\n", stderr);
        return 1;
    }
    experiment(argv[1], argv[2], argc > 3 ? std::atoi(argv[3]) : 4,
               std::max(17, argc > 4 ? std::atoi(argv[4]) : 17), argc > 5 ? argv[5] : nullptr);
    return 0;
} catch (const std::exception& error) {
    std::fprintf(stderr, "useful_pictures: %s\n", error.what());
    return 2;
}
