// What is read again of a glTF file that is written with its light: the normals of its vertices.

#include "io/gltf/lit_source.h"

#include "io/files/error.h"
#include "io/gltf/gltf.h"
#include "io/gltf/gltf_text.h"
#include "radiosity/paper/scene/mesh.h"
#include "support/catch.h"
#include "support/temporary_folder.h"

using namespace hemilux;
using namespace hemilux::test;

namespace {

/// A triangle in the plane z = 0 with normals that lean towards x, shown by these nodes; a second
/// mesh, without normals, shows the same triangle.
std::string file_of(const std::string& nodes, const std::string& type = "VEC3") {
    const std::vector<float> corners{0, 0, 0, 1, 0, 0, 0, 1, 0},
        normals{0, 0, 2, .6f, 0, .8f, 0, .6f, .8f};
    return gltf_text(
        {bytes_of(corners), bytes_of(normals)},
        R"("accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"},)"
        R"({"bufferView":1,"componentType":5126,"count":3,"type":")" +
            type +
            R"("}],"meshes":[{"primitives":[{"attributes":{"POSITION":0,"NORMAL":1}}]},)"
            R"({"primitives":[{"attributes":{"POSITION":0}}]}],"nodes":[)" +
            nodes + "]");
}

std::vector<CornerNormals> normals_from(const std::string& text, bool turned = false) {
    const TemporaryFolder folder;
    const std::string path = folder.write("s.gltf", text);
    ReadResult read = read_gltf(path);
    if (turned)
        for (Facet& facet : read.scene.facets)
            facet.vertex = {facet.vertex[0], facet.vertex[2], facet.vertex[1], facet.vertex[1]};
    gltf::LitSource source(path, {}, Outside::reported, read.origins);
    return gltf::normals_of_file(source, Mesh(read.scene));
}

void check_normal(const glm::vec3& found, const Vec3& expected) {
    CHECK(glm::distance(Vec3(found), glm::normalize(expected)) < 1e-6);
}

} // namespace

TEST_CASE("normals are those of the vertices of each facet, as nodes place them", "[gltf]") {
    const std::vector<CornerNormals> normals =
        normals_from(file_of(R"({"mesh":0},{"mesh":1},{"mesh":0,"scale":[2,1,1]},)"
                             R"({"mesh":0,"rotation":[0,0.7071067811865476,0,0.7071067811865476]},)"
                             R"({"mesh":0,"scale":[-1,1,1]})"));
    REQUIRE(normals.size() == 5);
    check_normal(normals[0][0], {0, 0, 1});
    check_normal(normals[0][1], {.6, 0, .8});
    check_normal(normals[0][2], {0, .6, .8});
    CHECK(normals[0][3] == normals[0][2]);
    CHECK(normals[1] == CornerNormals{});      // a primitive without normals
    check_normal(normals[2][1], {.3, 0, .8});  // what is stretched leans less
    check_normal(normals[3][1], {.8, 0, -.6}); // z to x, and x to -z
    const glm::vec3 leaning = normals[4][1].x < 0 ? normals[4][1] : normals[4][2];
    check_normal(leaning, {-.6, 0, .8}); // mirrored
}

TEST_CASE("normals of facets that were turned around look to their new front", "[gltf]") {
    const std::vector<CornerNormals> turned = normals_from(file_of(R"({"mesh":0})"), true);
    check_normal(turned[0][0], {0, 0, -1});
    check_normal(turned[0][2], {-.6, 0, -.8});
}

TEST_CASE("normals of a wrong kind are refused with their accessor", "[gltf]") {
    CHECK_THROWS_WITH(normals_from(file_of(R"({"mesh":0})", "VEC2")),
                      Catch::Contains("/accessors/1: expected the type VEC3, found VEC2"));
}
