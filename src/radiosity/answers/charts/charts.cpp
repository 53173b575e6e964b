#include "radiosity/answers/charts/charts.h"

#include "bvh/tracer.h"
#include "radiosity/answers/charts/rectangle_packing.h"
#include "radiosity/paper/scene/mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace hemilux {
namespace {

/// Fits a chart around its sides.
void measure(LightmapChart& chart, const Mesh& mesh) {
    chart.low = Vec2(std::numeric_limits<double>::infinity());
    chart.high = -chart.low;
    for (const ChartSide& side : chart.sides)
        for (const Vec3& corner : mesh.shape_of(side.facet).corner) {
            const Vec2 place(glm::dot(corner, chart.along), glm::dot(corner, chart.across));
            chart.low = glm::min(chart.low, place);
            chart.high = glm::max(chart.high, place);
        }
}

std::vector<LightmapChart> charts_of(const Mesh& mesh, std::span<const ChartSide> sides) {
    std::vector<LightmapChart> charts;
    for (ChartRegion& region : find_chart_regions(mesh, sides)) {
        LightmapChart& chart = charts.emplace_back();
        const auto [along, across] = axes_of(mesh, region);
        chart.along = along;
        chart.across = across;
        chart.sides = std::move(region.sides);
        measure(chart, mesh);
    }
    std::vector<std::array<std::uint32_t, 2>> chart_of(mesh.scene().facets.size(), {none, none});
    for (std::uint32_t c = 0; c < charts.size(); ++c)
        for (const ChartSide& side : charts[c].sides)
            chart_of[side.facet][side.back ? 1 : 0] = c;
    for (std::uint32_t i = 0; i < mesh.patches().size(); ++i) {
        const Patch& patch = mesh.patches()[i];
        if (const std::uint32_t c = chart_of[patch.facet][patch.back ? 1 : 0]; c != none)
            charts[c].patches.push_back(i);
    }
    return charts;
}

/// Returns the texels of a chart, with their gutter, for so many per local unit.
PackedRectangle rectangle_of(const LightmapChart& chart, double density, int margin) {
    const auto texels = [&](double extent) {
        return std::max(2, static_cast<int>(std::min(extent * density, 1e6)) + 1) + 2 * margin;
    };
    return {texels(chart.high.x - chart.low.x), texels(chart.high.y - chart.low.y)};
}

/// Packs the charts; false, and nothing is changed, where they do not fit into the square.
bool pack(std::vector<LightmapChart>& charts, double density, int size, int margin) {
    std::vector<PackedRectangle> rectangles;
    double area = 0;
    for (const LightmapChart& chart : charts) {
        rectangles.push_back(rectangle_of(chart, density, margin));
        area += double(rectangles.back().width) * rectangles.back().height;
    }
    if (area > double(size) * size || !pack_rectangles(rectangles, size))
        return false;
    for (std::size_t k = 0; k < charts.size(); ++k) {
        PackedRectangle& rectangle = rectangles[k];
        LightmapChart& chart = charts[k];
        if (rectangle.turned) {
            std::swap(chart.along, chart.across);
            std::swap(chart.low.x, chart.low.y);
            std::swap(chart.high.x, chart.high.y);
            std::swap(rectangle.width, rectangle.height);
        }
        chart.column = rectangle.column + margin;
        chart.row = rectangle.row + margin;
        chart.columns = rectangle.width - 2 * margin;
        chart.rows = rectangle.height - 2 * margin;
    }
    return true;
}

[[noreturn]] void refuse(std::size_t charts, int size) {
    throw LightmapTooSmall(std::to_string(charts) + (charts == 1 ? " chart does" : " charts do") +
                           " not fit into a lightmap of " + std::to_string(size) + " x " +
                           std::to_string(size));
}

/// Packs with the largest density that fits.
void pack_densely(std::vector<LightmapChart>& charts, const AtlasOptions& options) {
    constexpr int bisections = 24;
    double area = 0;
    for (const LightmapChart& chart : charts)
        area += (chart.high.x - chart.low.x) * (chart.high.y - chart.low.y);
    double fits = 0, too_dense = area > 0 ? options.size / std::sqrt(area) : 1;
    if (!pack(charts, fits, options.size, options.margin))
        refuse(charts.size(), options.size);
    for (int bisection = 0; bisection < bisections; ++bisection) {
        const double density = (fits + too_dense) / 2;
        (pack(charts, density, options.size, options.margin) ? fits : too_dense) = density;
    }
    (void)pack(charts, fits, options.size, options.margin);
}

} // namespace

Vec2 LightmapChart::place(const Vec3& point) const {
    const auto coordinate = [](double x, double from, double to, int texels) {
        return to > from ? (x - from) / (to - from) * (texels - 1) : 0;
    };
    return {column + 0.5 + coordinate(glm::dot(point, along), low.x, high.x, columns),
            row + 0.5 + coordinate(glm::dot(point, across), low.y, high.y, rows)};
}

Atlas make_atlas(const Mesh& mesh, std::span<const ChartSide> sides, const AtlasOptions& options) {
    Atlas atlas{charts_of(mesh, sides), options.size};
    if (options.density == 0) {
        pack_densely(atlas.charts, options);
        return atlas;
    }
    if (options.size > 0) {
        if (!pack(atlas.charts, options.density, options.size, options.margin))
            refuse(atlas.charts.size(), options.size);
        return atlas;
    }
    constexpr int step = 16; // a size is a multiple of it
    double area = 0;
    for (const LightmapChart& chart : atlas.charts) {
        const PackedRectangle texels = rectangle_of(chart, options.density, options.margin);
        area += double(texels.width) * texels.height;
    }
    for (double side = std::sqrt(area);; side *= 1.02) {
        const double size = std::ceil(side / step) * step;
        if (!(size <= options.max_size))
            refuse(atlas.charts.size(), options.max_size);
        atlas.size = std::max(static_cast<int>(size), step);
        if (pack(atlas.charts, options.density, atlas.size, options.margin))
            return atlas;
    }
}

std::vector<ChartSide> sides_with_light(const Mesh& mesh) {
    std::vector<ChartSide> sides;
    const Scene& scene = mesh.scene();
    for (std::uint32_t f = 0; f < scene.facets.size(); ++f) {
        if (scene.materials[scene.facets[f].material].is_far)
            continue;
        sides.push_back({f, false});
        if (mesh.has_back(f))
            sides.push_back({f, true});
    }
    return sides;
}

std::vector<LightmapChart> find_charts(const Mesh& mesh, int size) {
    return make_atlas(mesh, sides_with_light(mesh), {.size = size}).charts;
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
