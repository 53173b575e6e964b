// .vtu: an independent reader of the arrays finds the columns of the patch table.
#include "io/files/error.h"
#include "io/meshes/vtu.h"
#include "io/results/csv.h"
#include "io/results/tables.h"
#include "radiosity/light/layers/layered_mesh.h"
#include "radiosity/paper/scene/mesh.h"
#include "support/catch.h"
#include "support/scenes.h"
#include "support/temporary_folder.h"
#include "support/vtk_arrays.h"

#include <cstring>
#include <map>
#include <sstream>

using namespace hemilux;
using namespace hemilux::test;

namespace {

std::vector<double> letters(const std::string& text) {
    std::vector<double> numbers(text.begin(), text.end());
    numbers.push_back(0);
    return numbers;
}

} // namespace

TEST_CASE("a .vtu file has the columns of the patch table") {
    Scene scene =
        box_room({1e5, 0, 0}, {1e5 + 3, 5, 7}, 2,
                 {{"white <&\"", {0.1, 0.2, 0.3}, Vec3(0)}, {"lamp", Vec3(0.5), {1, 2, 3}}},
                 {0, 1, 0, 0, 0, 0});
    scene.facets.push_back({{0, 1, 2, 2}, scene.faces++, 0, 0});
    const Mesh mesh = layered_mesh(std::move(scene), {.max_edge = 2});
    const std::size_t n = mesh.patches().size();
    Solution solution;
    for (std::size_t i = 0; i < n; ++i) {
        const auto x = static_cast<double>(i);
        solution.radiosity.push_back({x, 1 / (1 + x), 1e-9 * x});
        solution.standard_error.push_back({0.1, x, 0});
        solution.slope.push_back({{x, 1, 2}, {-x, 3, 0.1}});
        solution.weight.push_back(x / 2);
    }
    const TemporaryFolder folder;
    const CornerClasses classes = find_corner_classes(mesh);
    write_vtu(folder.path("a.vtu"), mesh, classes, solution,
              {"hemilux 7", "hemilux solve -- a", 3});
    auto arrays = arrays_of(content_of(folder.path("a.vtu")));
    CHECK(arrays["material_names"] == [] {
        std::vector<double> names = letters("white <&\""), lamp = letters("lamp");
        names.insert(names.end(), lamp.begin(), lamp.end());
        return names;
    }());
    CHECK(arrays["command"] == letters("hemilux solve -- a"));

    // Cells have the patches' corners.
    REQUIRE(arrays["offsets"].size() == n);
    for (std::size_t i = 0; i < n; ++i) {
        const Polygon& shape = mesh.patches()[i].shape;
        const auto corners = static_cast<std::size_t>(shape.size());
        CHECK(arrays["types"][i] == (corners == 3 ? 5 : 9));
        const auto end = static_cast<std::size_t>(arrays["offsets"][i]);
        for (std::size_t c = 0; c < corners; ++c) {
            const auto point = static_cast<std::size_t>(arrays["connectivity"][end - corners + c]);
            const Vec3 world = mesh.frame().to_world(shape.corner[c]);
            for (std::size_t axis = 0; axis < 3; ++axis)
                CHECK(arrays["points"][3 * point + axis] ==
                      Approx(world[static_cast<int>(axis)]).margin(1e-9));
        }
    }

    write_patch_table(folder.path("a.csv"), mesh, solution.radiosity, solution.standard_error,
                      Workers(1), solution.slope, solution.weight);
    const std::string text = content_of(folder.path("a.csv"));
    csv::Reader reader(folder.path("a.csv"), text);
    std::vector<std::string> header, row;
    reader.next(header);
    for (std::size_t i = 0; reader.next(row); ++i)
        for (std::size_t column = 0; column < header.size(); ++column) {
            const std::string& name = header[column];
            if (name == "material" || name == "group" || name.size() == 1)
                continue; // names; the centre
            const std::size_t last = name.rfind('_');
            const bool is_vector = last != name.npos || name.size() == 2;
            const std::string array = name.size() == 2 ? "normal" : name.substr(0, last);
            const std::size_t axis = !is_vector ? 0 : std::string("rgbxyz").find(name.back()) % 3;
            const std::vector<double>& values = arrays[array];
            INFO(name << " of patch " << i);
            REQUIRE(values.size() == n * (is_vector ? 3 : 1));
            CHECK(values[i * (is_vector ? 3 : 1) + axis] == std::stod(row[column]));
        }
    CHECK_THROWS_AS(write_vtu(folder.path("no/a.vtu"), mesh, classes, solution), OutputError);
}
