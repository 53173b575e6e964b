// A small `solve`, for where CLI11 and nlohmann-json are missing and `hemilux` is not built:
//
//     12_solve SCENE.obj [--method NAME] [--rays N] [--steps N] [-o FILE.png|FILE.csv]...
//
// Shows: a whole program over the library: arguments, an OBJ file, any method by its name, a
// picture, a table. Each face is a patch whose front emits and reflects; what `hemilux solve` does
// besides (sides, coplanar layers, division, textures on pictures) is left out.
// Prints: what the reader warns of, and at the end the rays, the time and the estimated error.
// Ends with 0, with 1 for wrong arguments, with 2 for input that cannot be solved.

#include "bvh/wide/wide_bvh.h"
#include "io/pictures/picture_files.h"
#include "io/results/tables.h"
#include "io/scene_files/obj.h"
#include "radiosity/answers/pictures/render.h"
#include "radiosity/engine/solving/method.h"
#include "radiosity/engine/solving/run.h"
#include "radiosity/paper/scene/mesh.h"

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

using namespace hemilux;

namespace {

struct Arguments {
    std::string scene, method = "hemisphere";
    std::vector<std::string> outputs;
    double rays = 0;         ///< of a patch in a step; 0: the default
    std::uint32_t steps = 0; ///< 0: as long as the method takes by itself
};

/// Wrong arguments, as opposed to input that cannot be solved.
struct UsageError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

template <class Number>
Number number_of(const std::string& option, const std::string& text) {
    std::istringstream stream(text);
    Number number = 0;
    if (text.starts_with('-') || !(stream >> number) || !stream.eof() || !(number > 0))
        throw UsageError(option + " " + text + ": a number above 0 is expected");
    return number;
}

Arguments read(const std::vector<std::string>& words) {
    Arguments arguments;
    for (std::size_t k = 0; k < words.size(); ++k) {
        const std::string& word = words[k];
        if (!word.starts_with('-') && arguments.scene.empty()) {
            arguments.scene = word;
            continue;
        }
        if (word != "--method" && word != "--rays" && word != "--steps" && word != "-o")
            throw UsageError(word + ": not an option");
        if (k + 1 == words.size())
            throw UsageError(word + " needs a value");
        const std::string& value = words[++k];
        if (word == "--method")
            arguments.method = value;
        else if (word == "--rays")
            arguments.rays = number_of<double>(word, value);
        else if (word == "--steps")
            arguments.steps = number_of<std::uint32_t>(word, value);
        else if (value.ends_with(".png") || value.ends_with(".csv"))
            arguments.outputs.push_back(value);
        else
            throw UsageError(value + ": .png or .csv is expected");
    }
    if (arguments.scene.empty())
        throw UsageError("no scene is named");
    return arguments;
}

const Method& method_named(const std::string& name) {
    if (const Method* const method = find_method(name))
        return *method;
    std::string names;
    for (const Method* const method : methods())
        names += " " + std::string(method->name);
    throw UsageError("no method is named " + name + "; there are" + names);
}

void write(const std::string& file, const Mesh& mesh, const Tracer& tracer,
           const Solution& solution) {
    if (file.ends_with(".csv")) {
        write_patch_table(file, mesh, solution.radiosity, solution.standard_error);
    } else {
        const RenderOptions size{.width = 640, .height = 480};
        const Camera camera =
            automatic_camera(mesh, tracer, solution.radiosity, double(size.width) / size.height);
        const Image image = render(mesh, tracer, solution.radiosity, camera, size);
        write_png(file, image, auto_exposure(image));
    }
    std::printf("wrote %s\n", file.c_str());
}

void solve(const Arguments& arguments) {
    const Method& method = method_named(arguments.method);
    const ReadResult file = read_obj(arguments.scene);
    for (const std::string& warning : file.warnings)
        std::fprintf(stderr, "warning: %s\n", warning.c_str());
    const Mesh mesh(file.scene);
    const WideBvh tree(mesh.soup());
    SolveOptions options;
    if (arguments.rays > 0)
        options.rays = arguments.rays;
    StopRule stop = method.default_stop;
    if (arguments.steps > 0)
        stop = {.steps = arguments.steps, .seconds = {}, .error = {}};
    Monitor monitor;
    const SolverInput input{mesh, tree, options, monitor};
    const auto solver = method.make(input);
    double seconds = 0;
    run(*solver, input, stop,
        [&](const StepRecord& record, const Solution&) { seconds = record.seconds; });
    const Solution& solution = solver->solution();
    std::printf("%s: %zu patches, %u steps, %llu rays, %.2f s", arguments.method.c_str(),
                mesh.patches().size(), solution.steps,
                static_cast<unsigned long long>(solution.rays_energy + solution.rays_density),
                seconds);
    if (const double error = estimated_error(mesh, solution); std::isfinite(error))
        std::printf(", estimated error %.2f %%", 100 * error);
    std::printf("\n");
    for (const std::string& output : arguments.outputs)
        write(output, mesh, tree, solution);
}

} // namespace

int main(int argc, char** argv) {
    try {
        solve(read({argv + 1, argv + argc}));
        return 0;
    } catch (const UsageError& error) {
        std::fprintf(stderr,
                     "12_solve: %s\nusage: 12_solve SCENE.obj [--method NAME] [--rays N] "
                     "[--steps N] [-o FILE.png|FILE.csv]...\n",
                     error.what());
        return 1;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "12_solve: %s\n", error.what());
        return 2;
    }
}
