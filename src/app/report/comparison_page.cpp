#include "app/report/comparison_page.h"

#include "app/report/assets.h"
#include "app/report/mesh_arrays.h"
#include "app/report/page_file.h"
#include "radiosity/paper/scene/mesh.h"

namespace hemilux {

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
