#include "app/memory/memory.h"

#include "io/files/input_file.h"
#include "parallel/workers.h"
#include "radiosity/answers/asked/text.h"
#include "radiosity/engine/rays/point_emitter.h"
#include "radiosity/light/layers/coplanar_overlaps.h"
#include "radiosity/light/textures/scene_textures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <set>
#include <stdexcept>
#include <system_error>

#include <unistd.h>
#if defined(__linux__)
#include <sys/sysinfo.h>
#endif

namespace hemilux {

namespace {

/// The program itself, its libraries and threads.
constexpr double bytes_of_program = 12e6;
/// Arrays that grow keep the old one until the new one is filled.
constexpr double growth = 2;
/// The bytes per triangle: boxes while the tree is built, and a leaf's share.
constexpr double bytes_per_triangle = 150;
/// The bytes of a stepwise method: solution, spread, one step.
constexpr double bytes_per_solution = 241;
/// The bytes of corners, planes and boxes of both sides of a facet, and of its edges.
constexpr double bytes_of_analysis = 350;
/// The bytes per pixel: the picture, that of emission and the list by which the exposure is chosen;
/// or its numbers once more and a file that grows. For `compare` there are the reference, the
/// method and their difference.
constexpr double bytes_per_pixel = 36, bytes_per_compared_pixel = 64;
/// The bytes for a quarter of a point at which indirect light is gathered. In the rows that a
/// thread has at once, there are those for the light of a pixel in its parts, and of more surfaces
/// at edges.
constexpr double bytes_per_gathered_pixel = 56, bytes_per_pixel_of_rows = 120, rows_per_thread = 36;
/// The bytes per pixel of the layers of an .exr file, and of the file.
constexpr double bytes_per_layered_pixel = 60;
/// The bytes per pixel or texel of a layer of --layers: its light, and that of the file.
constexpr double bytes_per_pixel_of_layer = 40;
/// The bytes of a point of --points, and of its light in a layer.
constexpr double bytes_per_point = 256, bytes_per_point_of_layer = 64;

/// The bytes per patch of what is written, with what is made for it.
namespace of_patch {
constexpr double table = 50, mesh = 200, vtu = 550, report = 430;
constexpr double layer = 200; ///< light, errors and slopes, and what is written of them
constexpr double state = 300, copies_of_state = 3; ///< of a checkpoint
} // namespace of_patch

/// The bytes of rays that wait to be summed.
constexpr double bytes_of_ray_batches = 32e6;

/// Returns the bytes of the rows of pixels or texels that are kept until they are finished.
double bytes_of_rows(double width, double height, unsigned threads) {
    return bytes_per_pixel_of_rows * width *
           std::min(height, rows_per_thread * Workers(threads).threads());
}

struct Lengths {
    double along, across;
};

double length(const Scene& scene, const Facet& facet, std::size_t a, std::size_t b) {
    return glm::length(scene.vertices[facet.vertex[b]] - scene.vertices[facet.vertex[a]]);
}

/// Returns the sides by which a facet is divided (Mesh). The shortest side of a triangle decides
/// how many columns there are, and there are as many rows as columns or more.
Lengths lengths_of(const Scene& scene, const Facet& facet) {
    if (!facet.is_triangle())
        return {std::max(length(scene, facet, 0, 1), length(scene, facet, 3, 2)),
                std::max(length(scene, facet, 0, 3), length(scene, facet, 1, 2))};
    std::array<double, 3> sides{length(scene, facet, 0, 1), length(scene, facet, 1, 2),
                                length(scene, facet, 2, 0)};
    std::ranges::sort(sides);
    return {sides[2], 2 * sides[0] >= sides[2] ? sides[2] : sides[0]};
}

double pieces(double length, double max_edge) {
    return std::max(1.0, std::ceil(length / max_edge));
}

double bytes_of(const Method& method, const SolveOptions& options, double patches) {
    return bytes_per_solution * patches + (method.bytes ? method.bytes(options, patches) : 0);
}

std::string rounded(double bytes) {
    return bytes < 1e18 ? byte_size(static_cast<std::uint64_t>(bytes))
                        : formatted("%.2g bytes", bytes);
}

/// Returns the bytes of pictures, each once, and of what corners have for them.
std::vector<double> bytes_of_textures(const Scene& scene) {
    std::set<const Texture*> textures;
    for (const MaterialTextures& of_material : textures_of(scene).of_material)
        for (const TextureMap* const map : {&of_material.reflectance, &of_material.emission})
            textures.insert(map->texture.get());
    std::vector<double> bytes;
    for (const Texture* const texture : textures)
        bytes.push_back(texture ? texture->bytes() : 0);
    for (const std::vector<Texcoords>& set : textures_of(scene).texcoords)
        bytes.push_back(static_cast<double>(set.size() * sizeof(Texcoords)));
    bytes.push_back(static_cast<double>(textures_of(scene).tints.size() * sizeof(Tints)));
    return bytes;
}

/// Returns the memory of the machine, swap included; as much as there is of numbers where that is
/// not known.
double bytes_of_machine() {
#if defined(__linux__)
    if (struct sysinfo info{}; ::sysinfo(&info) == 0)
        return (static_cast<double>(info.totalram) + static_cast<double>(info.totalswap)) *
               static_cast<double>(info.mem_unit);
#endif
    const long pages = ::sysconf(_SC_PHYS_PAGES), bytes = ::sysconf(_SC_PAGESIZE);
    return pages > 0 && bytes > 0 ? static_cast<double>(pages) * static_cast<double>(bytes)
                                  : std::numeric_limits<double>::max();
}

} // namespace

std::optional<std::uint64_t> parse_bytes(std::string_view text) {
    constexpr std::string_view units = "kMGT";
    double unit = 1;
    if (const std::size_t at = text.empty() ? text.npos : units.find(text.back());
        at != text.npos) {
        unit = std::ldexp(1.0, 10 * (static_cast<int>(at) + 1));
        text.remove_suffix(1);
    }
    const std::optional<double> number = parse_number(text);
    const double bytes = number.value_or(0) * unit;
    constexpr double most = 9e18;
    return bytes >= 1 && bytes <= most ? std::optional(static_cast<std::uint64_t>(bytes))
                                       : std::nullopt;
}

double patches_of(const Scene& scene, const MeshOptions& options) {
    double patches = 0;
    for (const Facet& facet : scene.facets) {
        const double sides = options.two_sided || facet.two_sided ? 2 : 1;
        const auto [along, across] = lengths_of(scene, facet);
        const bool is_divided = options.max_edge > 0 && !scene.materials[facet.material].is_far;
        patches += is_divided
                       ? sides * pieces(along, options.max_edge) * pieces(across, options.max_edge)
                       : sides;
    }
    return patches;
}

MemoryNeed memory_need(const Scene& scene, const MeshOptions& mesh, const SolveOptions& options,
                       std::span<const Method* const> methods, const Method* before) {
    const double patches = patches_of(scene, mesh);
    const auto facets = static_cast<double>(scene.facets.size());
    const auto vertices = static_cast<double>(scene.vertices.size());
    MemoryNeed need;
    need.scene = bytes_of_program + growth * (sizeof(Vec3) * vertices + sizeof(Facet) * facets);
    need.mesh =
        sizeof(Patch) * patches + sizeof(Vec3) * vertices + (sizeof(FacetCorners) + 48) * facets;
    for (const double bytes : bytes_of_textures(scene))
        need.scene += bytes;
    if (!textures_of(scene).of_material.empty())
        need.mesh += sizeof(Material) * patches;
    need.pairs =
        OverlapLimits::bytes_per_pair * static_cast<double>(OverlapLimits::of(scene).pairs);
    need.analysis = bytes_of_analysis * facets;
    for (const Facet& facet : scene.facets)
        need.tree += bytes_per_triangle * (facet.is_triangle() ? 1 : 2);
    for (const Method* const method : methods)
        need.method += bytes_of(*method, options, patches);
    if (!point_emitters_of(scene).empty()) { // a mesh and irradiances of its own for each method
        constexpr double per_patch = sizeof(Patch) + sizeof(Material) + 8 * sizeof(Vec3);
        need.method += static_cast<double>(methods.size()) * per_patch * patches;
    }
    if (before)
        need.method = std::max(need.method, bytes_of(*before, options, patches));
    need.method += bytes_of_ray_batches;
    return need;
}

double bytes_of_picture(PixelSize size, bool gathered, unsigned threads) {
    const double width = size.width, height = size.height;
    return bytes_per_pixel * width * height +
           (gathered
                ? bytes_per_gathered_pixel * width * height + bytes_of_rows(width, height, threads)
                : 0);
}

double bytes_of_lightmap(int size, bool gathered, unsigned threads) {
    // What a texel shows, and the picture and its files; its share of a point that gathers, its
    // light.
    constexpr double per_texel = 16 + 36, per_gathered_texel = 64 + 16;
    return per_texel * size * size +
           (gathered ? per_gathered_texel * size * size + bytes_of_rows(size, size, threads) : 0);
}

double bytes_of_points(std::size_t points, unsigned gather) {
    constexpr double bytes_per_ray = 16, rays_per_block = 1 << 20;
    const double rays_per_point = double(gather) * PointSettings::rays_per_gather_ray;
    const auto count = static_cast<double>(points);
    return bytes_per_point * count +
           bytes_per_ray * std::min(rays_per_block + rays_per_point, count * rays_per_point);
}

double bytes_of_results(const SolveSettings& settings, double patches) {
    double bytes = bytes_of_lightmap(settings.lightmap.value_or(0), settings.gather_pictures,
                                     settings.options.threads);
    bool has_picture = !settings.error_map.empty(), has_layers = false;
    for (const Output& output : settings.outputs) {
        has_picture |= is_picture(output.kind);
        has_layers |= output.kind == OutputKind::exr;
        const bool is_mesh = output.kind == OutputKind::ply || output.kind == OutputKind::glb;
        bytes += patches * (output.kind == OutputKind::vtu ? of_patch::vtu
                            : is_mesh                      ? of_patch::mesh
                                                           : of_patch::table);
    }
    if (!settings.report.empty())
        bytes += patches * of_patch::report;
    if (!settings.checkpoint.path.empty())
        bytes +=
            of_patch::copies_of_state *
            (patches * of_patch::state + bytes_of(*settings.method, settings.options, patches));
    const double pixels = static_cast<double>(settings.view.size.width) * settings.view.size.height;
    return bytes +
           (has_picture ? bytes_of_picture(settings.view.size, settings.gather_pictures,
                                           settings.options.threads)
                        : 0) +
           (has_layers ? bytes_per_layered_pixel * pixels : 0);
}

double bytes_of_layers(const SolveSettings& settings, const MemoryNeed& run, const LayerSize& size,
                       std::size_t layers) {
    const auto is_exr = [](const Output& output) { return output.kind == OutputKind::exr; };
    const bool has_picture = std::ranges::any_of(settings.outputs, is_exr);
    const double pixels =
        has_picture ? double(settings.view.size.width) * settings.view.size.height : 0;
    const double of_layer = of_patch::layer * size.patches +
                            bytes_per_point_of_layer * size.points +
                            bytes_per_pixel_of_layer * (pixels + size.texels);
    // One layer at a time is lit and gathered, on a copy of all that the run has.
    return double(layers) * of_layer + run.scene + run.mesh + bytes_per_solution * size.patches +
           (has_picture ? bytes_of_picture(settings.view.size, settings.gather_pictures,
                                           settings.options.threads)
                        : 0) +
           bytes_of_points(static_cast<std::size_t>(size.points), settings.rays_of_gather());
}

double bytes_of_compared_pictures(PixelSize size) {
    return bytes_per_compared_pixel * static_cast<double>(size.width) * size.height;
}

std::function<void(double bytes)> memory_guard(const std::string& path,
                                               std::optional<std::uint64_t> limit) {
    const double most = limit ? static_cast<double>(*limit) : bytes_of_machine();
    const std::string whose = limit ? ", and --memory is " : ", and this machine has ";
    return [path, most, whose](double bytes) {
        if (const double need = bytes_of_program + bytes; need > most)
            throw std::runtime_error(path + ": needs " + rounded(need) + " to be read alone" +
                                     whose + rounded(most));
    };
}

void bound_inputs(std::optional<std::uint64_t> limit) {
    guard_inputs(
        [limit](const std::string& path, double bytes) { memory_guard(path, limit)(bytes); });
}

void check_memory_to_read(const std::string& path, std::optional<std::uint64_t> limit) {
    std::error_code error;
    const std::uintmax_t size = std::filesystem::file_size(path, error);
    memory_guard(path, limit)(error ? 0 : static_cast<double>(size));
}

void check_memory(const MemoryNeed& need, std::optional<std::uint64_t> limit,
                  const std::string& path, const std::string& advice) {
    if (!limit || need.all() <= static_cast<double>(*limit))
        return;
    throw std::runtime_error(path + ": needs about " + rounded(need.all()) + " (scene " +
                             rounded(need.scene) + ", patches " + rounded(need.mesh) + ", tree " +
                             rounded(need.tree) + ", method " + rounded(need.method) +
                             ", results " + rounded(need.results) + "), and --memory is " +
                             rounded(static_cast<double>(*limit)) + "; " + advice);
}

std::function<void(double bytes)> memory_guard(const MemoryNeed& need,
                                               std::optional<std::uint64_t> limit,
                                               const std::string& path, const std::string& advice) {
    if (!limit)
        return {};
    return [need, limit, path, advice](double bytes) {
        MemoryNeed grown = need;
        grown.results += bytes;
        check_memory(grown, limit, path, advice);
    };
}

} // namespace hemilux
