#pragma once
// The way from a path on the command line to a scene that can be solved.

#include "app/memory/memory.h"
#include "app/settings/settings.h"
#include "io/files/error.h"
#include "io/scene_files/read_result.h"
#include "radiosity/answers/run/problem.h"
#include "radiosity/engine/rays/make_tracer.h"
#include "radiosity/paper/scene/needs.h"
#include "radiosity/paper/solution/solve_error.h"

#include <cstdint>
#include <functional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace hemilux {

/// Reads a scene by its extension and applies what the command line changes in it. Throws
/// InputError for the file. Throws UsageError for the changes, and where a file that the scene
/// refers to is an output of the run.
[[nodiscard]] ReadResult load_scene(const SceneSettings& settings, const RunFiles& files);

/// Throws InputError for what no method can solve: no faces, a material in use that reflects more
/// than all light, negative emission, or a scene in which nothing emits.
void check_solvable(const ReadResult& read, const std::string& path);

/// Returns what cannot be solved as an error of the file, with the line of the face.
[[nodiscard]] InputError as_input_error(const SolveError& error, const std::string& path,
                                        std::span<const std::uint32_t> face_lines);

/// The view that a file asks for.
struct FileView {
    std::optional<Camera> camera; ///< ReadResult
    std::string camera_name;
    /// The axis that is upwards in files of this kind. For glTF it is 1, or 2 where its camera is
    /// held level only so; for STL it is 2, as printers have it; it is empty for other formats.
    std::optional<int> usual_up;
};
[[nodiscard]] FileView view_of_file(const std::string& path, const ReadResult& read);
/// Returns the view asked for. A camera that was asked for without a direction upwards has that of
/// --up. Where no camera was asked for, the view has the camera of the file, which is reported.
[[nodiscard]] ViewSettings view_of(const ViewSettings& asked, const FileView& file,
                                   Verbosity verbosity);

struct LoadedMesh {
    Mesh mesh;
    MadeTracer made; ///< tracer, where the sides of the faces needed one
    double seconds_read, seconds_sides;
    std::vector<std::uint32_t> face_lines; ///< ReadResult
    FileView view;
    std::vector<std::string> warnings;         ///< warnings that were logged
    MemoryNeed need = {};                      ///< as it was checked against --memory
    std::vector<PrimitiveOrigin> origins = {}; ///< ReadResult
};

/// Does all of this and reports what there is to report. Throws InputError for what no method can
/// solve. Throws std::runtime_error if the methods side by side, or `before` alone, would need more
/// memory than they may, with that of the results.
[[nodiscard]] LoadedMesh load_mesh(const SceneSettings& settings, const RunFiles& files,
                                   const SolveOptions& options,
                                   std::span<const Method* const> methods, Verbosity verbosity,
                                   const std::function<double(double patches)>& bytes_of_results,
                                   const Method* before = nullptr);

struct Prepared {
    Problem problem;
    double seconds; ///< time with that of the sides
};
/// Prepares what solving needs. Takes over the mesh and what was made for it. Warns where rays will
/// be slow.
[[nodiscard]] Prepared prepare(LoadedMesh& loaded, const SolveOptions& options,
                               Verbosity verbosity);

/// Divides the faces; throws UsageError where --max-edge would give too many patches.
[[nodiscard]] Mesh divide_scene(Scene scene, const SceneSettings& settings, unsigned threads = 0);
/// Throws what keeps faces from being divided as an error of --max-edge or of the file.
[[noreturn]] void throw_as_of_file(const SceneSettings& settings,
                                   const std::invalid_argument& error);
/// Returns what `divide` does, with its errors as those.
template <class Divide>
[[nodiscard]] auto as_of_file(const SceneSettings& settings, const Divide& divide) {
    try {
        return divide();
    } catch (const std::invalid_argument& error) {
        throw_as_of_file(settings, error);
    }
}

} // namespace hemilux
