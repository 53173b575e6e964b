#include "io/meshes/factor_cells.h"

#include "io/meshes/vtk_grid.h"
#include "radiosity/paper/scene/mesh.h"

#include <vector>

namespace hemilux {

void write_factor_vtu(const std::string& path, const Mesh& mesh,
                      std::span<const std::uint32_t> row_of, const FactorTable& table) {
    VtkGrid grid;
    std::vector<Vec3> points;
    std::vector<std::uint32_t> corners;
    std::vector<std::uint64_t> ends;
    std::vector<std::uint8_t> types;
    for (const Patch& patch : mesh.patches()) {
        constexpr std::uint8_t vtk_triangle = 5, vtk_quad = 9;
        for (int k = 0; k < patch.shape.size(); ++k) {
            corners.push_back(static_cast<std::uint32_t>(points.size()));
            points.push_back(
                mesh.frame().to_world(patch.shape.corner[static_cast<std::size_t>(k)]));
        }
        ends.push_back(corners.size());
        types.push_back(patch.shape.is_triangle() ? vtk_triangle : vtk_quad);
    }
    const auto column = [&](const auto& value) {
        std::vector<double> values;
        for (const std::uint32_t row : row_of)
            values.push_back(value(row));
        return values;
    };
    grid.add("<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" "
             "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<UnstructuredGrid>\n"
             "<Piece NumberOfPoints=\"" +
             std::to_string(points.size()) + "\" NumberOfCells=\"" + std::to_string(row_of.size()) +
             "\">\n<Points>");
    grid.add("points", points);
    grid.add("</Points>\n<Cells>");
    grid.add("connectivity", 1, corners);
    grid.add("offsets", 1, ends);
    grid.add("types", 1, types);
    grid.add("</Cells>\n<CellData Scalars=\"sky\">");
    grid.add("surface", 1, std::vector<std::uint32_t>(row_of.begin(), row_of.end()));
    grid.add("area", 1, column([&](std::uint32_t row) { return table.surfaces[row].area; }));
    for (std::size_t k = 0; k < opens; ++k) {
        const std::string name = name_of(static_cast<Open>(k));
        const auto& open = table.factors.open;
        grid.add(name, 1, column([&](std::uint32_t row) { return open[row][k].factor; }));
        grid.add(name + "_standard_error", 1,
                 column([&](std::uint32_t row) { return open[row][k].standard_error; }));
    }
    if (table.has_pairs) {
        grid.add("row_sum", 1,
                 column([&](std::uint32_t row) { return table.factors.row_sum(row); }));
        grid.add("unlisted_bound", 1,
                 column([&](std::uint32_t row) { return table.factors.unlisted_bound[row]; }));
    }
    grid.add("</CellData>\n</Piece>\n</UnstructuredGrid>");
    grid.write(path);
}

} // namespace hemilux
