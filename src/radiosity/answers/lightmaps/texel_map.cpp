#include "radiosity/answers/lightmaps/texel_map.h"

#include "radiosity/answers/charts/charts.h"
#include "radiosity/paper/scene/mesh.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <unordered_map>

namespace hemilux {
namespace {

/// The points of texels lie so far from their middles [texels]. Surfaces of models stand at round
/// distances from each other, and so do the middles on a wall: one in the plane of a ceiling would
/// have its light or not by a rounding error.
constexpr Vec2 aside(1.0 / 97, 1.0 / 83);

/// A point of a triangle by its coordinates (Hit), and its squared distance from a place.
struct NearestPlace {
    double u, v, distance;
};

NearestPlace nearest_place_on_edge(const std::array<Vec2, 3>& corner, std::size_t first,
                                   const Vec2& at) {
    const std::size_t second = (first + 1) % 3;
    const Vec2 edge = corner[second] - corner[first];
    const double length = glm::dot(edge, edge);
    const double t =
        length > 0 ? std::clamp(glm::dot(at - corner[first], edge) / length, 0.0, 1.0) : 0.0;
    const Vec2 gap = corner[first] + t * edge - at;
    std::array<double, 3> weight{};
    weight[first] = 1 - t;
    weight[second] += t;
    return {weight[1], weight[2], glm::dot(gap, gap)};
}

NearestPlace nearest_place_on(const std::array<Vec2, 3>& corner, const Vec2& at) {
    const auto& [a, b, c] = corner;
    const double area = cross(b - a, c - a);
    const double u = cross(at - a, c - a) / area, v = cross(b - a, at - a) / area;
    if (u >= 0 && v >= 0 && u + v <= 1) // false where the triangle has no area
        return {u, v, 0};
    NearestPlace nearest = nearest_place_on_edge(corner, 0, at);
    for (const std::size_t edge : {1u, 2u})
        if (const NearestPlace other = nearest_place_on_edge(corner, edge, at);
            other.distance < nearest.distance)
            nearest = other;
    return nearest;
}

/// Returns how far inside of a triangle a place lies: the distance from the nearest edge.
double depth_in(const std::array<Vec2, 3>& corner, const Vec2& at) {
    const double turn = cross(corner[1] - corner[0], corner[2] - corner[0]) < 0 ? -1 : 1;
    double depth = std::numeric_limits<double>::infinity();
    for (std::size_t c = 0; c < 3; ++c) {
        const Vec2 edge = corner[(c + 1) % 3] - corner[c];
        depth = std::min(depth, turn * cross(edge, at - corner[c]) / glm::length(edge));
    }
    return depth;
}

/// Returns the columns that a triangle reaches in some rows.
std::optional<std::pair<double, double>> columns_in(const std::array<Vec2, 3>& corner, double top,
                                                    double bottom) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (std::size_t c = 0; c < 3; ++c) {
        Vec2 a = corner[c], b = corner[(c + 1) % 3];
        if (a.y > b.y)
            std::swap(a, b);
        if (b.y < top || a.y > bottom)
            continue;
        const auto at = [&](double y) {
            return glm::mix(a.x, b.x, std::clamp((y - a.y) / (b.y - a.y), 0.0, 1.0));
        };
        const bool is_level = a.y == b.y;
        for (const double x : {is_level ? a.x : at(top), is_level ? b.x : at(bottom)}) {
            low = std::min(low, x);
            high = std::max(high, x);
        }
    }
    return low <= high ? std::optional(std::pair(low, high)) : std::nullopt;
}

/// Returns a whole number of texels within a lightmap.
int texel_at(double place, int size) {
    return static_cast<int>(std::clamp(place, 0.0, double(size)));
}

} // namespace

std::array<Vec3, 3> corners_of(const Mesh& mesh, const PlacedTriangle& triangle) {
    const Polygon shape = mesh.shape_of(triangle.facet);
    if (triangle.second_half)
        return {shape.corner[0], shape.corner[2], shape.corner[3]};
    return {shape.corner[0], shape.corner[1], shape.corner[2]};
}

std::vector<PlacedTriangle> placed_triangles(const Mesh& mesh,
                                             std::span<const LightmapChart> charts) {
    std::vector<PlacedTriangle> triangles;
    for (std::uint32_t c = 0; c < charts.size(); ++c)
        for (const ChartSide& side : charts[c].sides) {
            const bool is_triangle = mesh.scene().facets[side.facet].is_triangle();
            for (const bool second : {false, true}) {
                if (second && is_triangle)
                    continue;
                PlacedTriangle triangle{side.facet, side.back, second, c, {}};
                const std::array<Vec3, 3> corners = corners_of(mesh, triangle);
                for (std::size_t k = 0; k < 3; ++k)
                    triangle.place[k] = charts[c].place(corners[k]);
                triangles.push_back(triangle);
            }
        }
    return triangles;
}

TexelMap::TexelMap(const Mesh& mesh, std::vector<PlacedTriangle> triangles, int size)
    : mesh_(mesh), triangles_(std::move(triangles)), size_(size),
      texels_(static_cast<std::size_t>(size) * static_cast<std::size_t>(size)) {
    OverlapCounts counts;
    for (std::uint32_t t = 0; t < triangles_.size(); ++t)
        paint(t, counts);
    std::ranges::stable_sort(counts, {}, [](const auto& count) { return count.first; });
    std::uint64_t last = 0;
    for (const auto& [groups, overlap] : counts) {
        if (overlaps_.empty() || groups != last)
            overlaps_.push_back(overlap);
        else
            overlaps_.back().texels += overlap.texels;
        last = groups;
    }
    std::ranges::stable_sort(overlaps_, std::ranges::greater{}, &Overlap::texels);
}

