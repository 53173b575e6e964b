#include "io/scene_files/obj.h"

#include "support/catch.h"
#include "support/temporary_folder.h"

#include <cmath>
#include <string>

using namespace hemilux;
using hemilux::test::TemporaryFolder;

namespace {

const std::string triangle_vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

ReadResult read(const std::string& content) {
    const TemporaryFolder folder;
    return read_obj(folder.write("scene.obj", content));
}

/// The first warning with the text in it; empty when there is none.
std::string warning_about(const ReadResult& result, const std::string& text) {
    for (const std::string& warning : result.warnings)
        if (warning.find(text) != std::string::npos)
            return warning;
    return {};
}

std::string group_of_facet(const ReadResult& result, std::size_t facet) {
    return result.scene.groups.at(result.scene.facets.at(facet).group);
}
std::string material_of_facet(const ReadResult& result, std::size_t facet) {
    return result.scene.materials.at(result.scene.facets.at(facet).material).name;
}

} // namespace

TEST_CASE("a triangle and a quad are read", "[obj]") {
    const ReadResult result = read("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 2 3 4\n");
    const Scene& scene = result.scene;
    REQUIRE(scene.vertices.size() == 4);
    CHECK(scene.vertices[2] == Vec3(1, 1, 0));
    REQUIRE(scene.facets.size() == 2);
    CHECK(scene.facets[0].vertex == std::array<std::uint32_t, 4>{0, 1, 2, 2});
    CHECK(scene.facets[1].vertex == std::array<std::uint32_t, 4>{0, 1, 2, 3});
    CHECK(scene.faces == 2);
    REQUIRE(scene.materials.size() == 1);
    CHECK(scene.materials[0].name == "default");
    CHECK(scene.materials[0].reflectance == Vec3(0.5));
    CHECK(scene.materials[0].emission == Vec3(0.0));
    CHECK(scene.groups == std::vector<std::string>{"default"});
    CHECK(result.material_source == std::vector<std::string>{""});
    CHECK(result.warnings.empty());
}

TEST_CASE("all spellings of a vertex are read", "[obj]") {
    const ReadResult result = read("v 1 2 3\n"
                                   "v +.5 -0.25 1.\n"
                                   "v 1e1 -2.5E-1 3e+2 1.0\n"
                                   "\tv  0\t1   2 0.1 0.2 0.3\n"
                                   "v 1e-400 0.00000 -0 # a comment\n"
                                   "f 1 2 3 4 5\n");
    const std::vector<Vec3>& v = result.scene.vertices;
    REQUIRE(v.size() == 5);
    CHECK(v[0] == Vec3(1, 2, 3));
    CHECK(v[1] == Vec3(0.5, -0.25, 1));
    CHECK(v[2] == Vec3(10, -0.25, 300));
    CHECK(v[3] == Vec3(0, 1, 2));
    CHECK(v[4] == Vec3(0, 0, 0));
}

TEST_CASE("all spellings of a face are read", "[obj]") {
    const ReadResult result = read(triangle_vertices + "vt 0 0\nvn 0 0 1\n"
                                                       "f 1 2 3\n"
                                                       "f 1/1 2/1 3/1\n"
                                                       "f 1//1 2//1 3//1\n"
                                                       "f 1/1/1 2/1/1 3/1/1\n"
                                                       "f -3 -2 -1\n"
                                                       "f -3/-1/-1 -2/-1/-1 -1/-1/-1\n"
                                                       "  f\t1  2\t3   # comment\n"
                                                       "f 1 2 3# comment\n"
                                                       "f 1 2 \\\n 3\n"
                                                       "f \\\n1\\\n2\\\n3");
    REQUIRE(result.scene.facets.size() == 10);
    for (std::uint32_t f = 0; f < 10; ++f) {
        CHECK(result.scene.facets[f].vertex == std::array<std::uint32_t, 4>{0, 1, 2, 2});
        CHECK(result.scene.facets[f].face == f);
    }
    CHECK(result.warnings.empty());
}

TEST_CASE("negative indices count from the vertices so far, positive ones may be ahead", "[obj]") {
    const ReadResult result = read(triangle_vertices + "f -3 -2 -1\nv 5 5 5\nf -4 -3 -2\nf 1 2 5\n"
                                                       "v 9 9 9\nf 1 2 -1\n");
    REQUIRE(result.scene.facets.size() == 4);
    CHECK(result.scene.facets[1].vertex[0] == 0);
    CHECK(result.scene.facets[1].vertex[2] == 2);
    CHECK(result.scene.facets[2].vertex[2] == 4);
    CHECK(result.scene.facets[3].vertex[2] == 4);
}

