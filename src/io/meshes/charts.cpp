#include "io/meshes/charts.h"

#include "bvh/tracer.h"
#include "radiosity/engine/needs/welded_edges.h"
#include "radiosity/paper/scene/mesh.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>

namespace hemilux {
namespace {

/// The facets that meet each facet at an edge.
using Neighbours = std::vector<std::vector<std::uint32_t>>;

Neighbours neighbours_of(const Scene& scene) {
    Neighbours neighbours(scene.facets.size());
    const std::vector<Edge> edges = welded_edges(scene);
    for_each_place(edges, [&](auto first, auto last) {
        for (auto next = first + 1; next < last; ++next) {
            neighbours[next->facet].push_back((next - 1)->facet);
            neighbours[(next - 1)->facet].push_back(next->facet);
        }
    });
    return neighbours;
}

/// Returns a number for each facet, the same for those of one plane group.
std::vector<std::uint32_t> plane_groups(const Mesh& mesh) {
    const double min_cosine = std::cos(0.5 * std::numbers::pi / 180);
    const std::vector<Facet>& facets = mesh.scene().facets;
    const Neighbours neighbours = neighbours_of(mesh.scene());
    const auto normal = [&](std::uint32_t facet) {
        return polygon_of(mesh.vertices(), facets[facet].vertex).normal();
    };
    std::vector<std::uint32_t> group(facets.size(), none), waiting;
    for (std::uint32_t seed = 0; seed < facets.size(); ++seed) {
        if (group[seed] != none)
            continue;
        const Vec3 plane = normal(seed);
        group[seed] = seed;
        waiting.push_back(seed);
        while (!waiting.empty()) {
            const std::uint32_t facet = waiting.back();
            waiting.pop_back();
            for (const std::uint32_t next : neighbours[facet])
                if (group[next] == none && facets[next].material == facets[seed].material &&
                    glm::dot(normal(next), plane) > min_cosine) {
                    group[next] = seed;
                    waiting.push_back(next);
                }
        }
    }
    return group;
}

/// Returns the longest edge of the patches, which rectangles have along a side.
Vec3 longest_edge(const Mesh& mesh, std::span<const std::uint32_t> patches) {
    Vec3 longest(0.0);
    for (const std::uint32_t i : patches) {
        const Polygon& shape = mesh.patches()[i].shape;
        for (std::size_t c = 0, n = static_cast<std::size_t>(shape.size()); c < n; ++c)
            if (const Vec3 edge = shape.corner[(c + 1) % n] - shape.corner[c];
                glm::dot(edge, edge) > 1.0001 * glm::dot(longest, longest))
                longest = edge;
    }
    return longest;
}

/// Chooses axes along which the chart is at least as wide as high.
void measure(LightmapChart& chart, const Mesh& mesh) {
    const Vec3 normal = mesh.patches()[chart.patches.front()].normal;
    const Vec3 edge = longest_edge(mesh, chart.patches);
    chart.along = glm::normalize(edge - glm::dot(edge, normal) * normal);
    chart.across = glm::cross(normal, chart.along);
    chart.low = Vec2(std::numeric_limits<double>::infinity());
    chart.high = -chart.low;
    for (const std::uint32_t i : chart.patches)
        for (const Vec3& corner : mesh.patches()[i].shape.corner) {
            const Vec2 place(glm::dot(corner, chart.along), glm::dot(corner, chart.across));
            chart.low = glm::min(chart.low, place);
            chart.high = glm::max(chart.high, place);
        }
    if (const Vec2 extent = chart.high - chart.low; extent.x >= extent.y)
        return;
    std::swap(chart.along, chart.across);
    std::swap(chart.low.x, chart.low.y);
    std::swap(chart.high.x, chart.high.y);
}

/// Packs the charts into rows, the highest first, with `density` texels per local unit of length;
/// false where they do not fit into the square.
bool pack(std::vector<LightmapChart>& charts, double density, int size) {
    std::vector<std::size_t> order(charts.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto texels = [&](double extent) {
        return std::max(2, static_cast<int>(std::min(extent * density, 1e6)) + 1);
    };
    for (LightmapChart& chart : charts) {
        chart.columns = texels(chart.high.x - chart.low.x);
        chart.rows = texels(chart.high.y - chart.low.y);
    }
    std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) {
        return std::pair(charts[a].rows, charts[a].columns) >
               std::pair(charts[b].rows, charts[b].columns);
    });
    int column = 0, row = 0, height = 0;
    for (const std::size_t k : order) {
        LightmapChart& chart = charts[k];
        if (column + chart.columns + 2 * gutter > size) {
            column = 0;
            row += height;
            height = 0;
        }
        height = std::max(height, chart.rows + 2 * gutter);
        if (column + chart.columns + 2 * gutter > size || row + height > size)
            return false;
        chart.column = column + gutter;
        chart.row = row + gutter;
        column += chart.columns + 2 * gutter;
    }
    return true;
}

} // namespace

