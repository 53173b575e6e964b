#include "radiosity/answers/lightmaps/lightmap.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace hemilux {
namespace {

/// A corner of a triangle in the picture.
struct Corner {
    Vec2 place;
    Vec3 light;
};

struct Nearest {
    double distance; ///< squared [texels^2]
    Vec3 light;
};

/// Returns the nearest point on the edge from a to b.
Nearest nearest_on(const Corner& a, const Corner& b, const Vec2& at) {
    const Vec2 edge = b.place - a.place;
    const double length = glm::dot(edge, edge);
    const double t = length > 0 ? std::clamp(glm::dot(at - a.place, edge) / length, 0.0, 1.0) : 0.0;
    const Vec2 gap = a.place + t * edge - at;
    return {glm::dot(gap, gap), a.light + t * (b.light - a.light)};
}

Nearest nearest_on(const std::array<Corner, 3>& triangle, const Vec2& at) {
    const auto& [a, b, c] = triangle;
    const double area = cross(b.place - a.place, c.place - a.place);
    const double u = cross(at - a.place, c.place - a.place) / area;
    const double v = cross(b.place - a.place, at - a.place) / area;
    if (u >= 0 && v >= 0 && u + v <= 1) // false where the triangle has no area
        return {0, a.light + u * (b.light - a.light) + v * (c.light - a.light)};
    const auto nearer = [](const Nearest& x, const Nearest& y) { return x.distance < y.distance; };
    return std::min({nearest_on(a, b, at), nearest_on(b, c, at), nearest_on(c, a, at)}, nearer);
}

/// Paints the texels of the chart that are at most the gutter away from the triangle, and not
/// nearer to another one. `distance` is that of each texel to what it shows, squared [texels^2].
void paint(const LightmapChart& chart, const std::array<Corner, 3>& triangle, Image& image,
           std::vector<float>& distance) {
    const auto& [a, b, c] = triangle;
    const Vec2 low = glm::min(a.place, glm::min(b.place, c.place)) - double(gutter);
    const Vec2 high = glm::max(a.place, glm::max(b.place, c.place)) + double(gutter);
    const auto range = [](double from, double to, int first, int count) {
        return std::pair(std::max(first - gutter, static_cast<int>(std::floor(from))),
                         std::min(first + count + gutter, static_cast<int>(std::ceil(to))));
    };
    const auto [left, right] = range(low.x, high.x, chart.column, chart.columns);
    const auto [top, bottom] = range(low.y, high.y, chart.row, chart.rows);
    for (int y = top; y < bottom; ++y)
        for (int x = left; x < right; ++x) {
            const Nearest nearest = nearest_on(triangle, {x + 0.5, y + 0.5});
            float& least = distance[image.index(x, y)];
            if (!(static_cast<float>(nearest.distance) < least))
                continue;
            least = static_cast<float>(nearest.distance);
            image.at(x, y) = glm::vec3(nearest.light);
        }
}

} // namespace

Image lightmap(const std::vector<LightmapChart>& charts, const ChartCorners& corners,
               std::span<const Vec3> light, int size) {
    Image image(size, size);
    std::vector<float> distance(image.pixels.size(), std::numeric_limits<float>::max());
    for (const LightmapChart& chart : charts)
        for (const std::uint32_t i : chart.patches) {
            const auto corner = [&](std::uint32_t k) { return Corner{corners.place[k], light[k]}; };
            for_each_triangle(corners.classes, i,
                              [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
                                  paint(chart, {corner(a), corner(b), corner(c)}, image, distance);
                              });
        }
    return image;
}

} // namespace hemilux