TEST_CASE("every line end, a byte order mark and a missing final newline are fine", "[obj]") {
    const std::string lines = triangle_vertices + "g wall \\\nleft\nf 1 2 \\\n3";
    for (const std::string end : {"\n", "\r\n", "\r"})
        for (const std::string mark : {"", "\xef\xbb\xbf"}) {
            std::string content = mark;
            for (const char c : lines)
                content += c == '\n' ? end : std::string(1, c);
            const ReadResult result = read(content);
            CHECK(result.scene.facets.size() == 1);
            CHECK(result.scene.groups == std::vector<std::string>{"wall left"});
            CHECK(result.warnings.empty());
        }
}

TEST_CASE("a comment that ends with a backslash does not swallow the next line", "[obj]") {
    CHECK(read("# C:\\scenes\\\n" + triangle_vertices + "f 1 2 3 # x \\\nf 1 2 3\n")
              .scene.facets.size() == 2);
}

TEST_CASE("face numbers count every f line", "[obj]") {
    const ReadResult result = read(triangle_vertices + "v 2 2 0\nv .2 .2 0\n"
                                                       "f 1 2\n"     // 0: two corners
                                                       "f 1 2 2\n"   // 1: no area
                                                       "f 1 2 3\n"   // 2
                                                       "f 1 2 5 3\n" // 3: concave
                                                       "f 1 2 3\n"); // 4
    CHECK(result.scene.faces == 5);
    std::vector<std::uint32_t> numbers;
    for (const Facet& facet : result.scene.facets)
        numbers.push_back(facet.face);
    CHECK(numbers == std::vector<std::uint32_t>{2, 3, 3, 4});
    CHECK(result.degenerate_faces == 2);
    CHECK(result.concave_faces == 1);
    CHECK(result.nonplanar_faces == 0);
    CHECK(warning_about(result, "fewer than 3 corners").find("scene.obj:6:") != std::string::npos);
    CHECK(warning_about(result, "without area").find("scene.obj:7:") != std::string::npos);
    CHECK(result.warnings.size() == 2);
}

TEST_CASE("many faces without area give one warning", "[obj]") {
    std::string content = triangle_vertices + "f 1 2 3\n";
    for (int i = 0; i < 7; ++i)
        content += "f 1 1 2\n";
    const ReadResult result = read(content);
    REQUIRE(result.warnings.size() == 1);
    CHECK(result.warnings[0].find("scene.obj:5: 7 faces without area") != std::string::npos);
}

TEST_CASE("a non-planar quad is divided", "[obj]") {
    const ReadResult result = read("v 0 0 0\nv 1 0 0\nv 1 1 .1\nv 0 1 0\nf 1 2 3 4\n");
    CHECK(result.nonplanar_faces == 1);
    CHECK(result.scene.facets.size() == 2);
    CHECK(result.warnings.empty());
}

TEST_CASE("groups are those of the latest g since the last o, else of that o", "[obj]") {
    const ReadResult result = read(triangle_vertices + "f 1 2 3\n"
                                                       "o table\nf 1 2 3\n"
                                                       "g leg  left # the near one\nf 1 2 3\n"
                                                       "g never used\n"
                                                       "o chair\nf 1 2 3\n"
                                                       "g\nf 1 2 3\n"
                                                       "g leg left\nf 1 2 3\n"
                                                       "g M\xc3\xb6"
                                                       "bel #2\nf 1 2 3\n");
    CHECK(result.scene.groups == std::vector<std::string>{"default", "table", "leg left", "chair",
                                                          "M\xc3\xb6"
                                                          "bel #2"});
    CHECK(group_of_facet(result, 4) == "default");
    CHECK(group_of_facet(result, 5) == "leg left");
}

