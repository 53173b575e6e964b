#include "app/gathering/lit_file_output.h"

#include "app/rendering/view.h"
#include "geometry/elementary.h"
#include "io/files/atomic_file.h"
#include "io/gltf/lit_file.h"
#include "io/pictures/picture_files.h"
#include "io/scene_files/obj_places.h"
#include "parallel/workers.h"
#include "radiosity/answers/images/tone.h"
#include "radiosity/answers/lightmaps/lit_picture.h"
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

/// Returns the bytes of a PNG file of light as screens show it, with alpha where it is given.
std::string shown_png(const Image& light, const Display& display, std::span<const float> alpha) {
    std::vector<std::uint8_t> bytes;
    bytes.reserve((alpha.empty() ? 3 : 4) * light.pixels.size());
    for (std::size_t k = 0; k < light.pixels.size(); ++k) {
        const glm::vec3 shown = display(light.pixels[k]);
        for (int c = 0; c < 3; ++c)
            bytes.push_back(srgb_byte(shown[c]));
        if (!alpha.empty())
            bytes.push_back(static_cast<std::uint8_t>(std::lround(255 * alpha[k])));
    }
    return png_of(light.width, light.height, bytes, alpha.empty() ? 3 : 4);
}

/// Returns the exposure for all pictures together, of which some parts are emitted.
double exposure_of(std::span<const Image> lights, std::span<const LitPicture> lit) {
    Image all, emitted;
    for (const Image& light : lights)
        all.pixels.insert(all.pixels.end(), light.pixels.begin(), light.pixels.end());
    for (const LitPicture& picture : lit) {
        all.pixels.insert(all.pixels.end(), picture.light.pixels.begin(),
                          picture.light.pixels.end());
        emitted.pixels.insert(emitted.pixels.end(), picture.emitted.pixels.begin(),
                              picture.emitted.pixels.end());
        emitted.pixels.resize(all.pixels.size());
    }
    return auto_exposure(all, emitted);
}

/// Returns the triangles of a layout with places in [0,1].
std::vector<PlacedTriangle> in_unit_square(const LightmapLayout& layout) {
    std::vector<PlacedTriangle> triangles = layout.triangles;
    for (PlacedTriangle& triangle : triangles)
        for (Vec2& place : triangle.place)
            place /= double(layout.size);
    return triangles;
}

/// Returns the picture of an object without that of its light as it is shown.
LightmapPicture picture_of(const ObjectLightmap& part, const Mesh& mesh, gltf::LitSource& source) {
    LightmapPicture picture{.origins = part.origins, .set = part.set};
    if (!part.name.empty())
        picture.name += " " + part.name;
    if (part.is_new)
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
    const FileBakeSettings& bake = settings.file_bake;
    const Workers workers(settings.options.threads);
    std::vector<LitPicture> lit;
    for (std::size_t k = 0; bake.binding == Binding::lit && k < file.parts.size(); ++k) {
        const auto& [name, origins, layout, finer, set, is_new] = file.parts[k];
        lit.push_back(
            lit_picture(mesh, layout.triangles, lightmaps[k], finer, layout.margin, workers));
    }
    Display display = display_of(settings.view);
    if (!settings.view.exposure && !bake.occlusion)
        display.exposure = exposure_of(lit.empty() ? lightmaps : std::span<const Image>(), lit) *
                           elementary::exp2(settings.view.stops);
    LightmapOfFile of_file{.pictures = {},
                           .binding = bake.binding,
                           .command = settings.from.command,
                           .bake = bake.occlusion ? "ao" : name_of(settings.bake),
                           .exposure = display.exposure};
    for (std::size_t k = 0; k < file.parts.size(); ++k) {
        const Image& lightmap = lightmaps[k];
        LightmapPicture& picture =
            of_file.pictures.emplace_back(picture_of(file.parts[k], mesh, *file.source));
        if (bake.binding == Binding::unlit) {
            picture.png = shown_png(lightmap, display, {});
            continue;
        }
        const float largest = bake.occlusion ? 1 : largest_shown(lightmap);
        picture.intensity = double(largest);
        picture.png = png_of(lightmap.width, lightmap.height, linear_bytes(lightmap, largest));
        if (bake.binding == Binding::lit)
            picture.shown = shown_png(lit[k].light, display, lit[k].cover);
    }
    write_lit_glb(path, *file.source, of_file);
}

std::string how_to_look(const SolveSettings& settings, const FileLightmap& file) {
    if (file.parts.empty())
        return "";
    const std::string& path = settings.outputs.front().path;
    const std::string light =
        file.parts.size() > 1 ? "the .lightmap.exr files" : lightmap_paths(path, file).front();
    if (file.obj)
        return "engines take the light from " + light + ", which lies on the vt of " + path;
    std::string of_set = ", TEXCOORD_" + std::to_string(file.parts.front().set);
    if (std::ranges::any_of(file.parts, [&](const ObjectLightmap& part) {
            return part.set != file.parts.front().set;
        }))
        of_set.clear();
    switch (settings.file_bake.binding) {
    case Binding::lit:
        return "to see it, drag " + path + " into a glTF viewer or import it in Blender; engines " +
               "take the light from " + light + of_set + ", or the material variant 'lightmap'";
    case Binding::unlit:
        return "to see it, drag " + path + " into a glTF viewer or import it in Blender";
    case Binding::lightmap:
        return "viewers without MOZ_lightmap show " + path +
               " as it was before (--bind lit shows " + "it lit); engines take the light from " +
               light + of_set;
    case Binding::texture:
        return "engines take the light from " + light + of_set;
    case Binding::occlusion:
        return "";
    }
    return "";
}

std::vector<std::string> lightmap_paths(const std::string& glb, const FileLightmap& file) {
    std::vector<std::string> paths;
    for (const ObjectLightmap& part : file.parts)
        paths.push_back(part.name.empty() ? lightmap_path(glb) : lightmap_path(glb, part.name));
    return paths;
}

} // namespace hemilux
