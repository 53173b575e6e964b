#include "geometry/box.h"
#include "io/files/error.h"
#include "io/gltf/document/container.h"
#include "io/gltf/gltf.h"
#include "io/meshes/glb.h"
#include "radiosity/answers/images/tone.h"
#include "radiosity/light/cached_light/patch_light.h"
#include "radiosity/paper/scene/mesh.h"
#include "support/catch.h"
#include "support/scenes.h"
#include "support/temporary_folder.h"

#include <cstring>
#include <nlohmann/json.hpp>

using namespace hemilux;
using namespace hemilux::test;

namespace {

using Json = nlohmann::json;

/// What the accessors of a file hold.
class Glb {
  public:
    explicit Glb(const std::string& path)
        : container_(gltf::read_container(path, {})), json(Json::parse(container_.json)) {}

    template <class T>
    [[nodiscard]] T value(const Json& accessor, std::size_t index, std::size_t component) const {
        const Json& view = json["bufferViews"][accessor["bufferView"].get<std::size_t>()];
        const std::size_t components = accessor["type"] == "VEC3" ? 3 : 1;
        const std::size_t stride = view.value("byteStride", components * sizeof(T));
        const std::size_t in_view =
            accessor["byteOffset"].get<std::size_t>() + index * stride + component * sizeof(T);
        REQUIRE(in_view + sizeof(T) <= view["byteLength"].get<std::size_t>());
        T result;
        std::memcpy(&result,
                    container_.binary->data() + view["byteOffset"].get<std::size_t>() + in_view,
                    sizeof(T));
        return result;
    }
    [[nodiscard]] Vec3 vector(const Json& accessor, std::size_t index) const {
        return {value<float>(accessor, index, 0), value<float>(accessor, index, 1),
                value<float>(accessor, index, 2)};
    }
    [[nodiscard]] const Json& accessor(const Json& index) const {
        return json["accessors"][index.get<std::size_t>()];
    }

  private:
    gltf::Container container_;

  public:
    Json json;
};

/// A room far from the origin, of triangles in one group and quads in the other.
Scene two_groups() {
    Scene scene =
        box_room({1e5, 0, 0}, {1e5 + 3, 5, 7}, 3,
                 {{"wall", Vec3(0.5), Vec3(0)}, {"lamp", Vec3(0.5), Vec3(9)}}, {0, 1, 0, 0, 0, 0});
    scene.groups = {"walls", "\xC3\xA4 \"lamp\" \xFF"};
    for (Facet& facet : scene.facets)
        facet.group = facet.material;
    return scene;
}

std::vector<Vec3> some_light(const Mesh& mesh) {
    std::vector<Vec3> b;
    for (std::uint32_t i = 0; i < mesh.patches().size(); ++i)
        b.push_back(mesh.material(i).emission + Vec3(0.25, 0.5, 1));
    return b;
}

VertexLight vertex_light(const Mesh& mesh, const CornerClasses& classes, const Display& display) {
    return {baked_light(mesh, classes, PatchLight(some_light(mesh)), Bake::radiosity),
            Bake::radiosity, display};
}

} // namespace