/// Paints the texels whose middles are at most `reach` away from a triangle, and not nearer to
/// another one.
void TexelMap::paint(std::uint32_t number, OverlapCounts& overlaps) {
    constexpr double well_inside = .05; // [texels]
    const PlacedTriangle& triangle = triangles_[number];
    const std::array<Vec2, 3>& corner = triangle.place;
    const double top = std::min({corner[0].y, corner[1].y, corner[2].y}),
                 bottom = std::max({corner[0].y, corner[1].y, corner[2].y});
    if (!(bottom - top < std::numeric_limits<float>::max()))
        return;
    const std::vector<Facet>& facets = mesh_.scene().facets;
    const int end = texel_at(std::ceil(bottom + reach), size_);
    for (int y = texel_at(std::floor(top - reach), size_); y < end; ++y) {
        const auto columns = columns_in(corner, y + .5 - reach, y + .5 + reach);
        if (!columns)
            continue;
        const int right = texel_at(std::ceil(columns->second + reach), size_);
        for (int x = texel_at(std::floor(columns->first - reach), size_); x < right; ++x) {
            const Vec2 at(x + .5, y + .5);
            const double square = nearest_place_on(corner, at).distance;
            if (square > reach * reach)
                continue;
            Texel& texel = texels_[index(x, y)];
            if (square == 0 && texel.distance == 0 && depth_in(corner, at) > well_inside &&
                depth_in(triangles_[texel.triangle].place, at) > well_inside) {
                const std::uint32_t other = triangles_[texel.triangle].facet;
                const auto [low, high] =
                    std::minmax(facets[triangle.facet].group, facets[other].group);
                const std::uint64_t groups = std::uint64_t{low} << 32 | high;
                if (!overlaps.empty() && overlaps.back().first == groups)
                    ++overlaps.back().second.texels;
                else
                    overlaps.push_back({groups, {other, triangle.facet, 1}});
            }
            if (const auto distance = static_cast<float>(std::sqrt(square));
                distance < texel.distance) {
                const NearestPlace shown = nearest_place_on(corner, at + aside);
                texel = {number, static_cast<float>(shown.u), static_cast<float>(shown.v),
                         distance};
            }
        }
    }
}

/// From a point on the edge of a facet half of the rays would begin on the wall beside it, and miss
/// that. So points keep a little from all edges.
SurfacePoint TexelMap::point_of(const PlacedTriangle& triangle, double u, double v) const {
    constexpr double least = 1e-6; // share of a corner
    if (std::min({1 - u - v, u, v}) < least) {
        const double w = std::max(1 - u - v, least);
        u = std::max(u, least);
        v = std::max(v, least);
        const double sum = w + u + v;
        u /= sum;
        v /= sum;
    }
    const auto [a, b, c] = corners_of(mesh_, triangle);
    const std::uint32_t patch =
        mesh_.patch_at({triangle.facet, 0, u, v, triangle.second_half, !triangle.back});
    return {(1 - u - v) * a + u * b + v * c, mesh_.patches()[patch].normal, triangle.facet, patch};
}

SurfacePoint TexelMap::point(std::size_t texel) const {
    return point_of(triangle(texel), texels_[texel].u, texels_[texel].v);
}

SurfacePoint TexelMap::point_near(std::size_t texel, const Vec2& place) const {
    const PlacedTriangle& on = triangle(texel);
    const auto [u, v, square] = nearest_place_on(on.place, place);
    return point_of(on, u, v);
}

void TexelMap::set_normals(std::span<const CornerNormals> normals, const Tracer& tracer) {
    normals_ = normals;
    tracer_ = &tracer;
}

SurfacePoint TexelMap::receiver_of(const PlacedTriangle& triangle, double u, double v) const {
    SurfacePoint flat = point_of(triangle, u, v);
    flat.patch = none;
    if (normals_.empty() || normals_[triangle.facet] == CornerNormals{})
        return flat;
    SmoothTriangle smooth{corners_of(mesh_, triangle), {}};
    const CornerNormals& of_corners = normals_[triangle.facet];
    for (std::size_t k = 0; k < 3; ++k)
        smooth.normal[k] = (triangle.back ? -1.0 : 1.0) *
                           Vec3(of_corners[triangle.second_half && k > 0 ? k + 1 : k]);
    return smooth_point(flat, smooth, u, v, *tracer_);
}

SurfacePoint TexelMap::receiver(std::size_t texel) const {
    return receiver_of(triangle(texel), texels_[texel].u, texels_[texel].v);
}

SurfacePoint TexelMap::receiver_near(std::size_t texel, const Vec2& place) const {
    const PlacedTriangle& on = triangle(texel);
    const auto [u, v, square] = nearest_place_on(on.place, place);
    return receiver_of(on, u, v);
}

double TexelMap::side(std::size_t texel) const {
    const PlacedTriangle& on = triangle(texel);
    const auto [a, b, c] = corners_of(mesh_, on);
    const double texels = std::abs(cross(on.place[1] - on.place[0], on.place[2] - on.place[0])) / 2;
    return texels > 0 ? std::sqrt(glm::length(glm::cross(b - a, c - a)) / 2 / texels) : 0;
}

} // namespace hemilux
