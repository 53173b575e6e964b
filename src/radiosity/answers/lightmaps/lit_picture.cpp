#include "radiosity/answers/lightmaps/lit_picture.h"

#include "parallel/workers.h"
#include "radiosity/answers/lightmaps/lightmap_gather.h"
#include "radiosity/light/textures/scene_textures.h"
#include "radiosity/light/textures/textured_facets.h"
#include "radiosity/paper/scene/mesh.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace hemilux {
namespace {

double twice_area(const std::array<Vec2, 3>& place) {
    return std::abs(cross(place[1] - place[0], place[2] - place[0]));
}

/// Returns the texels of a texture on a triangle, twice.
double twice_texels(const SceneTextures& textures, const TextureMap& map,
                    const PlacedTriangle& triangle) {
    if (!map.texture)
        return 0;
    const Texcoords& uv = textures.texcoords[map.set][triangle.facet];
    std::array<Vec2, 3> place;
    for (std::size_t k = 0; k < 3; ++k)
        place[k] = map.place(Vec2(uv[triangle.second_half && k > 0 ? k + 1 : k])) *
                   Vec2(map.texture->width(), map.texture->height());
    return twice_area(place);
}

/// Returns the light at a place between the middles of texels.
Vec3 light_at(const Image& light, const Vec2& place) {
    const Vec2 last(light.width - 1, light.height - 1);
    const Vec2 at = glm::clamp(place - .5, Vec2(0.0), last), low = glm::floor(at), share = at - low,
               high = glm::min(low + 1.0, last);
    const auto row = [&](double y) {
        return glm::mix(Vec3(light.at(int(low.x), int(y))), Vec3(light.at(int(high.x), int(y))),
                        share.x);
    };
    return glm::mix(row(low.y), row(high.y), share.y);
}

/// What a texel of the picture shows.
struct Shown {
    Colours colours{Vec3(0.0), Vec3(0.0)};
    double cover = 0;
};

/// Returns the mean over places in a texel, where colours vary.
Shown shown_at(const Mesh& mesh, const TexelMap& texels, int x, int y, int samples) {
    const std::size_t texel = texels.index(x, y);
    const SurfacePoint middle = texels.point(texel);
    const Scene& scene = mesh.scene();
    if (!scene.colours_vary_on(scene.facets[middle.facet].material))
        return {colours_at(mesh, mesh.patches()[middle.patch], middle.position), 1};
    Shown sum;
    const double weight = 1.0 / (samples * samples);
    for (int k = 0; k < samples * samples; ++k) {
        const Vec2 place(x + (k % samples + .5) / samples, y + (k / samples + .5) / samples);
        const SurfacePoint at = samples == 1 ? middle : texels.point_near(texel, place);
        const Colours colours = colours_at(mesh, mesh.patches()[at.patch], at.position);
        sum.colours.reflectance += weight * colours.reflectance;
        sum.colours.emission += weight * colours.emission;
        sum.cover += weight * cover_at_point(scene, at.facet, mesh.shape_of(at.facet), at.position);
    }
    return sum;
}

/// Fills texels around charts.
void fill(Image& image, const std::vector<bool>& known, const TexelMap& texels, int margin) {
    GatheredLightmap filled;
    filled.image = std::move(image);
    filled.known = known;
    fill_texels(filled, texels, margin);
    image = std::move(filled.image);
}

} // namespace

double texture_density(const Mesh& mesh, std::span<const PlacedTriangle> triangles) {
    const Scene& scene = mesh.scene();
    const SceneTextures& textures = textures_of(scene);
    double of_textures = 0, of_lightmap = 0;
    for (const PlacedTriangle& triangle : triangles) {
        const std::uint32_t material = scene.facets[triangle.facet].material;
        if (!textures.has_texture(material))
            continue;
        const MaterialTextures& maps = textures.of_material[material];
        of_textures += std::max(twice_texels(textures, maps.reflectance, triangle),
                                twice_texels(textures, maps.emission, triangle));
        of_lightmap += twice_area(triangle.place);
    }
    const double density = of_lightmap > 0 ? std::sqrt(of_textures / of_lightmap) : 0;
    return std::isfinite(density) ? density : 0;
}

LitPicture lit_picture(const Mesh& mesh, std::vector<PlacedTriangle> triangles,
                       const Image& irradiance, int times, int margin, const Workers& workers) {
    constexpr double max_samples = 3;
    const int size = times * irradiance.width;
    const auto samples = static_cast<int>(
        std::clamp(std::ceil(texture_density(mesh, triangles) / times), 1.0, max_samples));
    for (PlacedTriangle& triangle : triangles)
        for (Vec2& place : triangle.place)
            place *= double(times);
    const TexelMap texels(mesh, std::move(triangles), size);
    LitPicture picture{Image(size, size), Image(size, size), std::vector<float>(texels.count())};
    workers.for_chunks(static_cast<std::size_t>(size), 16, [&](std::size_t begin, std::size_t end) {
        for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y)
            for (int x = 0; x < size; ++x) {
                const std::size_t texel = texels.index(x, y);
                if (!texels.shows(texel))
                    continue;
                const auto [colours, cover] = shown_at(mesh, texels, x, y, samples);
                const Vec3 light = light_at(irradiance, Vec2(x + .5, y + .5) / double(times));
                picture.emitted.pixels[texel] = glm::vec3(colours.emission);
                picture.light.pixels[texel] =
                    glm::vec3(colours.emission + colours.reflectance * light);
                picture.cover[texel] = static_cast<float>(cover);
            }
    });
    std::vector<bool> known(texels.count());
    bool emits = false, is_open = false;
    for (std::size_t k = 0; k < known.size(); ++k) {
        known[k] = texels.shows(k);
        emits |= picture.emitted.pixels[k] != glm::vec3(0.0f);
        is_open |= known[k] && picture.cover[k] < 1;
    }
    fill(picture.light, known, texels, times * margin);
    if (emits)
        fill(picture.emitted, known, texels, times * margin);
    else
        picture.emitted = {};
    if (!is_open)
        picture.cover.clear();
    return picture;
}

} // namespace hemilux
