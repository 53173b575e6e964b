// Input files of View3D.
#include "io/scene_files/vs3.h"

#include "geometry/polygon.h"
#include "io/files/error.h"
#include "support/catch.h"
#include "support/temporary_folder.h"

#include <string>

using namespace hemilux;
using hemilux::test::TemporaryFolder;

namespace {

const std::string corners = "T two squares\n"
                            "C encl=0 list=3\n"
                            "F 3\n"
                            "! the corners\n"
                            "V 1 0. 0. 0.\nV 2 1. 0. 0. ! a comment\nV 3 1 1 0\nV 4 0 1 0\n"
                            "V 15 0 0 1\nv 16 1 0 1\nV 17 1 1 1\nV 18 0 1 1\n";
const std::string squares = "S 1 1 2 3 4 0 0 0.50 floor\nS 2 17 16 15 18 0 0 0.9 top side\n";

ReadResult read(const std::string& content) {
    const TemporaryFolder folder;
    return read_vs3(folder.write("s.vs3", content));
}

std::string error_of(const std::string& content) {
    const TemporaryFolder folder;
    const std::string path = folder.write("s.vs3", content);
    try {
        (void)read_vs3(path);
    } catch (const InputError& error) {
        return std::string(error.what()).substr(path.size() - 5);
    }
    return {};
}

} // namespace

TEST_CASE("surfaces of View3D are faces, each a group of its name") {
    const ReadResult result = read(corners + squares + "End of data\nS what follows is not read\n");
    const Scene& scene = result.scene;
    CHECK(scene.faces == 2);
    CHECK(scene.groups == std::vector<std::string>{"floor", "top side"});
    CHECK(scene.vertices.size() == 8);
    CHECK(result.face_lines == std::vector<std::uint32_t>{13, 14});
    CHECK(scene.materials[scene.facets[1].material].reflectance.x == Approx(.1));
    CHECK(polygon_of(scene.vertices, scene.facets[0].vertex).area_vector() == Vec3(0, 0, 1));
    CHECK(polygon_of(scene.vertices, scene.facets[1].vertex).area_vector() == Vec3(0, 0, -1));
    CHECK(result.warnings.empty());
}

TEST_CASE("surfaces of View3D may be triangles, obstructions, of one name, or combined") {
    const ReadResult result =
        read(corners + "S 1 1 2 3 0 0 0 0.5 half\nS 2 1 3 4 0 0 1 0.5 half\n"
                       "O 3 17 16 15 18 0 0 0.5 half\nS 4 15 16 17 0 0 0 0.5\n");
    const Scene& scene = result.scene;
    REQUIRE(scene.facets.size() == 4);
    CHECK(scene.facets[0].is_triangle());
    CHECK(scene.facets[1].group == scene.facets[0].group);
    CHECK(scene.facets[2].group != scene.facets[0].group);
    CHECK(scene.groups[scene.facets[0].group] == "half 1");
    CHECK(scene.groups[scene.facets[2].group] == "half 3");
    CHECK(scene.groups[scene.facets[3].group] == "surface 4");
    CHECK(result.warnings.size() == 1);
}

TEST_CASE("what is wrong in a file of View3D is said with its line") {
    CHECK(error_of(corners + "S 1 1 2 3 9 0 0 0.5 a\n") ==
          "s.vs3:13: expected a vertex that stands before, found 9");
    CHECK(error_of(corners + "S 1 1 2 3 4 0 7 0.5 a\n") ==
          "s.vs3:13: expected 0 or a surface that stands before, found 7");
    CHECK(error_of(corners + squares + "S 3 1 2 3 0 1 0 0.5 window\n")
              .starts_with("s.vs3:15: expected 0 as base"));
    CHECK(error_of(corners + "S 1 1 2 3 4 0 0 1.5 a\n") ==
          "s.vs3:13: expected an emittance from 0 to 1, found \"1.5\"");
    CHECK(error_of(corners + squares + squares) ==
          "s.vs3:15: expected a surface of another number: there is a surface 1 before");
    CHECK(error_of(corners + "V 1 0 0 0\n") ==
          "s.vs3:13: expected a vertex of another number: there is a vertex 1 before");
    CHECK(error_of("F 3a\nS 1 R 0 0 0.9 a\n") ==
          "s.vs3:1: expected F 3, geometry by vertices in three dimensions, found \"3a\"");
    CHECK(error_of("V 1 0 0 x\n").starts_with("s.vs3:1: expected"));
    CHECK(error_of("wall\n") == "s.vs3:1: expected T, C, F, V, S, O or End, found \"wall\"");
    CHECK(error_of("") == "s.vs3: no surfaces; expected a file of View3D");
    CHECK(error_of(corners + "S 1 1 2 2 2 0 0 0.5 a\n") ==
          "s.vs3: none of the surfaces has an area");
}
