#include "app/gathering/lightmap_layout.h"

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
#include <filesystem>
#include <map>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace hemilux {
namespace {

/// Texture coordinates of the file serve where overlaps have at most this share of its texels: by
/// rounding, neighbours may share a few.
constexpr double max_overlap = 1e-3;

constexpr std::size_t max_names = 4;

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

/// Returns the front of each facet that a primitive of the file shows; the brighter sides are found
/// later.
std::vector<ChartSide> fronts_of_file(const Mesh& mesh,
                                      const std::vector<PrimitiveOrigin>& origins) {
    const std::vector<std::uint32_t> by_face = gltf::facets_by_face(mesh);
    std::vector<ChartSide> sides;
    for (const PrimitiveOrigin& origin : origins)
        for (std::uint32_t t = 0; t < origin.faces; ++t)
            if (const std::uint32_t f = by_face[origin.first_face + t]; f != none)
                sides.push_back({f, false});
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

void check_memory_of(int size, const SolveSettings& settings) {
    const std::optional<std::uint64_t>& limit = settings.scene.memory;
    if (limit && bytes_of_lightmap(size, true) > double(*limit))
        throw std::runtime_error("a lightmap of " + std::to_string(size) + " x " +
                                 std::to_string(size) +
                                 " texels needs more memory than --memory allows");
}

LightmapLayout own_layout(const SolveSettings& settings, const Mesh& mesh,
                          std::span<const ChartSide> sides) {
    const FileBakeSettings& bake = settings.file_bake;
    AtlasOptions options{.margin = bake.margin, .max_size = SolveSettings::max_lightmap};
    if (bake.texels_per_metre)
        options.density = *bake.texels_per_metre / mesh.frame().scale;
    else
        options.size = settings.lightmap.value_or(FileBakeSettings::default_size);
    try {
        const Atlas atlas = make_atlas(mesh, sides, options);
        check_memory_of(atlas.size, settings);
        log_line(settings.verbosity, Verbosity::verbose,
                 counted(atlas.charts.size(), "chart", "charts") + " in a lightmap of " +
                     std::to_string(atlas.size) + " x " + std::to_string(atlas.size) + " texels");
        return {placed_triangles(mesh, atlas.charts), atlas.size, bake.margin, {}};
    } catch (const LightmapTooSmall& error) {
        throw std::runtime_error(std::string(error.what()) + "; --lightmap asks for more");
    }
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
    const int size = settings.lightmap.value_or(FileBakeSettings::default_size);
    FileLightmap found;
    found.source =
        std::make_unique<gltf::LitSource>(path, memory_guard(path, settings.scene.memory),
                                          settings.scene.outside, std::move(origins));
    warn_once(warnings, found.source->warnings(), settings.verbosity);
    constexpr double copies = 4; // buffers, as one, and both as they are written
    memory_guard(path, settings.scene.memory)(copies * found.source->bytes());
    const std::vector<ChartSide> sides = fronts_of_file(mesh, found.source->origins());
    std::vector<CornerNormals> normals;
    if (bake.smooth)
        normals = smooth_normals(settings, *found.source, mesh, warnings);
    const std::size_t sets = found.source->texcoord_sets(), asked = bake.set.value_or(1);
    std::string fault;
    if (!bake.new_set && !bake.texels_per_metre && (asked < sets || bake.set)) {
        check_memory_of(size, settings);
        const gltf::PlacesOfFile places = gltf::places_in_set(*found.source, mesh, sides, asked);
        LightmapLayout layout{{}, size, bake.margin, {}};
        fault = fault_of(places, mesh, size, layout.triangles);
        if (fault.empty()) {
            found.layout = std::move(layout);
            found.layout.normals = std::move(normals);
            found.set = asked;
            return found;
        }
        fault = "TEXCOORD_" + std::to_string(asked) + " of the file cannot be used, as " + fault;
        if (bake.set)
            throw InputError(path, fault + "; --lightmap-uv new makes an atlas of its own");
    }
    found.set = std::max<std::size_t>(sets, 1);
    found.is_new = true;
    log_line(settings.verbosity, Verbosity::normal,
             (fault.empty() ? "" : fault + "; ") + "the lightmap has coordinates of its own, " +
                 "TEXCOORD_" + std::to_string(found.set));
    found.layout = own_layout(settings, mesh, sides);
    found.layout.normals = std::move(normals);
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
