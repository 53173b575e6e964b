#include "app/gathering/lit_file_output.h"

#include "app/rendering/view.h"
#include "geometry/elementary.h"
#include "io/gltf/lit_file.h"
#include "io/pictures/exr.h"
#include "radiosity/paper/sampling/rng.h"

#include <algorithm>
#include <cmath>
#include <utility>
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

void write_lit_file(const SolveSettings& settings, const std::string& path, const Mesh& mesh,
                    const FileLightmap& file, const Image& lightmap) {
    const Binding binding = settings.file_bake.binding;
    const bool is_occlusion = settings.file_bake.occlusion;
    Display display = display_of(settings.view);
    if (!settings.view.exposure && !is_occlusion)
        display.exposure = auto_exposure(lightmap) * elementary::exp2(settings.view.stops);
    const float largest = is_occlusion ? 1 : largest_shown(lightmap);
    const bool is_shown = binding == Binding::unlit;
    const std::string png =
        png_of(lightmap.width, lightmap.height,
               is_shown ? shown_bytes(lightmap, display) : linear_bytes(lightmap, largest));
    LightmapOfFile of_file{.png = png,
                           .binding = binding,
                           .intensity = is_shown ? 1 : double(largest),
                           .set = file.set,
                           .command = settings.from.command,
                           .bake = is_occlusion ? "ao" : name_of(settings.bake),
                           .exposure = display.exposure};
    if (file.is_new) {
        std::vector<PlacedTriangle> in_unit_square = file.layout.triangles;
        for (PlacedTriangle& triangle : in_unit_square)
            for (Vec2& place : triangle.place)
                place /= double(file.layout.size);
        of_file.coordinates = gltf::atlas_coordinates(*file.source, mesh, in_unit_square);
    }
    write_lit_glb(path, *file.source, of_file);
}

void write_lightmap_exr(const SolveSettings& settings, const std::string& path,
                        const Image& lightmap) {
    std::vector<ExrChannel> channels;
    add_half_exr_channels(channels, lightmap);
    write_exr(lightmap_path(path), lightmap.width, lightmap.height, std::move(channels),
              settings.from);
}

} // namespace hemilux
