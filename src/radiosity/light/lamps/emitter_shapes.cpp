#include "radiosity/light/lamps/emitter_shapes.h"

#include "geometry/elementary.h"
#include "geometry/frame.h"
#include "geometry/numeric.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hemilux {
namespace {

constexpr double pi = std::numbers::pi;

/// Distances in diagonals of the scene. No face of the sky is nearer than four fifths of its
/// corners.
constexpr double to_sun = 100, to_sky = 150;
constexpr double sun_radius = 0.00465; // [rad]

double size_of(const Box& bounds) { return glm::length(bounds.extent()); }

/// Returns the axis along which a vector is the shortest.
Vec3 axis_across(const Vec3& v) {
    const Vec3 a = glm::abs(v);
    if (a.x <= a.y && a.x <= a.z)
        return {1, 0, 0};
    return a.y <= a.z ? Vec3(0, 1, 0) : Vec3(0, 0, 1);
}

} // namespace

double EmitterShape::area() const {
    double area = 0;
    for (const auto& [a, b, c, d] : faces)
        area += 0.5 * glm::length(glm::cross(points[c] - points[a], points[d] - points[b]));
    return area;
}

EmitterShape disc(const Vec3& centre, const Vec3& normal, double radius) {
    constexpr std::uint32_t n = 12;
    const Frame frame = Frame::from_normal(normal);
    EmitterShape shape;
    shape.points.push_back(centre);
    for (std::uint32_t i = 0; i < n; ++i) {
        const Vec2 at = elementary::on_circle(2 * pi * i / n);
        shape.points.push_back(centre + radius * (at.x * frame.x + at.y * frame.y));
        const std::uint32_t next = 1 + (i + 1) % n;
        shape.faces.push_back({0, 1 + i, next, next});
    }
    return shape;
}

EmitterShape rectangle(const Vec3& centre, const Vec3& normal, double width, double height) {
    const Vec3 x = 0.5 * width * glm::normalize(glm::cross(axis_across(normal), normal));
    const Vec3 y = 0.5 * height * glm::normalize(glm::cross(normal, x));
    return {{centre - x - y, centre + x - y, centre + x + y, centre - x + y}, {{0, 1, 2, 3}}};
}

EmitterShape icosahedron(const Vec3& centre, double radius) {
    const double a = radius / std::sqrt(std::numbers::phi + 2), b = a * std::numbers::phi;
    EmitterShape shape;
    for (const Vec3& p : {Vec3(-a, b, 0), Vec3(a, b, 0), Vec3(-a, -b, 0), Vec3(a, -b, 0),
                          Vec3(0, -a, b), Vec3(0, a, b), Vec3(0, -a, -b), Vec3(0, a, -b),
                          Vec3(b, 0, -a), Vec3(b, 0, a), Vec3(-b, 0, -a), Vec3(-b, 0, a)})
        shape.points.push_back(centre + p);
    shape.faces = {{0, 11, 5, 5}, {0, 5, 1, 1},   {0, 1, 7, 7},   {0, 7, 10, 10}, {0, 10, 11, 11},
                   {1, 5, 9, 9},  {5, 11, 4, 4},  {11, 10, 2, 2}, {10, 7, 6, 6},  {7, 1, 8, 8},
                   {3, 9, 4, 4},  {3, 4, 2, 2},   {3, 2, 6, 6},   {3, 6, 8, 8},   {3, 8, 9, 9},
                   {4, 9, 5, 5},  {2, 4, 11, 11}, {6, 2, 10, 10}, {8, 6, 7, 7},   {9, 8, 1, 1}};
    return shape;
}

void add_emitter(Scene& scene, const EmitterShape& shape, const std::string& name,
                 const Vec3& emission, bool is_far) {
    const auto first = static_cast<std::uint32_t>(scene.vertices.size());
    scene.vertices.insert(scene.vertices.end(), shape.points.begin(), shape.points.end());
    for (const auto& [a, b, c, d] : shape.faces)
        scene.facets.push_back({{first + a, first + b, first + c, first + d},
                                scene.faces++,
                                static_cast<std::uint32_t>(scene.materials.size()),
                                static_cast<std::uint32_t>(scene.groups.size())});
    scene.materials.push_back(
        {.name = name, .reflectance = Vec3(0.0), .emission = emission, .is_far = is_far});
    scene.groups.push_back(name);
}

Box bounds_of(const Scene& scene) {
    Box bounds;
    for (const Facet& facet : scene.facets)
        if (!scene.materials[facet.material].is_far)
            for (const std::uint32_t v : facet.vertex)
                bounds.include(scene.vertices[v]);
    return bounds;
}

void add_sun(Scene& scene, const std::string& name, const Box& within, const Vec3& direction,
             const Vec3& irradiance) {
    const Vec3 along = direction_of(direction);
    const double distance = to_sun * size_of(within);
    const EmitterShape shape =
        disc(within.centre() - distance * along, along, distance * sun_radius);
    // The irradiance of a surface opposite a small disc is the disc's radiosity times its area over
    // pi d^2.
    add_emitter(scene, shape, name, irradiance * (pi * distance * distance / shape.area()), true);
}

void add_sky(Scene& scene, const std::string& name, const Box& within, const Vec3& radiosity) {
    EmitterShape shape = icosahedron(within.centre(), to_sky * size_of(within));
    for (auto& [a, b, c, d] : shape.faces) {
        std::swap(b, c);
        d = c;
    }
    add_emitter(scene, shape, name, radiosity, true);
}

} // namespace hemilux
