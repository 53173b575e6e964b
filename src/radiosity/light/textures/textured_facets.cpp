#include "radiosity/light/textures/textured_facets.h"

#include "radiosity/light/textures/scene_textures.h"

#include <cmath>
#include <vector>

namespace hemilux {
namespace {

/// Returns a half of a facet by its corners other than the first.
std::array<std::size_t, 2> corners_of_half(bool second) {
    return second ? std::array<std::size_t, 2>{2, 3} : std::array<std::size_t, 2>{1, 2};
}

/// The texture coordinates of corner 0, and how they change along both edges of a half.
struct TextureAxes {
    Vec2 first, along, across;
};
TextureAxes texture_axes(const SceneTextures& textures, const TextureMap& map, std::uint32_t facet,
                         bool second_half) {
    const Texcoords& uv = textures.texcoords[map.set][facet];
    const auto [b, c] = corners_of_half(second_half);
    const Vec2 first{uv[0]};
    return {first, Vec2{uv[b]} - first, Vec2{uv[c]} - first};
}

/// Returns the tint at a place of a half.
Vec3 tint_at(const SceneTextures& textures, std::uint32_t facet, bool second_half,
             const Vec2& place) {
    const Tints& tint = textures.tints[facet];
    const auto [b, c] = corners_of_half(second_half);
    const Vec3 first(tint[0]);
    return first + place.x * (Vec3(tint[b]) - first) + place.y * (Vec3(tint[c]) - first);
}

/// Returns the centre of mass of a polygon; the mean of its corners where it has no area.
Vec2 centre_of(std::span<const Vec2> polygon) {
    Vec2 sum(0.0), corners(0.0);
    double area = 0;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
        corners += polygon[k] / double(polygon.size());
        if (k < 2)
            continue;
        const double twice = cross(polygon[k - 1] - polygon[0], polygon[k] - polygon[0]);
        sum += twice / 3 * (polygon[0] + polygon[k - 1] + polygon[k]);
        area += twice;
    }
    return area != 0 ? sum / area : corners;
}

Vec3 mean_of(const SceneTextures& textures, const TextureMap& map, const Vec3& otherwise,
             std::uint32_t facet, bool second_half, std::span<const Vec2> places) {
    if (!map.texture)
        return otherwise;
    const auto [first, along, across] = texture_axes(textures, map, facet, second_half);
    std::vector<Vec2> on_texture;
    for (const Vec2& place : places)
        on_texture.push_back(map.place(first + place.x * along + place.y * across));
    return map.factor * map.texture->mean_over(on_texture, map.wraps);
}

/// Returns where a point lies on the plane of a triangle, along its edges from corner 0.
Vec2 place_on(const Vec3& corner, const Vec3& along, const Vec3& across, const Vec3& point) {
    const Vec3 normal = glm::cross(along, across), way = point - corner;
    const double square = glm::dot(normal, normal);
    return Vec2(glm::dot(normal, glm::cross(way, across)),
                glm::dot(normal, glm::cross(along, way))) /
           square;
}

/// Returns the part of a polygon where one coordinate is at least 0 (Sutherland and Hodgman 1974).
std::vector<Vec2> clipped(const std::vector<Vec2>& polygon, int axis) {
    std::vector<Vec2> kept;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
        const Vec2 &from = polygon[k], &to = polygon[(k + 1) % polygon.size()];
        if (from[axis] >= 0)
            kept.push_back(from);
        if ((from[axis] >= 0) != (to[axis] >= 0))
            kept.push_back(glm::mix(from, to, from[axis] / (from[axis] - to[axis])));
    }
    return kept;
}

double area_of(const std::vector<Vec2>& polygon) {
    double area = 0;
    for (std::size_t k = 2; k < polygon.size(); ++k)
        area += .5 * cross(polygon[k - 1] - polygon[0], polygon[k] - polygon[0]);
    return std::abs(area);
}

} // namespace

/// Where a tinted emission has a texture, too, the product of the two means stands for the mean of
/// the product.
Colours colours_over(const Scene& scene, std::uint32_t facet, bool second_half,
                     std::span<const Vec2> places) {
    const std::uint32_t number = scene.facets[facet].material;
    const Material& material = scene.materials[number];
    const SceneTextures& textures = textures_of(scene);
    const auto& [reflectance, emission, tinted] = textures.of_material[number];
    return {mean_of(textures, reflectance, material.reflectance, facet, second_half, places),
            tinted ? mean_of(textures, emission, emission.factor, facet, second_half, places) *
                         tint_at(textures, facet, second_half, centre_of(places))
                   : mean_of(textures, emission, material.emission, facet, second_half, places)};
}

