#include "app/gathering/lightmap_layout.h"

#include "app/gathering/objects_of_file.h"
#include "app/memory/memory.h"
#include "app/settings/exit_code.h"
#include "app/settings/extension.h"
#include "app/terminal/log.h"
#include "bvh/tracer.h"
#include "io/files/error.h"
#include "io/files/input_file.h"
#include "io/scene_files/obj_places.h"
#include "radiosity/answers/asked/text.h"
#include "radiosity/answers/charts/charts.h"
#include "radiosity/answers/lightmaps/lit_picture.h"
#include "radiosity/paper/scene/mesh.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numeric>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace hemilux {
namespace {

/// Texture coordinates of the file serve where overlaps have at most this share of its texels: by
/// rounding, neighbours may share a few.
constexpr double max_overlap = 1e-3;

constexpr std::size_t max_names = 4;

/// The least lightmap of an object [texels along a side].
constexpr int min_size = 16;

/// Lightmaps of which no size was asked for have so many texels along a side.
constexpr int min_usual_size = 128, max_usual_size = 2048;

/// The largest picture of textures times light [texels along a side], unless the lightmap is
/// larger.
constexpr int max_shown_size = 2048;

/// The area of these sides [m2].
double area_of(const Mesh& mesh, std::span<const ChartSide> sides) {
    double area = 0;
    for (const ChartSide& side : sides)
        area += glm::length(mesh.shape_of(side.facet).area_vector());
    return area / (mesh.frame().scale * mesh.frame().scale);
}

/// Returns the size of a lightmap [texels along a side] of which none was asked for. Four times as
/// many faces have twice as many texels, as shadows have as much more detail. Where that leaves
/// texels larger than 5 cm, it is up to twice as large.
int usual_size(const Mesh& mesh, std::span<const ChartSide> sides) {
    constexpr double of_one_face = 92, per_metre = 20, filled = .8, rounded_to = 32;
    const double by_faces = of_one_face * std::sqrt(std::sqrt(double(sides.size()))),
                 by_area = per_metre * std::sqrt(area_of(mesh, sides) / filled);
    const double size = std::max(by_faces, std::min(by_area, 2 * by_faces));
    return std::clamp(static_cast<int>(rounded_to * std::ceil(size / rounded_to)), min_usual_size,
                      max_usual_size);
}

/// Adds and logs what reading the file again has noticed, where reading it first has not warned of
/// files outside of its folder.
void warn_once(std::vector<std::string>& warnings, const std::vector<std::string>& more,
               Verbosity verbosity) {
    const auto is_outside = [](const std::string& text) {
        return text.find(outside_warning) != std::string::npos;
    };
    if (std::ranges::any_of(warnings, is_outside))
        return;
    log_warnings(verbosity, more);
    warnings.insert(warnings.end(), more.begin(), more.end());
}

std::vector<std::string> names_of(const std::vector<std::uint32_t>& groups, const Scene& scene) {
    std::vector<std::string> names;
    for (const std::uint32_t group : groups)
        names.push_back(scene.groups[group]);
    return names;
}

/// Returns the front of each facet that these primitives show; the brighter sides are found later.
std::vector<ChartSide> fronts_of_file(const Mesh& mesh, const gltf::LitSource& source,
                                      std::span<const std::size_t> origins) {
    const std::vector<std::uint32_t> by_face = gltf::facets_by_face(mesh);
    std::vector<ChartSide> sides;
    for (const std::size_t o : origins) {
        const PrimitiveOrigin& origin = source.origins()[o];
        for (std::uint32_t t = 0; t < origin.faces; ++t)
            if (const std::uint32_t f = by_face[origin.first_face + t]; f != none)
                sides.push_back({f, false});
    }
    return sides;
}

/// Returns what is wrong with places of the file; empty where nothing is.
std::string fault_of(const PlacesOfFile& places, const Mesh& mesh, int size,
                     std::vector<PlacedTriangle>& in_texels) {
    const Scene& scene = mesh.scene();
    if (!places.without.empty())
        return "these objects have no place in it: " +
               list_names(names_of(places.without, scene), max_names);
    if (!places.outside.empty())
        return "these objects reach beyond [0,1]: " +
               list_names(names_of(places.outside, scene), max_names);
    in_texels = places.triangles;
    for (PlacedTriangle& triangle : in_texels)
        for (Vec2& place : triangle.place)
            place *= double(size);
    const TexelMap texels(mesh, in_texels, size);
    std::size_t shown = 0, common = 0;
    for (std::size_t k = 0; k < texels.count(); ++k)
        shown += texels.is_inside(k);
    for (const TexelMap::Overlap& overlap : texels.overlaps())
        common += overlap.texels;
    if (double(common) <= max_overlap * double(shown))
        return "";
    std::string text = "it has overlaps: ";
    for (std::size_t k = 0; k < std::min(texels.overlaps().size(), max_names); ++k) {
        const auto& [facet, other, count] = texels.overlaps()[k];
        const std::string &a = scene.groups[scene.facets[facet].group],
                          &b = scene.groups[scene.facets[other].group];
        text += (k > 0 ? ", " : "") + (a == b ? a + " with itself" : a + " with " + b);
    }
    if (texels.overlaps().size() > max_names)
        text += " and " + std::to_string(texels.overlaps().size() - max_names) + " more";
    return text;
}

/// Finds the layouts of lightmaps one after the other, all of which have to fit into the memory.
class LayoutFinder {
  public:
    /// All arguments must outlive this object.
    LayoutFinder(const SolveSettings& settings, const Mesh& mesh)
        : settings_(settings), bake_(settings.file_bake), mesh_(mesh) {}

