#include "io/scene_files/inspect.h"

#include "io/scene_files/obj.h"

#include "support/catch.h"
#include "support/temporary_folder.h"

#include <cmath>
#include <string>

using namespace hemilux;
using hemilux::test::TemporaryFolder;

namespace {

/// A box of 1 x 2 x 3 whose faces have their own vertices.
std::string box_text(bool with_lid) {
    const char* const faces[] = {"v 0 0 0\nv 0 2 0\nv 1 2 0\nv 1 0 0\nusemtl lamp\n", // 1 x 2
                                 "v 0 0 0\nv 1 0 0\nv 1 0 3\nv 0 0 3\nusemtl wall\n", // 1 x 3
                                 "v 0 2 0\nv 0 2 3\nv 1 2 3\nv 1 2 0\n",
                                 "v -0 0 0\nv 0 0 3\nv 0 2 3\nv 0 2 0\n", // 2 x 3
                                 "v 1 0 0\nv 1 2 0\nv 1 2 3\nv 1 0 3\n",
                                 "v 0 0 3\nv 1 0 3\nv 1 2 3\nv 0 2 3\n"};
    std::string text = "mtllib box.mtl\n";
    for (const char* face : faces)
        if (with_lid || face != faces[5])
            text += face + std::string("f -4 -3 -2 -1\n");
    return text;
}

ReadResult read_box(bool with_lid, const std::string& more = "") {
    const TemporaryFolder folder;
    folder.write("box.mtl", "newmtl lamp\nKd .5\nKe 3 2 1\nnewmtl wall\nKd .7\nnewmtl spare\nKd 1\n"
                            "Ke 1\nnewmtl mirror\nKd 0.5 1.5 0.5\n");
    return read_obj(folder.write("box.obj", box_text(with_lid) + more));
}

} // namespace

TEST_CASE("a closed box is described in full", "[inspect]") {
    const SceneInfo info = inspect(read_box(true));
    CHECK(info.faces == 6);
    CHECK(info.facets == 6);
    CHECK(info.triangles == 0);
    CHECK(info.quads == 6);
    CHECK(info.vertices == 24);
    CHECK(info.materials == 4);
    CHECK(info.groups == 1);
    CHECK(info.bounds.low == Vec3(0.0));
    CHECK(info.bounds.high == Vec3(1, 2, 3));
    CHECK(info.total_area == Approx(22).epsilon(1e-14));
    CHECK(info.emitted_power.x == Approx(6).epsilon(1e-14));
    CHECK(info.emitted_power.y == Approx(4).epsilon(1e-14));
    CHECK(info.emitted_power.z == Approx(2).epsilon(1e-14));
    CHECK(info.open_edges == 0);
    CHECK(info.nonmanifold_edges == 0);
    REQUIRE(info.emitters.size() == 1);
    CHECK(info.emitters[0].name == "lamp");
    CHECK(info.emitters[0].emission == Vec3(3, 2, 1));
    CHECK(info.emitters[0].power == info.emitted_power);
    CHECK_FALSE(info.emitters[0].both_sides);
    CHECK(info.bad_reflectances.empty());
}

TEST_CASE("open and shared edges are counted", "[inspect]") {
    CHECK(inspect(read_box(false)).open_edges == 4);
    // A fin on an edge of the box: that edge has three faces, the fin's others one.
    const SceneInfo fin = inspect(read_box(true, "v 0 0 0\nv 1 0 0\nv 0 -1 0\nf -3 -2 -1\n"));
    CHECK(fin.nonmanifold_edges == 1);
    CHECK(fin.open_edges == 2);
    // The cuts of a divided face are no edges.
    const SceneInfo concave =
        inspect(read_box(true, "v 5 0 0\nv 6 0 0\nv 5.2 .2 0\nv 5 1 0\nf -4 -3 -2 -1\n"));
    CHECK(concave.facets == 8);
    CHECK(concave.open_edges == 4);
    CHECK(concave.concave_faces == 1);
}

TEST_CASE("reflectances outside [0,1] are named with their place", "[inspect]") {
    CHECK(find_bad_reflectances(read_box(true)).empty()); // spare is not in use
    ReadResult result = read_box(true, "usemtl mirror\nf 1 2 3\n");
    std::vector<std::string> messages = find_bad_reflectances(result);
    REQUIRE(messages.size() == 1);
    CHECK(messages[0].find("box.mtl:9: material \"mirror\" has reflectance 0.5 1.5 0.5") !=
          std::string::npos);
    result.scene.materials[3].reflectance = Vec3(0.5, 1, 0);
    CHECK(find_bad_reflectances(result).empty());
    result.scene.materials[3].reflectance = Vec3(std::nan(""));
    CHECK(find_bad_reflectances(result).size() == 1);
    result.scene.materials[3].reflectance = Vec3(-0.1);
    result.material_source.clear();
    messages = find_bad_reflectances(result);
    REQUIRE(messages.size() == 1);
    CHECK(messages[0].starts_with("material \"mirror\""));
}

TEST_CASE("areas of tiny and of huge scenes neither vanish nor overflow", "[inspect]") {
    for (const double size : {1e-90, 1e-3, 1e60}) {
        ReadResult result = read_box(true);
        for (Vec3& v : result.scene.vertices)
            v *= size;
        CHECK(inspect(result).total_area / size / size == Approx(22).epsilon(1e-12));
    }
}

TEST_CASE("the description says what there is and what is doubtful", "[inspect]") {
    const std::string closed = describe(inspect(read_box(true)));
    CHECK(closed.find("total area") != std::string::npos);
    CHECK(closed.find("22\n") != std::string::npos);
    CHECK(closed.find("6 4 2 W") != std::string::npos);
    ReadResult dark = read_box(true);
    for (Material& material : dark.scene.materials)
        material.emission = Vec3(0.0);
    CHECK(describe(inspect(dark)).find("nothing emits light") != std::string::npos);
    CHECK(closed.find("nothing emits light") == std::string::npos);
    CHECK(closed.find("edges of only one face") == std::string::npos);
    const std::string open = describe(inspect(read_box(false, "f 1 1 2\n")));
    CHECK(open.find("4 (edges of only one face") != std::string::npos);
    CHECK(open.find("without area        1 (face left out)") != std::string::npos);
    CHECK(closed.find("6 (6 quads)") != std::string::npos);
    CHECK(describe(inspect(read_box(true, "f 1 2 3\nf 1 1 2\nf 2 2 3\n")))
              .find("1 triangle and 6 quads") != std::string::npos);
    CHECK(describe(inspect(read_box(true, "f 1 1 2\nf 2 2 3\n"))).find("2 (faces left out)") !=
          std::string::npos);
}

TEST_CASE("facets beneath another that faces the same way are counted", "[inspect]") {
    // The last face again, begun at another corner and in the last bits elsewhere; once turned
    // round.
    const SceneInfo info = inspect(
        read_box(true, "f -2 -1 -4 -3\nf -1 -2 -3 -4\nv 0 0 3\nv 1 0 3.0000000000000004\nv 1 2 3\n"
                       "v 0 2 3\nf -4 -3 -2 -1\n"));
    CHECK(info.covered_facets == 2);
    CHECK(describe(info).find("covered             2 (faces in the place of another") !=
          std::string::npos);
    CHECK(inspect(read_box(true)).covered_facets == 0);
    CHECK(inspect(read_box(true, "v .2 .2 3\nv .7 .2 3\nv .7 .9 3\nv .2 .9 3\nf -4 -3 -2 -1\n"))
              .covered_facets == 1);
}
