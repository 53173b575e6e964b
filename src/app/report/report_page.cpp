#include "app/report/report_page.h"

#include "app/report/assets.h"
#include "app/report/mesh_arrays.h"
#include "app/report/page_file.h"
#include "radiosity/scene/mesh.h"

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

} // namespace

void write_report_page(const std::string& path, const ReportContent& content) {
    const CornerClasses classes = find_corner_classes(content.mesh);
    PageFile page(path, assets::solve_markup);
    page.json("run", run_json(content));
    write_mesh_arrays(page, content.mesh, classes);
    write_light(page, content, classes);
    page.finish(assets::solve_script);
}

} // namespace hemilux