    /// Returns the lightmap of these origins; it may be larger where its charts need that, but not
    /// than --lightmap says.
    [[nodiscard]] ObjectLightmap find(gltf::LitSource& source, std::string name,
                                      std::vector<std::size_t> origins, int size);
    /// Returns the lightmap of an OBJ file.
    [[nodiscard]] ObjectLightmap find(const LitObj& file);
    /// Logs which objects have coordinates that the file has not, and why.
    void log_new_sets() const;

  private:
    /// Takes the coordinates that the file has, if it may and nothing is wrong with them.
    template <class FindPlaces>
    [[nodiscard]] bool takes(ObjectLightmap& found, const std::string& coordinates, int size,
                             const FindPlaces& find_places);
    void make_own(ObjectLightmap& found, std::span<const ChartSide> sides, int size);
    [[nodiscard]] LightmapLayout own_layout(std::span<const ChartSide> sides, int size);
    void add_to_memory(int size, int finer);
    void set_finer(ObjectLightmap& found) const;

    const SolveSettings& settings_;
    const FileBakeSettings& bake_;
    const Mesh& mesh_;
    double bytes_ = 0;            ///< of all lightmaps so far, once they are gathered
    int largest_ = 0;             ///< texels along a side
    std::string new_coordinates_; ///< as messages name them
    std::vector<std::string> new_sets_, faults_; ///< names of objects, and what is wrong with those
};

/// One lightmap at a time is gathered, and all are kept until they are written.
void LayoutFinder::add_to_memory(int size, int finer) {
    const unsigned threads = settings_.options.threads;
    bytes_ += bytes_of_lightmap(size, false, threads);
    if (bake_.binding == Binding::lit)
        bytes_ += bytes_of_lightmap(size * finer, false, threads);
    largest_ = std::max(largest_, size);
    const double gathered =
        bytes_of_lightmap(largest_, true, threads) - bytes_of_lightmap(largest_, false, threads);
    const std::optional<std::uint64_t>& limit = settings_.scene.memory;
    if (limit && bytes_ + gathered > double(*limit))
        throw std::runtime_error("a lightmap of " + std::to_string(size) + " x " +
                                 std::to_string(size) + " texels" +
                                 (bake_.per_object ? " after those of other objects" : "") +
                                 " needs more memory than --memory allows");
}

/// Textures keep their texels in the picture that is shown, as far as it has room.
void LayoutFinder::set_finer(ObjectLightmap& found) const {
    if (bake_.binding != Binding::lit)
        return;
    const int most = std::max(1, max_shown_size / found.layout.size);
    found.finer = static_cast<int>(
        std::clamp(std::ceil(texture_density(mesh_, found.layout.triangles)), 1.0, double(most)));
}

LightmapLayout LayoutFinder::own_layout(std::span<const ChartSide> sides, int size) {
    const int most = settings_.lightmap.value_or(max_usual_size);
    AtlasOptions options{.margin = bake_.margin, .max_size = SolveSettings::max_lightmap};
    if (bake_.texels_per_metre)
        options.density = *bake_.texels_per_metre / mesh_.frame().scale;
    else
        options.size = size;
    for (;;) {
        try {
            const Atlas atlas = make_atlas(mesh_, sides, options);
            log_line(settings_.verbosity, Verbosity::verbose,
                     counted(atlas.charts.size(), "chart", "charts") + " in a lightmap of " +
                         std::to_string(atlas.size) + " x " + std::to_string(atlas.size) +
                         " texels");
            return {placed_triangles(mesh_, atlas.charts), atlas.size, bake_.margin};
        } catch (const LightmapTooSmall& error) {
            if (bake_.texels_per_metre || options.size >= most)
                throw std::runtime_error(std::string(error.what()) + "; --lightmap asks for more");
            options.size = std::min(2 * options.size, most);
        }
    }
}

ObjectLightmap LayoutFinder::find(gltf::LitSource& source, std::string name,
                                  std::vector<std::size_t> origins, int size) {
    const std::size_t sets = source.texcoord_sets(), asked = bake_.set.value_or(1);
    ObjectLightmap found{.name = std::move(name), .origins = std::move(origins)};
    const std::vector<ChartSide> sides = fronts_of_file(mesh_, source, found.origins);
    const std::string coordinates = "TEXCOORD_" + std::to_string(asked);
    if ((asked < sets || bake_.set) && takes(found, coordinates, size, [&] {
            return gltf::places_in_set(source, mesh_, sides, asked, found.origins);
        })) {
        found.set = asked;
        return found;
    }
    found.set = std::max<std::size_t>(sets, 1);
    new_coordinates_ = "TEXCOORD_" + std::to_string(found.set);
    make_own(found, sides, size);
    return found;
}

ObjectLightmap LayoutFinder::find(const LitObj& file) {
    ObjectLightmap found;
    std::vector<ChartSide> sides;
    const std::vector<Facet>& facets = mesh_.scene().facets;
    for (std::uint32_t f = 0; f < facets.size(); ++f)
        if (facets[f].face < file.faces().size()) // others are of emitters that were added
            sides.push_back({f, false});
    const int size = settings_.lightmap.value_or(usual_size(mesh_, sides));
    if (bake_.set.value_or(0) > 0)
        throw InputError(file.path(), "an OBJ file has one set of texture coordinates; "
                                      "--lightmap-uv 0 takes that, and new an atlas");
    if ((!file.places().empty() || bake_.set) &&
        takes(found, "vt", size, [&] { return places_in_obj(file, mesh_, sides); }))
        return found;
    new_coordinates_ = file.places().empty() ? "vt" : "vt in place of those of the file";
    make_own(found, sides, size);
    return found;
}

template <class FindPlaces>
bool LayoutFinder::takes(ObjectLightmap& found, const std::string& coordinates, int size,
                         const FindPlaces& find_places) {
    if (bake_.new_set || bake_.texels_per_metre)
        return false;
    found.layout = {{}, size, bake_.margin};
    std::string fault = fault_of(find_places(), mesh_, size, found.layout.triangles);
    if (fault.empty()) {
        set_finer(found);
        add_to_memory(size, found.finer);
        return true;
    }
    fault = coordinates + " of the file cannot be used, as " + fault;
    if (bake_.set)
        throw InputError(settings_.scene.path,
                         fault + "; --lightmap-uv new makes an atlas of its own");
    faults_.push_back(std::move(fault));
    return false;
}

void LayoutFinder::make_own(ObjectLightmap& found, std::span<const ChartSide> sides, int size) {
    found.is_new = true;
    new_sets_.push_back(found.name);
    found.layout = own_layout(sides, size);
    set_finer(found);
    add_to_memory(found.layout.size, found.finer);
}

void LayoutFinder::log_new_sets() const {
    if (new_sets_.empty())
        return;
    std::string text = faults_.empty() ? "" : faults_.front() + "; ";
    if (faults_.size() > 1)
        text +=
            "so it is with " + counted(faults_.size() - 1, "more object", "more objects") + "; ";
    text += bake_.per_object ? "lightmaps of these objects have coordinates of their own, "
                             : "the lightmap has coordinates of its own, ";
    text += new_coordinates_;
    if (bake_.per_object)
        text += ": " + list_names(new_sets_, max_names);
    log_line(settings_.verbosity, Verbosity::normal, text);
}

/// Returns the normals that a file has, as far as they are asked for; warns where it has none.
std::vector<CornerNormals> smooth_normals(const SolveSettings& settings,
                                          std::vector<CornerNormals> normals,
                                          std::vector<std::string>& warnings) {
    if (std::ranges::any_of(normals, [](const CornerNormals& of) { return of != CornerNormals{}; }))
        return normals;
    warnings.push_back(settings.scene.path + ": no face has normals, so --normals smooth changes "
                                             "nothing");
    log_warnings(settings.verbosity, {warnings.back()});
    return {};
}

/// Checks that the faces of an OBJ file are still those that were read.
void check_unchanged(const LitObj& file, const Mesh& mesh) {
    const Scene& scene = mesh.scene();
    for (const Facet& facet : scene.facets) {
        if (facet.face >= file.faces().size())
            continue;
        const auto corners = file.corners_of(facet.face);
        for (const std::uint32_t vertex : facet.vertex)
            if (std::ranges::find(corners, vertex, &LitObj::Corner::vertex) == corners.end())
                throw InputError(file.path(), "the file has changed since it was read");
    }
}

FileLightmap lightmap_of_obj(const SolveSettings& settings, const Mesh& mesh,
                             std::vector<std::string>& warnings) {
    const std::string& path = settings.scene.path;
    FileLightmap found;
    found.obj = std::make_unique<LitObj>(path);
    check_unchanged(*found.obj, mesh);
    const auto folder = [](const std::string& file) {
        std::error_code error;
        return std::filesystem::weakly_canonical(std::filesystem::path(file).parent_path() / ".",
                                                 error);
    };
    if (found.obj->has_libraries() && folder(path) != folder(settings.outputs.front().path)) {
        warnings.push_back(path + ": mtllib names files that lie beside it, and not beside " +
                           settings.outputs.front().path);
        log_warnings(settings.verbosity, {warnings.back()});
    }
    if (settings.file_bake.smooth)
        found.normals = smooth_normals(settings, normals_of_obj(*found.obj, mesh), warnings);
    LayoutFinder finder(settings, mesh);
    found.parts.push_back(finder.find(*found.obj));
    finder.log_new_sets();
    if (found.parts.front().is_new && !found.obj->places().empty()) {
        warnings.push_back(path + ": faces refer to the atlas in place of the vt of the file, by "
                                  "which its textures lie");
        log_warnings(settings.verbosity, {warnings.back()});
    }
    found.parts.front().layout.normals = found.normals;
    return found;
}

/// Names the materials whose occlusion is replaced.
std::vector<std::string> lost_occlusion(const gltf::LitSource& source) {
    std::vector<std::string> names;
    for (const PrimitiveOrigin& origin : source.origins())
        if (const auto material = source.primitive_of(origin).material) {
            const gltf::MaterialInfo& info = source.document().materials[*material];
            const std::string name = "'" + info.name + "'";
            if (info.has_occlusion && std::ranges::find(names, name) == names.end())
                names.push_back(name);
        }
    if (names.empty())
        return {};
    return {source.path() + ": " + list_names(names, 4) +
            (names.size() == 1 ? " has an occlusionTexture, which is"
                               : " have an occlusionTexture, which are") +
            " replaced; --bind texture leaves materials as they are"};
}

} // namespace

