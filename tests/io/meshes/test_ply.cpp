#include "io/files/error.h"
#include "io/meshes/ply.h"
#include "radiosity/answers/images/image.h"
#include "radiosity/answers/images/tone.h"
#include "radiosity/paper/scene/mesh.h"
#include "support/catch.h"
#include "support/scenes.h"
#include "support/temporary_folder.h"

#include <array>
#include <cmath>
#include <cstring>
#include <set>

using namespace hemilux;
using namespace hemilux::test;

namespace {

/// With the radiosity of patches, smoothed over corners.
void write_ply(const std::string& path, const Mesh& mesh, std::span<const Vec3> radiosity) {
    const CornerClasses classes = find_corner_classes(mesh);
    hemilux::write_ply(path, mesh, classes,
                       {baked_light(mesh, classes, radiosity, Bake::radiosity)});
}

struct Vertex {
    Vec3 position;
    std::array<float, 3> colour;
};
struct Ply {
    std::string header;
    std::vector<Vertex> vertices;
    std::vector<std::vector<std::uint32_t>> faces;
};

/// The next number of a little-endian file (this machine's order is the same).
template <class T>
T take(const std::string& file, std::size_t& at) {
    T value;
    REQUIRE(at + sizeof value <= file.size());
    std::memcpy(&value, file.data() + at, sizeof value);
    at += sizeof value;
    return value;
}

std::size_t count_in(const std::string& header, const std::string& element) {
    return std::stoul(header.substr(header.find("element " + element) + 9 + element.size()));
}

Ply read_ply(const std::string& path) {
    const std::string file = content_of(path), end = "end_header\n";
    std::size_t at = file.find(end) + end.size();
    Ply ply{file.substr(0, at), {}, {}};
    ply.vertices.resize(count_in(ply.header, "vertex"));
    for (Vertex& vertex : ply.vertices) {
        for (int axis = 0; axis < 3; ++axis)
            vertex.position[axis] = take<double>(file, at);
        for (float& channel : vertex.colour)
            channel = take<float>(file, at);
    }
    ply.faces.resize(count_in(ply.header, "face"));
    for (auto& face : ply.faces) {
        face.resize(take<std::uint8_t>(file, at));
        for (std::uint32_t& vertex : face)
            vertex = take<std::uint32_t>(file, at);
    }
    CHECK(at == file.size());
    return ply;
}

} // namespace

TEST_CASE("a PLY holds every patch in world units, with linear colours") {
    const TemporaryFolder folder;
    const Mesh mesh(box_room({1e5, 0, 0}, {1e5 + 3, 5, 7}, 3,
                             {{"wall", Vec3(0.5), Vec3(0)}, {"lamp", Vec3(0.5), Vec3(9)}},
                             {0, 1, 0, 0, 0, 0}));
    std::vector<Vec3> b;
    for (std::uint32_t i = 0; i < mesh.patches().size(); ++i)
        b.push_back(mesh.material(i).emission + Vec3(0.25, 0.5, 1));
    write_ply(folder.path("a.ply"), mesh, b);
    const Ply ply = read_ply(folder.path("a.ply"));
    CHECK(ply.header.starts_with("ply\nformat binary_little_endian 1.0\n"));
    CHECK(ply.header.find("property double x\nproperty double y\nproperty double z\n"
                          "property float red\nproperty float green\nproperty float blue\n") !=
          std::string::npos);
    REQUIRE(ply.vertices.size() == 6 * 16);
    REQUIRE(ply.faces.size() == mesh.patches().size());
    for (std::size_t i = 0; i < ply.faces.size(); ++i) {
        REQUIRE(ply.faces[i].size() == 4);
        for (std::size_t c = 0; c < 4; ++c) {
            const Vertex& vertex = ply.vertices.at(ply.faces[i][c]);
            const Vec3 expected = mesh.frame().to_world(mesh.patches()[i].shape.corner[c]);
            CHECK(glm::distance(vertex.position, expected) < 1e-9);
            for (std::size_t channel = 0; channel < 3; ++channel)
                CHECK(vertex.colour[channel] ==
                      Approx(b[i][static_cast<int>(channel)]).epsilon(1e-6));
        }
    }
}

TEST_CASE("triangles stay triangles in a PLY, and neighbours share vertices") {
    const TemporaryFolder folder;
    const Mesh mesh(sphere(3, 2, 0.5, 1));
    write_ply(folder.path("a.ply"), mesh, std::vector<Vec3>(mesh.patches().size(), Vec3(1)));
    const Ply ply = read_ply(folder.path("a.ply"));
    std::set<std::uint32_t> used;
    for (const auto& face : ply.faces) {
        CHECK(face.size() == 3);
        used.insert(face.begin(), face.end());
    }
    CHECK(used.size() == ply.vertices.size());
    CHECK(ply.vertices.size() == ply.faces.size() / 2 + 2);
}

TEST_CASE("a PLY for viewers holds what a picture shows, and the light beside it") {
    const TemporaryFolder folder;
    const Mesh mesh(furnace_box(1, 0.5));
    const CornerClasses classes = find_corner_classes(mesh);
    const Vec3 light(0.5, 0.25, 2);
    hemilux::write_ply(
        folder.path("a.ply"), mesh, classes,
        {std::vector<Vec3>(classes.position.size(), light), Bake::irradiance, Display(0.5)},
        PlyColours::shown);
    const std::string file = content_of(folder.path("a.ply")), end = "end_header\n";
    std::size_t at = file.find(end) + end.size();
    CHECK_THAT(file, Catch::Contains("property uchar red\nproperty uchar green\n"
                                     "property uchar blue\nproperty float quality\n"
                                     "property float irradiance_red\n"));
    REQUIRE(count_in(file, "vertex") == classes.position.size());
    for (std::size_t k = 0; k < classes.position.size(); ++k) {
        at += 3 * sizeof(double);
        for (int channel = 0; channel < 3; ++channel)
            CHECK(take<std::uint8_t>(file, at) ==
                  std::lround(255 * srgb_from_linear(static_cast<float>(light[channel] / 2))));
        CHECK(take<float>(file, at) == Approx(0.2126 * 0.5 + 0.7152 * 0.25 + 0.0722 * 2));
        for (int channel = 0; channel < 3; ++channel)
            CHECK(take<float>(file, at) == Approx(light[channel]));
    }
    for (std::size_t face = 0; face < mesh.patches().size(); ++face)
        at += take<std::uint8_t>(file, at) * sizeof(std::uint32_t);
    CHECK(at == file.size());
}

TEST_CASE("a PLY that cannot be written is an OutputError") {
    const Mesh mesh(furnace_box(1, 0.5));
    CHECK_THROWS_AS(write_ply("/nonexistent/a.ply", mesh, std::vector<Vec3>(6, Vec3(1))),
                    OutputError);
}
