#include "app/loading/load_geometry.h"

#include "app/loading/sides.h"
#include "app/terminal/log.h"
#include "app/terminal/stage.h"
#include "app/terminal/summary.h"
#include "io/files/error.h"

namespace hemilux {

LoadedGeometry load_geometry(const SceneSettings& settings, const RunFiles& files,
                             const SolveOptions& options, const GeometryUse& use,
                             Verbosity verbosity) {
    const Stage stage("reading", verbosity);
    check_memory_to_read(settings.path, settings.memory);
    ReadResult read = load_scene(settings, files);
    log_warnings(verbosity, read.warnings);
    if (read.scene.facets.empty())
        throw InputError(settings.path, "there is no face with an area");
    MemoryNeed need = memory_need(read.scene, settings.mesh, options, {});
    need.results = use.bytes(patches_of(read.scene, settings.mesh));
    check_memory(need, settings.memory, settings.path, use.advice);
    FileView view = view_of_file(settings.path, read);
    Mesh mesh = divide_with_sides(std::move(read.scene), settings, options, verbosity).mesh;
    log_line(verbosity, Verbosity::verbose, mesh_text(mesh));
    return {std::move(mesh), std::move(view), std::move(read.origins), std::move(read.warnings)};
}

} // namespace hemilux