double bytes_of_own_file(const SolveSettings& settings) {
    constexpr double copies = 4;
    std::error_code error;
    const auto size = std::filesystem::file_size(settings.scene.path, error);
    return settings.file_bake.asked && !error ? copies * static_cast<double>(size) : 0;
}

FileLightmap lightmap_of_file(const SolveSettings& settings, const Mesh& mesh,
                              std::vector<PrimitiveOrigin> origins,
                              std::vector<std::string>& warnings) {
    const FileBakeSettings& bake = settings.file_bake;
    const std::string& path = settings.scene.path;
    if (is_obj(path))
        return lightmap_of_obj(settings, mesh, warnings);
    FileLightmap found;
    found.source =
        std::make_unique<gltf::LitSource>(path, memory_guard(path, settings.scene.memory),
                                          settings.scene.outside, std::move(origins));
    warn_once(warnings, found.source->warnings(), settings.verbosity);
    if (bake.binding == Binding::occlusion)
        warn_once(warnings, lost_occlusion(*found.source), settings.verbosity);
    constexpr double copies = 4; // buffers, as one, and both as they are written
    memory_guard(path, settings.scene.memory)(copies * found.source->bytes());
    if (bake.smooth)
        found.normals =
            smooth_normals(settings, gltf::normals_of_file(*found.source, mesh), warnings);
    LayoutFinder finder(settings, mesh);
    std::vector<std::size_t> all(found.source->origins().size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    const std::vector<ChartSide> sides = fronts_of_file(mesh, *found.source, all);
    int size = settings.lightmap.value_or(usual_size(mesh, sides));
    if (!bake.per_object) {
        found.parts.push_back(finder.find(*found.source, "", std::move(all), size));
    } else {
        const std::vector<ObjectOfFile> objects = objects_of(*found.source, mesh);
        double largest = 0, whole = 0;
        for (const ObjectOfFile& object : objects) {
            largest = std::max(largest, object.area);
            whole += object.area;
        }
        if (!settings.lightmap) // that of all objects, as dense
            size = std::max(static_cast<int>(size * std::sqrt(largest / whole)), min_size);
        for (const ObjectOfFile& object : objects) {
            const double side = std::ceil(size * std::sqrt(object.area / largest));
            found.parts.push_back(finder.find(*found.source, object.name, object.origins,
                                              std::max(static_cast<int>(side), min_size)));
        }
    }
    finder.log_new_sets();
    for (ObjectLightmap& part : found.parts)
        part.layout.normals = found.normals;
    return found;
}

} // namespace hemilux
