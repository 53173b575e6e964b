#include "app/gathering/lightmap_layout.h"

#include "app/gathering/objects_of_file.h"
#include "app/memory/memory.h"
#include "app/settings/exit_code.h"
#include "app/settings/extension.h"
#include "app/settings/text.h"
#include "app/terminal/log.h"
#include "bvh/tracer.h"
#include "io/files/error.h"
#include "io/files/input_file.h"
#include "io/files/text_words.h"
#include "io/lightmaps/charts.h"
#include "radiosity/paper/scene/mesh.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
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
std::string fault_of(const gltf::PlacesOfFile& places, const Mesh& mesh, int size,
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
    LayoutFinder(const SolveSettings& settings, const Mesh& mesh, gltf::LitSource& source)
        : settings_(settings), bake_(settings.file_bake), mesh_(mesh), source_(source) {}

    /// Returns the lightmap of these origins; it may be larger where its charts need that, but not
    /// than --lightmap says.
    [[nodiscard]] ObjectLightmap find(std::string name, std::vector<std::size_t> origins, int size);
    /// Logs which objects have coordinates that the file has not, and why.
    void log_new_sets() const;

  private:
    [[nodiscard]] LightmapLayout own_layout(std::span<const ChartSide> sides, int size);
    void add_to_memory(int size);

    const SolveSettings& settings_;
    const FileBakeSettings& bake_;
    const Mesh& mesh_;
    gltf::LitSource& source_;
    double bytes_ = 0; ///< of all lightmaps so far, once they are gathered
    int largest_ = 0;  ///< texels along a side
    std::vector<std::string> new_sets_, faults_; ///< names of objects, and what is wrong with those
};

/// One lightmap at a time is gathered, and all are kept until they are written.
void LayoutFinder::add_to_memory(int size) {
    bytes_ += bytes_of_lightmap(size, false);
    largest_ = std::max(largest_, size);
    const double gathered = bytes_of_lightmap(largest_, true) - bytes_of_lightmap(largest_, false);
    const std::optional<std::uint64_t>& limit = settings_.scene.memory;
    if (limit && bytes_ + gathered > double(*limit))
        throw std::runtime_error("a lightmap of " + std::to_string(size) + " x " +
                                 std::to_string(size) + " texels" +
                                 (bake_.per_object ? " after those of other objects" : "") +
                                 " needs more memory than --memory allows");
}

LightmapLayout LayoutFinder::own_layout(std::span<const ChartSide> sides, int size) {
    const int most = settings_.lightmap.value_or(FileBakeSettings::default_size);
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

ObjectLightmap LayoutFinder::find(std::string name, std::vector<std::size_t> origins, int size) {
    const std::size_t sets = source_.texcoord_sets(), asked = bake_.set.value_or(1);
    ObjectLightmap found{.name = std::move(name), .origins = std::move(origins)};
    const std::vector<ChartSide> sides = fronts_of_file(mesh_, source_, found.origins);
    if (!bake_.new_set && !bake_.texels_per_metre && (asked < sets || bake_.set)) {
        found.layout = {{}, size, bake_.margin};
        std::string fault =
            fault_of(gltf::places_in_set(source_, mesh_, sides, asked, found.origins), mesh_, size,
                     found.layout.triangles);
        found.set = asked;
        if (fault.empty()) {
            add_to_memory(size);
            return found;
        }
        fault = "TEXCOORD_" + std::to_string(asked) + " of the file cannot be used, as " + fault;
        if (bake_.set)
            throw InputError(source_.path(),
                             fault + "; --lightmap-uv new makes an atlas of its own");
        faults_.push_back(std::move(fault));
    }
    found.set = std::max<std::size_t>(sets, 1);
    found.is_new = true;
    new_sets_.push_back(found.name);
    found.layout = own_layout(sides, size);
    add_to_memory(found.layout.size);
    return found;
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
    text += "TEXCOORD_" + std::to_string(std::max<std::size_t>(source_.texcoord_sets(), 1));
    if (bake_.per_object)
        text += ": " + list_names(new_sets_, max_names);
    log_line(settings_.verbosity, Verbosity::normal, text);
}

/// Returns the normals of the file; warns where it has none.
std::vector<CornerNormals> smooth_normals(const SolveSettings& settings, gltf::LitSource& source,
                                          const Mesh& mesh, std::vector<std::string>& warnings) {
    std::vector<CornerNormals> normals = gltf::normals_of_file(source, mesh);
    if (std::ranges::any_of(normals, [](const CornerNormals& of) { return of != CornerNormals{}; }))
        return normals;
    warnings.push_back(settings.scene.path + ": no primitive has normals, so --normals smooth "
                                             "changes nothing");
    log_warnings(settings.verbosity, {warnings.back()});
    return {};
}

} // namespace