TEST_CASE("materials come from libraries, before or after their use", "[obj]") {
    const TemporaryFolder folder;
    folder.write("a.mtl", "newmtl unused\nKd .1 .1 .1\nnewmtl red wall\nKd .6 .1 .1\n");
    folder.write("b c.mtl", "newmtl lamp #1\nKd .8\nKe 17 12 4\n");
    const ReadResult result = read_obj(folder.write(
        "scene.obj", "mtllib a.mtl # walls\n" + triangle_vertices +
                         "usemtl red wall # by the door\nf 1 2 3\n"
                         "usemtl lamp #1\nf 1 2 3\nmtllib b c.mtl\nusemtl\nf 1 2 3\n"));
    CHECK(result.warnings.empty());
    REQUIRE(result.scene.materials.size() == 4);
    CHECK(result.scene.materials[0].name == "unused");
    CHECK(material_of_facet(result, 0) == "red wall");
    CHECK(material_of_facet(result, 1) == "lamp #1");
    CHECK(material_of_facet(result, 2) == "default");
    CHECK(result.scene.materials[1].reflectance == Vec3(.6, .1, .1));
    CHECK(result.scene.materials[2].reflectance == Vec3(.8));
    CHECK(result.scene.materials[2].emission == Vec3(17, 12, 4));
    CHECK(result.material_source[1] == folder.path("a.mtl") + ":3");
    CHECK(result.material_source[2] == folder.path("b c.mtl") + ":1");
    CHECK(result.material_source[3].empty());
}

TEST_CASE("libraries are found in every usual way", "[obj]") {
    for (const std::string names :
         {"x.mtl", "sub\\x.mtl", "./sub/x.mtl", "\"x.mtl\"", "C:\\models\\x.mtl", "y.mtl x.mtl",
          "x.mtl x.mtl", "/nowhere/x.mtl"}) {
        const TemporaryFolder folder;
        const std::string library = "newmtl m\nKd .25\n";
        if (names.find("sub") != std::string::npos)
            folder.write("sub/x.mtl", library);
        else
            folder.write("x.mtl", library);
        folder.write("y.mtl", "newmtl other\n");
        const ReadResult result = read_obj(folder.write(
            "scene.obj", "mtllib " + names + "\n" + triangle_vertices + "usemtl m\nf 1 2 3\n"));
        INFO(names);
        CHECK(result.warnings.empty());
        CHECK(result.scene.materials[result.scene.facets[0].material].reflectance == Vec3(.25));
    }
}

TEST_CASE("missing libraries and materials are warnings", "[obj]") {
    const ReadResult result =
        read("mtllib no such.mtl\n" + triangle_vertices +
             "usemtl a\nf 1 2 3\nusemtl b\nf 1 2 3\nusemtl a\nf 1 2 3\nusemtl unused\n");
    CHECK(warning_about(result, "scene.obj:1: material library \"no such.mtl\"") != "");
    CHECK(warning_about(result, "scene.obj:5: 2 materials used but not defined (\"a\", \"b\")") !=
          "");
    CHECK(result.warnings.size() == 2);
    REQUIRE(result.scene.materials.size() == 2);
    CHECK(result.scene.materials[1].reflectance == Vec3(0.5));
}

TEST_CASE("what is no polygon is passed over and said once", "[obj]") {
    const ReadResult result = read(triangle_vertices + "f 1 2 3\ns 1\ns off\nl 1 2\nl 2 3\np 1\n"
                                                       "cstype bezier\ndeg 3 3\ncurv 0 1 1 2 3\n"
                                                       "end\nunknown statement\nlod 3\n");
    CHECK(result.warnings.size() == 2);
    CHECK(warning_about(result, "scene.obj:7: 3 lines and points") != "");
    CHECK(warning_about(result, "scene.obj:10: 4 statements of free-form") != "");
}

TEST_CASE("a line of two megabytes is read in linear time", "[obj]") {
    constexpr int n = 150000;
    std::string content = triangle_vertices + "f 1 2 3\nv 0 0 1\nf";
    for (int i = 0; i < n; ++i)
        content += i % 1000 == 0 ? " \\\n 1/1/1" : " 1/1/1";
    content += " 2 3\n# " + std::string(2000000, 'x') + "\r";
    const ReadResult result = read(content);
    CHECK(result.scene.facets.size() == 2);
}

TEST_CASE("a polygon of a hundred thousand corners is read", "[obj]") {
    constexpr int n = 100000;
    std::string content, face = "f";
    for (int i = 0; i < n; ++i) {
        const double angle = 2 * 3.14159265358979 * i / n;
        content +=
            "v " + std::to_string(std::cos(angle)) + " " + std::to_string(std::sin(angle)) + " 0\n";
        face += " " + std::to_string(i + 1);
    }
    const ReadResult result = read(content + face);
    CHECK(result.scene.facets.size() > n / 4);
}
