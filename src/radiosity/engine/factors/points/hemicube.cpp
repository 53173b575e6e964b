#include "radiosity/engine/factors/points/hemicube.h"

#include "geometry/projected_polygon.h"
#include "radiosity/engine/rays/receivers.h"
#include "radiosity/paper/scene/mesh.h"
#include "radiosity/paper/solving/solver.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace hemilux {
namespace {

/// Returns the form factor from the origin, where z is the normal.
double factor_to(const Polygon& pixel) {
    return ProjectedPolygon(Vec3(0.0), {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, pixel).factor();
}

/// Returns the patches that the pixels show, `escaped` or `absorbed`.
std::vector<std::uint32_t> item_buffer(const Hemicube& cube, const Mesh& mesh, const Tracer& tracer,
                                       std::uint32_t patch, const Workers& workers,
                                       const StopFlag& interrupted) {
    const Patch& from = mesh.patches()[patch];
    const Frame frame = mesh.hemisphere_frame(patch);
    std::vector<std::uint32_t> items(cube.pixels(), escaped);
    workers.for_chunks(items.size(), rays_at_a_time, [&](std::size_t begin, std::size_t end) {
        if (interrupted)
            return;
        std::vector<Ray> rays;
        rays.reserve(end - begin);
        for (std::size_t pixel = begin; pixel < end; ++pixel)
            rays.push_back({.origin = from.centre,
                            .direction = frame.to_world(cube.direction(pixel)),
                            .from = from.facet});
        std::vector<std::uint32_t> receivers;
        find_receivers(rays, mesh, tracer, receivers);
        std::ranges::copy(receivers, items.begin() + static_cast<std::ptrdiff_t>(begin));
    });
    return items;
}

} // namespace

Hemicube::Hemicube(std::uint32_t edge) : edge_(edge) {
    if (!is_edge(edge))
        throw std::invalid_argument("a hemicube has an even number of pixels along its edge, from "
                                    "2 to 1024, not " +
                                    std::to_string(edge));
    const std::size_t half = edge / 2;
    const double size = 2.0 / edge;
    for (std::size_t row = 0; row < half; ++row)
        for (std::size_t column = 0; column < half; ++column) {
            const double a = double(column) * size, b = double(column + 1) * size;
            const double c = double(row) * size, d = double(row + 1) * size;
            top_.push_back(factor_to({{Vec3(a, c, 1), {b, c, 1}, {b, d, 1}, {a, d, 1}}}));
            side_.push_back(factor_to({{Vec3(1, a, c), {1, b, c}, {1, b, d}, {1, a, d}}}));
        }
}

Hemicube::Place Hemicube::place_of(std::size_t pixel) const {
    const std::size_t of_top = std::size_t{edge_} * edge_;
    if (pixel < of_top)
        return {top, pixel / edge_, pixel % edge_};
    const std::size_t on_sides = pixel - of_top, on_side = on_sides % (of_top / 2);
    return {on_sides / (of_top / 2), on_side / edge_, on_side % edge_};
}

double Hemicube::delta_factor(std::size_t pixel) const {
    const auto [face, row, column] = place_of(pixel);
    const std::size_t half = edge_ / 2;
    return face == top ? top_[from_middle(row) * half + from_middle(column)]
                       : side_[row * half + from_middle(column)];
}

Vec3 Hemicube::direction(std::size_t pixel) const {
    const auto [face, row, column] = place_of(pixel);
    const double size = 2.0 / edge_;
    const double u = (double(column) + .5) * size - 1, v = (double(row) + .5) * size;
    switch (face) {
    case 0:
        return {1, u, v};
    case 1:
        return {-u, 1, v};
    case 2:
        return {-1, -u, v};
    case 3:
        return {u, -1, v};
    default:
        return {u, v - 1, 1};
    }
}

HemicubeRow hemicube_row(const Hemicube& cube, const Mesh& mesh, const Tracer& tracer,
                         std::uint32_t patch, const Workers& workers, const StopFlag& interrupted) {
    const auto items = item_buffer(cube, mesh, tracer, patch, workers, interrupted);
    HemicubeRow row;
    std::vector<double> factor(mesh.patches().size());
    std::vector<std::uint32_t> pixels(mesh.patches().size());
    for (std::size_t pixel = 0; pixel < items.size(); ++pixel) {
        const double delta = cube.delta_factor(pixel);
        const std::uint32_t item = items[pixel];
        if (item == escaped || item == absorbed) {
            (item == escaped ? row.lost.escaped : row.lost.absorbed) += delta;
            continue;
        }
        factor[item] += delta;
        ++pixels[item];
    }
    for (std::uint32_t j = 0; j < factor.size(); ++j)
        if (pixels[j] > 0)
            row.entries.push_back({j, pixels[j], factor[j]});
    return row;
}

HemicubeFormFactors hemicube_form_factors(const Hemicube& cube, const Mesh& mesh,
                                          const Tracer& tracer, const Workers& workers,
                                          Monitor& monitor) {
    std::vector<HemicubeRow> rows(mesh.patches().size());
    std::atomic<std::size_t> done{0};
    workers.for_chunks(rows.size(), 1, [&](std::size_t i, std::size_t) {
        if (monitor.interrupted)
            return;
        rows[i] = hemicube_row(cube, mesh, tracer, static_cast<std::uint32_t>(i), Workers(1),
                               monitor.interrupted);
        monitor.rays += cube.pixels();
        monitor.step_share = static_cast<double>(++done) / static_cast<double>(rows.size());
    });
    HemicubeFormFactors factors{{}, {}, std::uint64_t{cube.pixels()} * rows.size()};
    SparseMatrix& matrix = factors.matrix;
    matrix.row_begin.push_back(0);
    for (const HemicubeRow& row : rows) {
        for (const HemicubeRow::Entry& entry : row.entries) {
            matrix.column.push_back(entry.patch);
            matrix.value.push_back(entry.factor);
        }
        matrix.row_begin.push_back(matrix.value.size());
        factors.lost.push_back(row.lost);
    }
    return factors;
}

} // namespace hemilux