double bytes_of_own_file(const SolveSettings& settings) {
    constexpr double copies = 4;
    std::error_code error;
    const auto size = std::filesystem::file_size(settings.scene.path, error);
    return settings.file_bake.asked && !error ? copies * static_cast<double>(size) : 0;
}

TexelMap texels_of(const LightmapLayout& layout, std::vector<PlacedTriangle> triangles,
                   const Mesh& mesh, const Tracer& tracer) {
    TexelMap texels(mesh, std::move(triangles), layout.size);
    if (!layout.normals.empty())
        texels.set_normals(layout.normals, tracer);
    return texels;
}

FileLightmap lightmap_of_file(const SolveSettings& settings, const Mesh& mesh,
                              std::vector<PrimitiveOrigin> origins,
                              std::vector<std::string>& warnings) {
    const FileBakeSettings& bake = settings.file_bake;
    const std::string& path = settings.scene.path;
    FileLightmap found;
    found.source =
        std::make_unique<gltf::LitSource>(path, memory_guard(path, settings.scene.memory),
                                          settings.scene.outside, std::move(origins));
    warn_once(warnings, found.source->warnings(), settings.verbosity);
    constexpr double copies = 4; // buffers, as one, and both as they are written
    memory_guard(path, settings.scene.memory)(copies * found.source->bytes());
    if (bake.smooth)
        found.normals = smooth_normals(settings, *found.source, mesh, warnings);
    const int size = settings.lightmap.value_or(FileBakeSettings::default_size);
    LayoutFinder finder(settings, mesh, *found.source);
    if (!bake.per_object) {
        std::vector<std::size_t> all(found.source->origins().size());
        std::iota(all.begin(), all.end(), std::size_t{0});
        found.parts.push_back(finder.find("", std::move(all), size));
    } else {
        const std::vector<ObjectOfFile> objects = objects_of(*found.source, mesh);
        double largest = 0;
        for (const ObjectOfFile& object : objects)
            largest = std::max(largest, object.area);
        for (const ObjectOfFile& object : objects) {
            const double side = std::ceil(size * std::sqrt(object.area / largest));
            found.parts.push_back(finder.find(object.name, object.origins,
                                              std::max(static_cast<int>(side), min_size)));
        }
    }
    finder.log_new_sets();
    for (ObjectLightmap& part : found.parts)
        part.layout.normals = found.normals;
    return found;
}

void show_brighter_sides(const Mesh& mesh, const Solution& solution,
                         std::vector<PlacedTriangle>& triangles) {
    const Scene& scene = mesh.scene();
    std::vector<double> of_side(2 * scene.facets.size()); // light by facet and side
    for (std::uint32_t i = 0; i < mesh.patches().size(); ++i) {
        const Patch& patch = mesh.patches()[i];
        const Vec3 light = solution.radiosity[i] - mesh.material(patch).emission;
        of_side[2 * std::size_t{patch.facet} + (patch.back ? 1 : 0)] +=
            patch.area * (light.x + light.y + light.z);
    }
    std::map<std::uint32_t, double> more_behind; // by chart
    for (const PlacedTriangle& triangle : triangles)
        if (mesh.has_back(triangle.facet) && !triangle.second_half)
            more_behind[triangle.chart] += of_side[2 * std::size_t{triangle.facet} + 1] -
                                           of_side[2 * std::size_t{triangle.facet}];
    for (PlacedTriangle& triangle : triangles)
        if (const auto found = more_behind.find(triangle.chart); found != more_behind.end())
            triangle.back = mesh.has_back(triangle.facet) && found->second > 0;
}

} // namespace hemilux
