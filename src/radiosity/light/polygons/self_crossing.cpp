#include "radiosity/light/polygons/self_crossing.h"

#include "radiosity/light/polygons/planar_turn.h"

#include <algorithm>
#include <vector>

namespace hemilux {
namespace {

struct Edge {
    Vec2 from, to;
    Vec2 low, high;
};

/// Returns the edges in ascending order of low.x, with x the axis on which they are shorter.
std::vector<Edge> edges_by_low_x(std::span<const Vec2> corners) {
    std::vector<Edge> edges;
    edges.reserve(corners.size());
    Vec2 length(0.0);
    Vec2 from = corners.back();
    for (const Vec2& to : corners) {
        edges.push_back({from, to, glm::min(from, to), glm::max(from, to)});
        length += edges.back().high - edges.back().low;
        from = to;
    }
    if (length.y < length.x)
        for (Edge& edge : edges)
            for (Vec2* point : {&edge.from, &edge.to, &edge.low, &edge.high})
                std::swap(point->x, point->y);
    std::sort(edges.begin(), edges.end(),
              [](const Edge& a, const Edge& b) { return a.low.x < b.low.x; });
    return edges;
}

bool cross(const Edge& a, const Edge& b, double rounding) {
    const auto parts = [&](const Edge& line, const Edge& other) {
        return turn_at(line.from, line.to, other.from, rounding) *
                   turn_at(line.from, line.to, other.to, rounding) <
               0;
    };
    return parts(a, b) && parts(b, a);
}

} // namespace

std::optional<bool> crosses_itself(std::span<const Vec2> corners, double rounding,
                                   std::uint64_t& work) {
    const std::vector<Edge> edges = edges_by_low_x(corners);
    for (std::size_t i = 0; i < edges.size(); ++i)
        for (std::size_t j = i + 1; j < edges.size() && edges[j].low.x <= edges[i].high.x; ++j) {
            if (work == 0)
                return std::nullopt;
            --work;
            if (edges[j].low.y <= edges[i].high.y && edges[i].low.y <= edges[j].high.y &&
                cross(edges[i], edges[j], rounding))
                return true;
        }
    return false;
}

} // namespace hemilux