Vec2 LightmapChart::place(const Vec3& point) const {
    const auto coordinate = [](double x, double from, double to, int texels) {
        return to > from ? (x - from) / (to - from) * (texels - 1) : 0;
    };
    return {column + 0.5 + coordinate(glm::dot(point, along), low.x, high.x, columns),
            row + 0.5 + coordinate(glm::dot(point, across), low.y, high.y, rows)};
}

std::vector<LightmapChart> find_charts(const Mesh& mesh, int size) {
    const std::vector<std::uint32_t> group = plane_groups(mesh);
    std::map<std::pair<std::uint32_t, bool>, std::size_t> number; // of a group's side
    std::vector<LightmapChart> charts;
    for (std::uint32_t i = 0; i < mesh.patches().size(); ++i) {
        const Patch& patch = mesh.patches()[i];
        if (mesh.material(patch).is_far)
            continue;
        const auto [at, is_new] =
            number.emplace(std::pair(group[patch.facet], patch.back), charts.size());
        if (is_new)
            charts.emplace_back();
        charts[at->second].patches.push_back(i);
    }
    double longest = 0;
    for (LightmapChart& chart : charts) {
        measure(chart, mesh);
        longest = std::max(longest, chart.high.x - chart.low.x);
    }
    double fits = 0, too_dense = longest > 0 ? size / longest : 1;
    if (!pack(charts, fits, size))
        throw LightmapTooSmall(
            std::to_string(charts.size()) + (charts.size() == 1 ? " chart does" : " charts do") +
            " not fit into a lightmap of " + std::to_string(size) + " x " + std::to_string(size));
    for (int bisection = 0; bisection < 40; ++bisection) {
        const double density = (fits + too_dense) / 2;
        (pack(charts, density, size) ? fits : too_dense) = density;
    }
    (void)pack(charts, fits, size);
    return charts;
}

ChartCorners divide_by_charts(const Mesh& mesh, const CornerClasses& classes,
                              const std::vector<LightmapChart>& charts) {
    struct Last {
        std::uint32_t chart = none, number = 0; ///< chart that met a class last; as which class
    };
    ChartCorners divided;
    divided.classes.of_patch.resize(mesh.patches().size());
    divided.classes.outlines = classes.outlines;
    std::vector<Last> last(classes.position.size());
    const auto number_of = [&](std::uint32_t k, std::uint32_t chart) {
        if (last[k].chart != chart) {
            last[k] = {chart, static_cast<std::uint32_t>(divided.class_of.size())};
            divided.class_of.push_back(k);
            divided.classes.position.push_back(classes.position[k]);
            divided.place.push_back(charts[chart].place(classes.position[k]));
        }
        return last[k].number;
    };
    for (std::uint32_t c = 0; c < charts.size(); ++c)
        for (const std::uint32_t i : charts[c].patches) {
            for (std::size_t corner = 0; corner < 4; ++corner)
                divided.classes.of_patch[i][corner] = number_of(classes.of_patch[i][corner], c);
            if (const Outline* const outline = outline_of(classes, i)) {
                const auto place = static_cast<std::size_t>(outline - classes.outlines.data());
                for (std::uint32_t& k : divided.classes.outlines[place].classes)
                    k = number_of(k, c);
            }
        }
    return divided;
}

} // namespace hemilux
