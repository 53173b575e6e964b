#include "io/results/view_factor_legend.h"

#include "io/files/atomic_file.h"
#include "io/results/csv.h"

#include <span>
#include <vector>

namespace hemilux {
namespace {

std::string legend_header(const FactorTable& table) {
    std::string header = "surface,name,face,side,material,group,area,x,y,z,nx,ny,nz";
    for (std::size_t k = 0; k < opens; ++k) {
        const std::string name = name_of(static_cast<Open>(k));
        header += "," + name + "," + name + "_standard_error";
    }
    header += ",row_sum,unlisted_bound";
    for (std::size_t k = 0; table.bands && k < table.bands->size(); ++k)
        header += "," + table.bands->name(k) + "," + table.bands->name(k) + " standard error";
    return header;
}

void append_shares(std::string& line, std::span<const OpenShare> shares) {
    for (const OpenShare& open : shares) {
        csv::append_field(line, open.factor);
        csv::append_field(line, open.standard_error);
    }
}

std::size_t fields_of_bands(const FactorTable& table) {
    return table.bands ? 2 * table.bands->size() : 0;
}

std::string row_of_surface(const FactorTable& table, std::uint32_t i) {
    const FactorSurface& surface = table.surfaces[i];
    std::string line = std::to_string(i);
    csv::append_field(line, surface.name);
    line += "," + surface.face;
    csv::append_field(line, surface.side);
    csv::append_field(line, surface.material);
    csv::append_field(line, surface.group);
    csv::append_field(line, surface.area);
    csv::append_fields(line, surface.centre);
    csv::append_fields(line, surface.normal);
    append_shares(line, table.factors.open[i]);
    if (table.has_pairs) {
        csv::append_field(line, table.factors.row_sum(i));
        csv::append_field(line, table.factors.unlisted_bound[i]);
    } else {
        line += ",,";
    }
    append_shares(line, table.factors.bands_of(i));
    return line;
}

std::string row_of_point(const FactorTable& table, std::size_t k) {
    const PointFactors& point = table.points[k];
    std::string line = std::to_string(table.size() + k);
    csv::append_field(line, table.places[k].name);
    line += ",,,,,"; // face, side, material, group and area
    csv::append_fields(line, table.places[k].position);
    csv::append_fields(line, table.places[k].normal);
    if (!point.is_known)
        return line + std::string(2 * opens + 2 + fields_of_bands(table), ',');
    append_shares(line, point.open);
    csv::append_field(line, point.sum());
    csv::append_field(line, point.unlisted_bound);
    append_shares(line, point.bands);
    return line;
}

/// Returns the row of a column that is no surface. Bands of the sky have a direction.
std::string row_of_column(const FactorTable& table, std::size_t k, const std::string& name) {
    std::string line = std::to_string(table.surfaces.size() + k) + "," + name;
    const bool is_band =
        table.bands && table.columns.front() == Open::sky && k < table.bands->size();
    line += std::string(is_band ? 8 : 11, ',');
    if (is_band)
        csv::append_fields(line, table.bands->middle(k));
    return line + std::string(2 * opens + 2 + fields_of_bands(table), ',');
}

} // namespace

void write_factor_legend(const std::string& path, const FactorTable& table) {
    AtomicFile file(path);
    file.write(legend_header(table) + "\n");
    for (std::uint32_t i = 0; i < table.factors.rows(); ++i)
        file.write(row_of_surface(table, i) + "\n");
    const std::vector<std::string> columns = table.column_names();
    for (std::size_t k = 0; k < columns.size(); ++k)
        file.write(row_of_column(table, k, columns[k]) + "\n");
    for (std::size_t k = 0; k < table.points.size(); ++k)
        file.write(row_of_point(table, k) + "\n");
    file.commit();
}

} // namespace hemilux
