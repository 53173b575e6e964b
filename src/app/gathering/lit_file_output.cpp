#include "app/gathering/lit_file_output.h"

#include "app/rendering/view.h"
#include "geometry/elementary.h"
#include "io/files/atomic_file.h"
#include "io/gltf/lit_file.h"
#include "io/lightmaps/obj_places.h"
#include "radiosity/paper/sampling/rng.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

namespace hemilux {
namespace {

/// Returns the largest number that a texel may show: one in so many of those with light is
/// brighter, so that a small bright place leaves numbers for all else.
float largest_shown(const Image& lightmap) {
    constexpr std::size_t one_in = 1000;
    std::vector<float> light;
    for (const glm::vec3& texel : lightmap.pixels)
        if (const float most = std::max({texel.r, texel.g, texel.b});
            most > 0 && std::isfinite(most))
            light.push_back(most);
    if (light.empty())
        return 1;
    const auto rank = static_cast<std::ptrdiff_t>(light.size() - 1 - light.size() / one_in);
    std::nth_element(light.begin(), light.begin() + rank, light.end());
    return light[static_cast<std::size_t>(rank)];
}

/// Returns linear bytes. They are rounded at random, so that the mean over some texels is right
/// where a step of a byte is large beside the light.
std::vector<std::uint8_t> linear_bytes(const Image& lightmap, float largest) {
    std::vector<std::uint8_t> bytes;
    bytes.reserve(3 * lightmap.pixels.size());
    for (std::size_t k = 0; k < lightmap.pixels.size(); ++k) {
        const double random = Rng(hash_words({k})).uniform();
        for (int c = 0; c < 3; ++c) {
            const double share = std::clamp(double(lightmap.pixels[k][c]) / largest, 0.0, 1.0);
            bytes.push_back(static_cast<std::uint8_t>(255 * share + random * (share < 1)));
        }
    }
    return bytes;
}

std::vector<std::uint8_t> shown_bytes(const Image& lightmap, const Display& display) {
    std::vector<std::uint8_t> bytes;
    bytes.reserve(3 * lightmap.pixels.size());
    for (const glm::vec3& texel : lightmap.pixels) {
        const glm::vec3 shown = display(texel);
        for (int c = 0; c < 3; ++c)
            bytes.push_back(srgb_byte(shown[c]));
    }
    return bytes;
}

} // namespace

namespace {

/// Returns the exposure for all lightmaps together.
double exposure_of(std::span<const Image> lightmaps) {
    if (lightmaps.size() == 1)
        return auto_exposure(lightmaps.front());
    Image all;
    for (const Image& lightmap : lightmaps)
        all.pixels.insert(all.pixels.end(), lightmap.pixels.begin(), lightmap.pixels.end());
    return auto_exposure(all);
}

/// Returns the triangles of a layout with places in [0,1].
std::vector<PlacedTriangle> in_unit_square(const LightmapLayout& layout) {
    std::vector<PlacedTriangle> triangles = layout.triangles;
    for (PlacedTriangle& triangle : triangles)
        for (Vec2& place : triangle.place)
            place /= double(layout.size);
    return triangles;
}

LightmapPicture picture_of(const ObjectLightmap& part, const Image& lightmap, const Mesh& mesh,
                           gltf::LitSource& source, const SolveSettings& settings,
                           const Display& display) {
    const bool is_shown = settings.file_bake.binding == Binding::unlit;
    const float largest = settings.file_bake.occlusion ? 1 : largest_shown(lightmap);
    LightmapPicture picture{
        .png = png_of(lightmap.width, lightmap.height,
                      is_shown ? shown_bytes(lightmap, display) : linear_bytes(lightmap, largest)),
        .origins = part.origins,
        .intensity = is_shown ? 1 : double(largest),
        .set = part.set};
    if (!part.name.empty())
        picture.name += " " + part.name;
    if (!part.is_new)
        return picture;
    picture.coordinates =
        gltf::atlas_coordinates(source, mesh, in_unit_square(part.layout), part.origins);
    return picture;
}

/// Writes the OBJ file as it is, or with an atlas as its texture coordinates.
void write_lit_obj(const std::string& path, const Mesh& mesh, const LitObj& file,
                   const ObjectLightmap& part) {
    write_atomically(path, part.is_new ? text_with_atlas(file, mesh, in_unit_square(part.layout))
                                       : file.text());
}

} // namespace

void write_lit_file(const SolveSettings& settings, const std::string& path, const Mesh& mesh,
                    const FileLightmap& file, std::span<const Image> lightmaps) {
    if (file.obj)
        return write_lit_obj(path, mesh, *file.obj, file.parts.front());
    const bool is_occlusion = settings.file_bake.occlusion;
    Display display = display_of(settings.view);
    if (!settings.view.exposure && !is_occlusion)
        display.exposure = exposure_of(lightmaps) * elementary::exp2(settings.view.stops);
    LightmapOfFile of_file{.pictures = {},
                           .binding = settings.file_bake.binding,
                           .command = settings.from.command,
                           .bake = is_occlusion ? "ao" : name_of(settings.bake),
                           .exposure = display.exposure};
    for (std::size_t k = 0; k < file.parts.size(); ++k)
        of_file.pictures.push_back(
            picture_of(file.parts[k], lightmaps[k], mesh, *file.source, settings, display));
    write_lit_glb(path, *file.source, of_file);
}

std::vector<std::string> lightmap_paths(const std::string& glb, const FileLightmap& file) {
    std::vector<std::string> paths;
    for (const ObjectLightmap& part : file.parts)
        paths.push_back(part.name.empty() ? lightmap_path(glb) : lightmap_path(glb, part.name));
    return paths;
}

} // namespace hemilux