/// A quad's texture is linear on either half, so the part is cut along the diagonal.
Colours mean_colours(const Scene& scene, std::uint32_t facet, const Polygon& whole,
                     const Polygon& part) {
    Colours sum{Vec3(0.0), Vec3(0.0)};
    double area = 0;
    for (const bool second : {false, true}) {
        if (second && whole.is_triangle())
            break;
        const auto [b, c] = corners_of_half(second);
        const Vec3 along = whole.corner[b] - whole.corner[0],
                   across = whole.corner[c] - whole.corner[0];
        const double twice = glm::length(glm::cross(along, across));
        if (!(twice > 0))
            continue;
        std::vector<Vec2> places;
        for (std::size_t k = 0; k < static_cast<std::size_t>(part.size()); ++k)
            places.push_back(place_on(whole.corner[0], along, across, part.corner[k]));
        if (!whole.is_triangle())
            places = clipped(places, second ? 1 : 0);
        const double weight = twice * area_of(places);
        if (places.size() < 3 || !(weight > 0))
            continue;
        const Colours mean = colours_over(scene, facet, second, places);
        sum.reflectance += weight * mean.reflectance;
        sum.emission += weight * mean.emission;
        area += weight;
    }
    const Material& material = scene.materials[scene.facets[facet].material];
    return area > 0 ? Colours{sum.reflectance / area, sum.emission / area}
                    : Colours{material.reflectance, material.emission};
}

namespace {

/// Where a point of a facet lies on one of its halves.
struct PlaceOnHalf {
    bool second = false;
    Vec2 place;
};

/// A quad's texture is linear on either half. The first is where the coordinate along its edge from
/// corner 0 to corner 1 is not below 0.
PlaceOnHalf place_on_half(const Polygon& whole, const Vec3& point) {
    const auto place_on_one = [&](bool second) {
        const auto [b, c] = corners_of_half(second);
        return place_on(whole.corner[0], whole.corner[b] - whole.corner[0],
                        whole.corner[c] - whole.corner[0], point);
    };
    const Vec2 place = place_on_one(false);
    if (whole.is_triangle() || place.x >= 0)
        return {false, place};
    return {true, place_on_one(true)};
}

/// Returns the place on the texture.
Vec2 texture_place(const SceneTextures& textures, const TextureMap& map, std::uint32_t facet,
                   const PlaceOnHalf& at) {
    const auto [first, along, across] = texture_axes(textures, map, facet, at.second);
    return map.place(first + at.place.x * along + at.place.y * across);
}

} // namespace

Colours colours_at_point(const Scene& scene, std::uint32_t facet, const Polygon& whole,
                         const Vec3& point) {
    const PlaceOnHalf at = place_on_half(whole, point);
    const std::uint32_t number = scene.facets[facet].material;
    const Material& material = scene.materials[number];
    const SceneTextures& textures = textures_of(scene);
    const auto colour = [&](const TextureMap& map, const Vec3& otherwise) {
        return map.texture
                   ? map.factor *
                         map.texture->texel_at(texture_place(textures, map, facet, at), map.wraps)
                   : otherwise;
    };
    const auto& [reflectance, emission, tinted] = textures.of_material[number];
    return {colour(reflectance, material.reflectance),
            tinted
                ? colour(emission, emission.factor) * tint_at(textures, facet, at.second, at.place)
                : colour(emission, material.emission)};
}

double cover_at_point(const Scene& scene, std::uint32_t facet, const Polygon& whole,
                      const Vec3& point) {
    const std::uint32_t number = scene.facets[facet].material;
    const SceneTextures& textures = textures_of(scene);
    if (!textures.has_texture(number) || !textures.of_material[number].reflectance.texture)
        return 1;
    const TextureMap& map = textures.of_material[number].reflectance;
    return map.texture->cover_at(texture_place(textures, map, facet, place_on_half(whole, point)),
                                 map.wraps);
}

void set_tinted_means(Scene& scene) {
    const SceneTextures& textures = textures_of(scene);
    std::vector<Vec3> sums(scene.materials.size(), Vec3(0.0));
    std::vector<double> areas(scene.materials.size());
    for (std::uint32_t f = 0; f < scene.facets.size(); ++f) {
        const std::uint32_t m = scene.facets[f].material;
        if (!textures.is_tinted(m))
            continue;
        const Polygon shape = polygon_of(scene.vertices, scene.facets[f].vertex);
        const double area = glm::length(shape.area_vector());
        sums[m] += area * mean_colours(scene, f, shape, shape).emission;
        areas[m] += area;
    }
    for (std::size_t m = 0; m < sums.size(); ++m)
        if (areas[m] > 0)
            scene.materials[m].emission = sums[m] / areas[m];
}

} // namespace hemilux
