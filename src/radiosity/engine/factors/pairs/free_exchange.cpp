#include "radiosity/engine/factors/pairs/free_exchange.h"

#include "geometry/elementary.h"
#include "radiosity/paper/scene/mesh.h"

#include <algorithm>
#include <array>
#include <numbers>

namespace hemilux {
namespace {

/// The rules of 1 to 8 points on [0,1] (Abramowitz and Stegun 1964, table 25.4).
struct Rule {
    std::size_t points;
    std::array<double, 8> at, weight;
};

/// Returns the rule of n points, found by Newton's method on the Legendre polynomial.
Rule gauss_rule(std::size_t n) {
    Rule rule{n, {}, {}};
    for (std::size_t k = 0; k < n; ++k) {
        const auto count = static_cast<double>(n);
        double x =
            elementary::cos(std::numbers::pi * (static_cast<double>(k) + .75) / (count + .5));
        double slope = 1;
        for (int iteration = 0; iteration < 50; ++iteration) {
            double before = 1, value = x;
            for (std::size_t m = 2; m <= n; ++m) {
                const auto degree = static_cast<double>(m);
                const double next = ((2 * degree - 1) * x * value - (degree - 1) * before) / degree;
                before = value;
                value = next;
            }
            slope = count * (x * value - before) / (x * x - 1);
            x -= value / slope;
        }
        rule.at[k] = (1 - x) / 2;
        rule.weight[k] = 1 / ((1 - x * x) * slope * slope);
    }
    return rule;
}

constexpr std::size_t max_points = 8;

const Rule& rule_of(std::size_t points) {
    static const std::array<Rule, max_points + 1> rules = [] {
        std::array<Rule, max_points + 1> all{};
        for (std::size_t n = 1; n <= max_points; ++n)
            all[n] = gauss_rule(n);
        return all;
    }();
    return rules[points];
}

/// Points over a side, each with its part of the area.
struct AreaPoints {
    static constexpr std::size_t most = max_points * max_points;
    std::size_t count = 0;
    std::array<double, most> x, y, z, weight;
};

/// Spreads the product rule by the bilinear map of the unit square to the corners; a triangle's
/// last two corners are the same.
void spread(const Polygon& shape, const Rule& rule, const Vec3& origin, AreaPoints& points) {
    const auto& [a, b, c, d] = shape.corner;
    const Vec3 base = a - origin, along = b - a, up = d - a, twist = (c - d) - (b - a);
    points.count = rule.points * rule.points;
    std::size_t at = 0;
    for (std::size_t i = 0; i < rule.points; ++i) {
        const double v = rule.at[i];
        const Vec3 start = base + v * up, edge = along + v * twist;
        for (std::size_t k = 0; k < rule.points; ++k, ++at) {
            const double u = rule.at[k];
            const Vec3 p = start + u * edge;
            points.x[at] = p.x;
            points.y[at] = p.y;
            points.z[at] = p.z;
            points.weight[at] =
                rule.weight[i] * rule.weight[k] * glm::length(glm::cross(edge, up + u * twist));
        }
    }
}

/// Multiplies the weights by the heights over a plane.
void weigh_by_height(AreaPoints& points, const Plane& plane, const Vec3& origin) {
    const Vec3 n = plane.normal;
    const double offset = glm::dot(plane.point - origin, n);
    for (std::size_t k = 0; k < points.count; ++k)
        points.weight[k] *= points.x[k] * n.x + points.y[k] * n.y + points.z[k] * n.z - offset;
}

/// Integrates the kernel over both areas.
double by_areas(const FacePlane& a, const FacePlane& b, std::size_t points_each) {
    const Rule& rule = rule_of(points_each);
    const Vec3 origin = a.centre;
    AreaPoints of_a, of_b;
    spread(a.shape, rule, origin, of_a);
    spread(b.shape, rule, origin, of_b);
    weigh_by_height(of_a, b.plane, origin);
    weigh_by_height(of_b, a.plane, origin);
    double sum = 0;
    for (std::size_t i = 0; i < of_a.count; ++i) {
        const double x = of_a.x[i], y = of_a.y[i], z = of_a.z[i];
        double inner = 0;
        for (std::size_t k = 0; k < of_b.count; ++k) {
            const double dx = of_b.x[k] - x, dy = of_b.y[k] - y, dz = of_b.z[k] - z;
            const double square = dx * dx + dy * dy + dz * dz;
            inner += of_b.weight[k] / (square * square);
        }
        sum += of_a.weight[i] * inner;
    }
    return sum / std::numbers::pi;
}

/// Returns the points of the product rule that the accuracy needs, by the radii of both over their
/// distance; 0 where none is enough. For triangles and quads of all shapes up to 20 to 1, at
/// random, the largest errors were a third of those asked for.
std::size_t enough_points(double size_over_distance, FreeAccuracy accuracy) {
    struct Limit {
        double ratio;
        std::size_t points;
    };
    static constexpr std::array<Limit, 5> exact{{{.08, 3}, {.15, 4}, {.25, 5}, {.35, 6}, {.4, 7}}};
    static constexpr std::array<Limit, 5> rough{{{.12, 2}, {.3, 3}, {.5, 4}, {.65, 5}, {.8, 7}}};
    for (const Limit& limit : accuracy == FreeAccuracy::exact ? exact : rough)
        if (size_over_distance < limit.ratio)
            return limit.points;
    return 0;
}

} // namespace

FacePlane face_plane(const Polygon& shape) {
    FacePlane face{shape, {shape.corner[0], shape.normal()}, shape.centre(), shape.area(), 0};
    for (const Vec3& corner : shape.corner)
        face.radius = std::max(face.radius, glm::distance(corner, face.centre));
    return face;
}

std::vector<FacePlane> face_planes(const Mesh& mesh) {
    std::vector<FacePlane> faces;
    faces.reserve(mesh.patches().size());
    for (const Patch& patch : mesh.patches())
        faces.push_back(face_plane(patch.shape));
    return faces;
}

Facing facing(const FacePlane& a, const FacePlane& b, double rounding) {
    const auto range = [](const FacePlane& face, const Plane& plane) {
        Vec2 heights(plane.height(face.shape.corner[0]));
        for (std::size_t k = 1; k < 4; ++k) {
            const double height = plane.height(face.shape.corner[k]);
            heights = {std::min(heights.x, height), std::max(heights.y, height)};
        }
        return heights;
    };
    const Vec2 of_a = range(a, b.plane);
    if (!(of_a.y > rounding))
        return Facing::never;
    const Vec2 of_b = range(b, a.plane);
    if (!(of_b.y > rounding))
        return Facing::never;
    return of_a.x >= -rounding && of_b.x >= -rounding ? Facing::wholly : Facing::partly;
}

double free_exchange(const FacePlane& a, const FacePlane& b, Facing facing, FreeAccuracy accuracy,
                     double rounding) {
    if (facing == Facing::never)
        return 0;
    if (facing == Facing::wholly) {
        const double distance = glm::distance(a.centre, b.centre);
        if (const std::size_t points = enough_points((a.radius + b.radius) / distance, accuracy))
            return by_areas(a, b, points);
        return exchange_area(part_of(a.shape).outline(), part_of(b.shape).outline(),
                             std::min(a.area, b.area));
    }
    const ConvexPart of_a = in_front(part_of(a.shape), b.plane, rounding);
    const ConvexPart of_b = in_front(part_of(b.shape), a.plane, rounding);
    if (of_a.empty() || of_b.empty())
        return 0;
    return exchange_area(of_a.outline(), of_b.outline(), std::min(a.area, b.area));
}

double exchange_bound(const FacePlane& a, const FacePlane& b) {
    const Vec3 d = b.centre - a.centre;
    const double smaller = std::min(a.area, b.area);
    const double distance = std::sqrt(glm::dot(d, d)) - a.radius - b.radius;
    if (!(distance > 0))
        return smaller;
    const double height_b = std::max(glm::dot(d, a.plane.normal), 0.0) + b.radius;
    const double height_a = std::max(-glm::dot(d, b.plane.normal), 0.0) + a.radius;
    const double kernel = std::min(height_a / distance, 1.0) * std::min(height_b / distance, 1.0) /
                          (std::numbers::pi * distance * distance);
    return std::min(a.area * b.area * kernel, smaller);
}

} // namespace hemilux
