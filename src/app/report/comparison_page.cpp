#include "app/report/comparison_page.h"

#include "app/report/assets.h"
#include "app/report/mesh_arrays.h"
#include "app/report/page_file.h"
#include "radiosity/paper/scene/mesh.h"

namespace hemilux {
namespace {

void write_halves(PageFile& page, const std::string& id, std::span<const std::uint16_t> halves) {
    page.array(id, halves.size() / 3, [&](std::size_t i, std::string& bytes) {
        for (const std::uint16_t half : halves.subspan(3 * i, 3))
            append_number(bytes, half);
    });
}

} // namespace

double mean_light(const Mesh& mesh, std::span<const Vec3> radiosity) {
    double sum = 0, area = 0;
    for (std::size_t i = 0; i < radiosity.size(); ++i) {
        const Patch& patch = mesh.patches()[i];
        if (mesh.material(patch).is_far)
            continue;
        sum += patch.area * glm::dot(radiosity[i], Vec3(1.0)) / 3;
        area += patch.area;
    }
    return sum > 0 ? sum / area : 1;
}

void write_comparison_page(const std::string& path, const ComparisonContent& content) {
    PageFile page(path, assets::compare_markup);
    page.json("run", comparison_json(content));
    write_mesh_arrays(page, content.mesh, find_corner_classes(content.mesh));
    write_halves(page, "reference", halves_of(content.reference, content.unit));
    for (std::size_t m = 0; m < content.methods.size(); ++m)
        for (std::size_t k = 0; k < content.methods[m].lights.size(); ++k)
            write_halves(page, "light-" + std::to_string(m) + "-" + std::to_string(k),
                         content.methods[m].lights[k].halves);
    page.finish(assets::compare_script);
}

} // namespace hemilux