TEST_CASE("a glb holds the light of every patch, group by group") {
    const TemporaryFolder folder;
    const Mesh mesh(two_groups());
    const CornerClasses classes = find_corner_classes(mesh);
    const Display display(0.5, Tone::neutral);
    write_glb(folder.path("a.glb"), mesh, classes, vertex_light(mesh, classes, display),
              {"hemilux 1", "hemilux solve", 7});
    const Glb glb(folder.path("a.glb"));
    CHECK(glb.json["asset"]["generator"] == "hemilux 1");
    CHECK(glb.json["asset"]["extras"]["seed"] == 7);
    CHECK(glb.json["nodes"][0]["name"] == "walls");
    CHECK(glb.json["nodes"][1]["name"] == "\xC3\xA4 \"lamp\" \xEF\xBF\xBD");
    double area = 0;
    for (std::size_t group = 0; group < 2; ++group) {
        const Json& node = glb.json["nodes"][group];
        const Json& primitive =
            glb.json["meshes"][node["mesh"].get<std::size_t>()]["primitives"][0];
        const Json& attributes = primitive["attributes"];
        const Json& indices = glb.accessor(primitive["indices"]);
        const Json& positions = glb.accessor(attributes["POSITION"]);
        CHECK(positions["count"] == (group == 0 ? 5 : 1) * 16);
        CHECK(indices["count"] == (group == 0 ? 5 : 1) * 9 * 2 * 3);
        const Vec3 light = Vec3(0.25, 0.5, 1) + Vec3(group == 0 ? 0 : 9);
        const glm::vec3 shown = display(glm::vec3(light));
        std::array<Vec3, 3> corner;
        for (std::size_t k = 0; k < indices["count"].get<std::size_t>(); ++k) {
            const auto vertex = glb.value<std::uint32_t>(indices, k, 0);
            corner[k % 3] = glb.vector(positions, vertex);
            const Vec3 colour = glb.vector(glb.accessor(attributes["COLOR_0"]), vertex);
            const Vec3 b = glb.vector(glb.accessor(attributes["_RADIOSITY"]), vertex);
            for (int channel = 0; channel < 3; ++channel) {
                CHECK(colour[channel] == Approx(shown[channel]));
                CHECK(b[channel] == Approx(light[channel]));
            }
            if (k % 3 == 2) {
                const Vec3 normal = glm::cross(corner[1] - corner[0], corner[2] - corner[0]);
                area += glm::length(normal) / 2;
                CHECK(glm::dot(normal, corner[0]) < 0); // faces inwards, around the middle
            }
        }
    }
    CHECK(area == Approx(2 * (3 * 5 + 5 * 7 + 3 * 7)));
}

TEST_CASE("a glb that was written can be read as a scene") {
    const TemporaryFolder folder;
    Scene scene = two_groups();
    scene.groups[1] = "lamp";
    const Mesh mesh(scene);
    const CornerClasses classes = find_corner_classes(mesh);
    write_glb(folder.path("a.glb"), mesh, classes, vertex_light(mesh, classes, 1));
    const ReadResult read = read_gltf(folder.path("a.glb"));
    CHECK(read.scene.groups == scene.groups);
    CHECK(read.scene.facets.size() == 2 * mesh.patches().size());
    for (const Vec3& vertex : read.scene.vertices) {
        CHECK(vertex.x > 1e5 - 1e-6);
        CHECK(vertex.x < 1e5 + 3 + 1e-6);
        const double thirds = 3 * (vertex.x - 1e5) / 3;
        CHECK(std::abs(thirds - std::round(thirds)) < 1e-6);
    }
}

TEST_CASE("suns and skies are no part of a glb") {
    const TemporaryFolder folder;
    Scene scene = two_groups();
    scene.materials[1].is_far = true;
    const Mesh mesh(scene);
    const CornerClasses classes = find_corner_classes(mesh);
    write_glb(folder.path("a.glb"), mesh, classes, vertex_light(mesh, classes, 1));
    CHECK(Glb(folder.path("a.glb")).json["nodes"].size() == 1);
}

TEST_CASE("a glb that cannot be written is an OutputError") {
    const Mesh mesh(furnace_box(1, 0.5));
    const CornerClasses classes = find_corner_classes(mesh);
    CHECK_THROWS_AS(write_glb("/nonexistent/a.glb", mesh, classes, vertex_light(mesh, classes, 1)),
                    OutputError);
}

TEST_CASE("a scene whose z is upwards stands upright in a glb") {
    const TemporaryFolder folder;
    const Mesh mesh(two_groups());
    const CornerClasses classes = find_corner_classes(mesh);
    const VertexLight light = vertex_light(mesh, classes, Display());
    write_glb(folder.path("a.glb"), mesh, classes, light, {}, 2);
    const Box before = box_of(mesh.scene().vertices);
    const Box turned = box_of(read_gltf(folder.path("a.glb")).scene.vertices);
    const Vec3 low(before.low.x, before.low.z, -before.high.y);
    const Vec3 high(before.high.x, before.high.z, -before.low.y);
    for (int axis = 0; axis < 3; ++axis) {
        CHECK(turned.low[axis] == Approx(low[axis]).margin(1e-5));
        CHECK(turned.high[axis] == Approx(high[axis]).margin(1e-5));
    }
}
