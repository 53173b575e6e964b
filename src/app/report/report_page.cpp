#include "app/report/report_page.h"

#include "app/report/assets.h"
#include "app/report/mesh_arrays.h"
#include "app/report/page_file.h"
#include "radiosity/engine/densities/density.h"
#include "radiosity/paper/scene/mesh.h"

#include <algorithm>
#include <numbers>
#include <string>
#include <vector>

namespace hemilux {
namespace {

void write_light(PageFile& page, const ReportContent& content, const CornerClasses& classes) {
    const Solution& solution = content.solution;
    const std::vector<Vec3> light =
        smooth(content.mesh, classes, solution.radiosity, solution.slope);
    write_numbers(page, "light", light.size(), [&](std::size_t v) { return light[v]; });
    const auto write = [&](const char* id, const auto& value_of) {
        write_numbers(page, id, content.mesh.patches().size(), value_of);
    };
    write("radiosity", [&](std::size_t i) { return solution.radiosity[i]; });
    if (!solution.standard_error.empty())
        write("error", [&](std::size_t i) { return solution.standard_error[i]; });
    if (!solution.hits.empty())
        write("hits", [&](std::size_t i) { return static_cast<double>(solution.hits[i]); });
}

void write_lamps(PageFile& page, const ReportContent& content, const CornerClasses& classes) {
    const Mesh& mesh = content.mesh;
    const double unit = unit_of_lamps(content);
    for (std::size_t k = 0; k < content.lamps.patches.size(); ++k) {
        const Relit& lamp = content.lamps.patches[k];
        const std::string id = "lamp-" + std::to_string(k);
        write_halves(page, id, halves_of(lamp.radiosity, unit));
        write_halves(page, "smooth-" + id,
                     halves_of(smooth(mesh, classes, lamp.radiosity, lamp.slope), unit));
    }
    if (!content.lamps.patches.empty())
        page.array("lamp-of", mesh.patches().size(), [&](std::size_t i, std::string& bytes) {
            append(bytes, content.lamps.lamps.of_facet[mesh.patches()[i].facet]);
        });
}

void write_densities(PageFile& page, const ReportDensities& densities, std::size_t patches) {
    const std::vector<Vec3>& vertices = densities.hemisphere.vertices();
    const std::vector<Hemisphere::Cell>& cells = densities.hemisphere.cells();
    write_numbers(page, "vertices", vertices.size(), [&](std::size_t v) { return vertices[v]; });
    page.array("cells", cells.size(), [&](std::size_t c, std::string& bytes) {
        for (const std::uint16_t vertex : cells[c].vertex)
            append(bytes, std::uint32_t{vertex});
        append(bytes, std::uint32_t{cells[c].first_child});
    });
    write_numbers(page, "shares", cells.size(),
                  [&](std::size_t c) { return cells[c].projected_solid_angle / std::numbers::pi; });
    std::vector<DensityCount> counts;
    page.array("counts", patches, [&](std::size_t i, std::string& bytes) {
        constexpr char not_counted = '\xff';
        const std::size_t first = bytes.size();
        bytes.resize(first + vertices.size(), not_counted);
        counts.clear();
        densities.map.counts(static_cast<std::uint32_t>(i), counts);
        for (const auto& [vertex, surfaces] : counts)
            bytes[first + vertex] = static_cast<char>(std::min<int>(surfaces, 254));
    });
}

} // namespace

void write_report_page(const std::string& path, const ReportContent& content) {
    const CornerClasses classes = find_corner_classes(content.mesh);
    PageFile page(path, assets::solve_markup);
    page.json("run", run_json(content));
    write_mesh_arrays(page, content.mesh, classes);
    write_light(page, content, classes);
    for (const LightOfStep& light : content.lights)
        write_halves(page, "light-" + std::to_string(light.step), light.halves);
    write_lamps(page, content, classes);
    if (content.densities)
        write_densities(page, *content.densities, content.mesh.patches().size());
    page.finish(assets::solve_script);
}

} // namespace hemilux
