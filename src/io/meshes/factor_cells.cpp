#include "io/meshes/factor_cells.h"

#include "io/meshes/vtk_grid.h"
#include "radiosity/paper/scene/mesh.h"

#include <limits>
#include <vector>

namespace hemilux {
namespace {

/// Corners and types of cells.
struct FactorCells {
    std::vector<Vec3> points;
    std::vector<std::uint32_t> corners;
    std::vector<std::uint64_t> ends;
    std::vector<std::uint8_t> types;

    void add(std::span<const Vec3> places, std::uint8_t type) {
        for (const Vec3& place : places) {
            corners.push_back(static_cast<std::uint32_t>(points.size()));
            points.push_back(place);
        }
        ends.push_back(corners.size());
        types.push_back(type);
    }
};

FactorCells cells_of(const Mesh& mesh, const FactorTable& table) {
    constexpr std::uint8_t vtk_vertex = 1, vtk_triangle = 5, vtk_quad = 9;
    FactorCells cells;
    for (const Patch& patch : mesh.patches()) {
        auto corners = patch.shape.corner;
        for (Vec3& corner : corners)
            corner = mesh.frame().to_world(corner);
        cells.add(std::span(corners).first(static_cast<std::size_t>(patch.shape.size())),
                  patch.shape.is_triangle() ? vtk_triangle : vtk_quad);
    }
    for (std::size_t k = 0; k < table.points.size(); ++k)
        cells.add(std::span(&table.places[k].position, 1), vtk_vertex);
    return cells;
}

/// Writes arrays with a number for each cell.
class FactorData {
  public:
    FactorData(VtkGrid& grid, std::span<const std::uint32_t> row_of, const FactorTable& table)
        : grid_(grid), row_of_(row_of), table_(table) {}

    /// Adds numbers: of_surface(row) for facets, of_point(k) for points.
    template <class OfSurface, class OfPoint>
    void add(const std::string& name, const OfSurface& of_surface, const OfPoint& of_point) {
        std::vector<decltype(of_surface(0))> values;
        for (const std::uint32_t row : row_of_)
            values.push_back(of_surface(row));
        for (std::size_t k = 0; k < table_.points.size(); ++k)
            values.push_back(of_point(k));
        grid_.add(name, 1, values);
    }
    /// Adds shares and, as NAME_standard_error, their errors. Points of which nothing is known
    /// have NaN.
    template <class OfSurface, class OfPoint>
    void add_shares(const std::string& name, const OfSurface& of_surface, const OfPoint& of_point) {
        const auto add_member = [&](const std::string& member_name, double OpenShare::*member) {
            add(
                member_name, [&](std::uint32_t row) { return of_surface(row).*member; },
                [&](std::size_t k) { return of_point(k).*member; });
        };
        add_member(name, &OpenShare::factor);
        add_member(name + "_standard_error", &OpenShare::standard_error);
    }

  private:
    VtkGrid& grid_;
    std::span<const std::uint32_t> row_of_;
    const FactorTable& table_;
};

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

void add_rows(FactorData& cells, const FactorTable& table) {
    const auto known = [&](std::size_t k, const auto& share) {
        const PointFactors& point = table.points[k];
        return point.is_known ? share(point) : OpenShare{unknown, unknown};
    };
    for (std::size_t open = 0; open < opens; ++open)
        cells.add_shares(
            name_of(static_cast<Open>(open)),
            [&](std::uint32_t row) { return table.factors.open[row][open]; },
            [&](std::size_t k) {
                return known(k, [&](const PointFactors& point) { return point.open[open]; });
            });
    for (std::size_t band = 0; table.bands && band < table.bands->size(); ++band)
        cells.add_shares(
            table.bands->name(band),
            [&](std::uint32_t row) { return table.factors.bands_of(row)[band]; },
            [&](std::size_t k) {
                return known(k, [&](const PointFactors& point) { return point.bands[band]; });
            });
    if (!table.has_pairs)
        return;
    cells.add(
        "row_sum", [&](std::uint32_t row) { return table.factors.row_sum(row); },
        [&](std::size_t k) { return table.points[k].is_known ? table.points[k].sum() : unknown; });
    cells.add(
        "unlisted_bound", [&](std::uint32_t row) { return table.factors.unlisted_bound[row]; },
        [&](std::size_t k) {
            return table.points[k].is_known ? table.points[k].unlisted_bound : unknown;
        });
}

} // namespace

void write_factor_vtu(const std::string& path, const Mesh& mesh,
                      std::span<const std::uint32_t> row_of, const FactorTable& table,
                      std::span<const std::vector<OpenShare>> sunlit) {
    VtkGrid grid;
    const FactorCells cells = cells_of(mesh, table);
    grid.add("<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" "
             "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<UnstructuredGrid>\n"
             "<Piece NumberOfPoints=\"" +
             std::to_string(cells.points.size()) + "\" NumberOfCells=\"" +
             std::to_string(cells.types.size()) + "\">\n<Points>");
    grid.add("points", cells.points);
    grid.add("</Points>\n<Cells>");
    grid.add("connectivity", 1, cells.corners);
    grid.add("offsets", 1, cells.ends);
    grid.add("types", 1, cells.types);
    grid.add("</Cells>\n<CellData Scalars=\"sky\">");
    FactorData data(grid, row_of, table);
    data.add(
        "surface", [](std::uint32_t row) { return row; },
        [&](std::size_t k) { return static_cast<std::uint32_t>(table.size() + k); });
    data.add(
        "area", [&](std::uint32_t row) { return table.surfaces[row].area; },
        [](std::size_t) { return 0.0; });
    add_rows(data, table);
    for (std::size_t sun = 0; sun < sunlit.size(); ++sun)
        data.add_shares(
            sunlit.size() > 1 ? "sunlit_" + std::to_string(sun) : "sunlit",
            [&](std::uint32_t row) { return sunlit[sun][row]; },
            [&](std::size_t k) { return sunlit[sun][table.surfaces.size() + k]; });
    grid.add("</CellData>\n</Piece>\n</UnstructuredGrid>");
    grid.write(path);
}

} // namespace hemilux
