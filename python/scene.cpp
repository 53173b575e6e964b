#include "python/scene.h"

#include "app/loading/load.h"
#include "app/settings/exit_code.h"
#include "radiosity/engine/needs/find_needs.h"
#include "radiosity/light/polygons/polygon_division.h"

#include <cmath>

namespace hemilux {
namespace {

constexpr const char* of_arrays = "Mesh";

std::string place_of(const char* array, std::size_t row) {
    return std::string(array) + "[" + std::to_string(row) + "]: ";
}

std::vector<Vec3> vertices_of(const Doubles& array) {
    const std::span<const Vec3> rows = rows_of(array);
    for (std::size_t i = 0; i < rows.size(); ++i)
        for (int axis = 0; axis < 3; ++axis)
            if (!std::isfinite(rows[i][axis]))
                throw InputError(of_arrays, place_of("vertices", i) +
                                                "expected finite numbers, found " +
                                                std::to_string(rows[i][axis]));
    return {rows.begin(), rows.end()};
}

/// Reads the corners of a face, without unused places at its end.
void corners_of(const Integers& faces, std::size_t face, std::size_t vertices,
                std::vector<std::uint32_t>& corners) {
    const auto places = static_cast<std::size_t>(faces.shape(1));
    std::span row(faces.data() + face * places, places);
    while (row.size() > 3 && row.back() < 0)
        row = row.first(row.size() - 1);
    corners.clear();
    for (const std::int64_t vertex : row) {
        if (vertex < 0 || static_cast<std::uint64_t>(vertex) >= vertices)
            throw InputError(
                of_arrays, place_of("faces", face) + "expected vertices between 0 and " +
                               std::to_string(vertices - 1) + ", found " + std::to_string(vertex));
        corners.push_back(static_cast<std::uint32_t>(vertex));
    }
}

/// Divides all faces into facets, and says which have no area.
void divide_faces(const FaceArrays& arrays, ReadResult& read) {
    Scene& scene = read.scene;
    const auto faces = static_cast<std::size_t>(arrays.faces.shape(0));
    scene.faces = static_cast<std::uint32_t>(faces);
    scene.facets.reserve(faces);
    PolygonDivision division;
    std::vector<std::uint32_t> corners;
    std::vector<Vec3> shape;
    std::size_t crossing = 0, first_without_area = 0;
    for (std::size_t f = 0; f < faces; ++f) {
        corners_of(arrays.faces, f, scene.vertices.size(), corners);
        shape.clear();
        for (const std::uint32_t vertex : corners)
            shape.push_back(scene.vertices[vertex]);
        const PolygonFlags flags = division.divide(shape);
        if (flags.unfinished)
            throw InputError(of_arrays, place_of("faces", f) +
                                            "is too intricate to be divided into triangles");
        if (flags.degenerate && read.degenerate_faces++ == 0)
            first_without_area = f;
        crossing += flags.crossing;
        for (const PolygonDivision::Piece& p : division.pieces())
            scene.facets.push_back({{corners[p[0]], corners[p[1]], corners[p[2]], corners[p[3]]},
                                    static_cast<std::uint32_t>(f),
                                    static_cast<std::uint32_t>(arrays.material.at(f)),
                                    static_cast<std::uint32_t>(arrays.group.at(f)),
                                    arrays.two_sided.at(f)});
    }
    if (scene.facets.empty())
        throw InputError(of_arrays, "none of the faces has an area");
    if (read.degenerate_faces > 0)
        read.warnings.push_back(std::to_string(read.degenerate_faces) +
                                " of the faces have no area and are left out; the first is " +
                                std::to_string(first_without_area));
    if (crossing > 0)
        read.warnings.push_back(std::to_string(crossing) +
                                " of the faces cross themselves; their areas are not well defined");
}

std::vector<Override> overrides_of(const std::vector<std::pair<std::string, Vec3>>& colours,
                                   const NumberRange& range, const char* name) {
    std::vector<Override> result;
    for (const auto& [material, value] : colours) {
        for (int channel = 0; channel < 3; ++channel)
            if (!range.contains(value[channel]))
                throw UsageError(std::string(name) + " of '" + material + "': expected numbers " +
                                 range.text());
        result.push_back({material, value});
    }
    return result;
}

/// Makes the mesh, and keeps of what was read all but the scene.
std::unique_ptr<PythonMesh> finish(ReadResult read, const SceneSettings& settings, int up,
                                   std::string fault) {
    Scene scene = std::move(read.scene);
    read.scene = {};
    return std::make_unique<PythonMesh>(divide_scene(std::move(scene), settings), std::move(read),
                                        settings.path, up, std::move(fault));
}

} // namespace

const WideBvh& PythonMesh::tree(unsigned threads) const {
    const std::lock_guard lock(mutex_);
    if (!tree_)
        tree_ = std::make_shared<const WideBvh>(mesh_->soup_to_trace(),
                                                WideBvhOptions{.threads = threads});
    return *tree_;
}

std::shared_ptr<const Problem> PythonMesh::problem(bool keep_all, unsigned threads) const {
    (void)tree(threads);
    return std::make_shared<const Problem>(
        prepare(mesh_, tree_, {.keep_all = keep_all, .threads = threads}));
}

void PythonMesh::check_solvable() const {
    if (!fault_.empty())
        throw InputError(name_, fault_);
}

std::unique_ptr<PythonMesh> mesh_of(const FaceArrays& arrays, double max_edge, int up) {
    ReadResult read;
    read.scene.vertices = vertices_of(arrays.vertices);
    read.scene.groups = arrays.groups;
    const std::span<const Vec3> reflectance = rows_of(arrays.reflectance),
                                emission = rows_of(arrays.emission);
    bool emits = false;
    for (std::size_t m = 0; m < reflectance.size(); ++m) {
        read.scene.materials.push_back({std::to_string(m), reflectance[m], emission[m]});
        emits = emits || emission[m] != Vec3(0.0);
    }
    divide_faces(arrays, read);
    SceneSettings settings;
    settings.path = of_arrays;
    settings.mesh.max_edge = max_edge;
    return finish(std::move(read), settings, up,
                  emits ? "" : "nothing emits light; emission= says what does");
}

std::unique_ptr<PythonMesh> read_mesh(const std::string& path,
                                      const std::vector<std::pair<std::string, Vec3>>& reflectance,
                                      const std::vector<std::pair<std::string, Vec3>>& emission,
                                      std::optional<bool> two_sided, double max_edge,
                                      std::optional<int> up) {
    SceneSettings settings;
    settings.path = path;
    settings.reflectance = overrides_of(reflectance, reflectance_range, "reflectance");
    settings.emission = overrides_of(emission, emission_range, "emission");
    settings.mesh.max_edge = max_edge;
    settings.mesh.two_sided = two_sided.value_or(false);
    ReadResult read = load_scene(settings, RunFiles());
    if (read.scene.facets.empty())
        throw InputError(path, "there is no face with an area");
    if (two_sided == false)
        for (Facet& facet : read.scene.facets)
            facet.two_sided = false;
    std::string fault;
    try {
        check_solvable(read, path);
    } catch (const InputError& error) {
        fault = error.what();
        if (fault.starts_with(path + ": "))
            fault.erase(0, path.size() + 2);
    }
    const int up_axis = up.value_or(view_of_file(path, read).usual_up.value_or(2));
    return finish(std::move(read), settings, up_axis, std::move(fault));
}

} // namespace hemilux
