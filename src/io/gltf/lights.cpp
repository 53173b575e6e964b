#include "io/gltf/lights.h"

#include "geometry/frame.h"

#include <array>
#include <cmath>
#include <numbers>

namespace hemilux::gltf {
namespace {

constexpr double pi = std::numbers::pi;

/// Of emitters, relative to the diagonal of the scene.
constexpr double small_radius = 0.002;
/// Of directional lights: their distance from the scene, and half of the angle that the sun has.
constexpr double far_away = 100;
constexpr double sun_radius = 0.00465; // [rad]

struct Emitter {
    std::vector<Vec3> points;
    std::vector<std::array<std::uint32_t, 3>> corners;
};

/// The regular icosahedron of this circumscribed radius.
Emitter icosahedron(const Vec3& centre, double radius) {
    const double a = radius / std::sqrt(std::numbers::phi + 2), b = a * std::numbers::phi;
    Emitter shape;
    for (const Vec3& p : {Vec3(-a, b, 0), Vec3(a, b, 0), Vec3(-a, -b, 0), Vec3(a, -b, 0),
                          Vec3(0, -a, b), Vec3(0, a, b), Vec3(0, -a, -b), Vec3(0, a, -b),
                          Vec3(b, 0, -a), Vec3(b, 0, a), Vec3(-b, 0, -a), Vec3(-b, 0, a)})
        shape.points.push_back(centre + p);
    shape.corners = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                     {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                     {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                     {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
    return shape;
}

/// A regular polygon of twelve corners around its middle.
Emitter disc(const Vec3& centre, const Vec3& normal, double radius) {
    constexpr std::uint32_t n = 12;
    const Frame frame = Frame::from_normal(normal);
    Emitter shape;
    shape.points.push_back(centre);
    for (std::uint32_t i = 0; i < n; ++i) {
        const double angle = 2 * pi * i / n;
        shape.points.push_back(centre +
                               radius * (std::cos(angle) * frame.x + std::sin(angle) * frame.y));
        shape.corners.push_back({0, 1 + i, 1 + (i + 1) % n});
    }
    return shape;
}

double area_of(const Emitter& shape) {
    double area = 0;
    for (const auto& [a, b, c] : shape.corners)
        area += 0.5 * glm::length(glm::cross(shape.points[b] - shape.points[a],
                                             shape.points[c] - shape.points[a]));
    return area;
}

} // namespace

/// The intensity of a spot falls between its two cones as ((cos - cos outer) / (cos inner - cos
/// outer))^2, whose integral over cos is a third.
double flux_per_intensity(const Light& light) {
    if (light.kind == Light::Kind::point)
        return 4 * pi;
    const double inner = std::cos(light.inner_cone), outer = std::cos(light.outer_cone);
    return 2 * pi * (1 - inner + (inner - outer) / 3);
}

void add_light(Scene& scene, const PlacedLight& light, const Box& bounds) {
    const double size = glm::length(bounds.extent());
    const bool is_far = light.light.kind == Light::Kind::directional;
    const double far = far_away * size;
    const Emitter shape =
        is_far ? disc(bounds.centre() - far * light.direction, light.direction, far * sun_radius)
        : light.light.kind == Light::Kind::spot
            ? disc(light.position, light.direction, small_radius * size)
            : icosahedron(light.position, small_radius * size);
    // Irradiance below a disc is its radiosity times its area over pi d^2.
    const double per_intensity =
        (is_far ? pi * far * far : flux_per_intensity(light.light)) / area_of(shape);
    Material material;
    material.name = light.name;
    material.reflectance = Vec3(0.0);
    material.emission = light.light.intensity * per_intensity * light.light.colour;
    const auto first = static_cast<std::uint32_t>(scene.vertices.size());
    scene.vertices.insert(scene.vertices.end(), shape.points.begin(), shape.points.end());
    for (const auto& [a, b, c] : shape.corners)
        scene.facets.push_back({{first + a, first + b, first + c, first + c},
                                scene.faces++,
                                static_cast<std::uint32_t>(scene.materials.size()),
                                static_cast<std::uint32_t>(scene.groups.size())});
    scene.materials.push_back(std::move(material));
    scene.groups.push_back(light.name);
}

} // namespace hemilux::gltf
