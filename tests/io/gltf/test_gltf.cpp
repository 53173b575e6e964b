// glTF 2.0: what is read of it. What is refused stands in test_gltf_errors.cpp.

#include "io/gltf/gltf.h"

#include "geometry/polygon.h"
#include "io/gltf/gltf_text.h"
#include "io/textures/webp.h"
#include "radiosity/engine/rays/point_emitter.h"
#include "radiosity/light/textures/textured_facets.h"
#include "support/catch.h"
#include "support/temporary_folder.h"

#include <numbers>

using namespace hemilux;
using namespace hemilux::test;

namespace {

const std::vector<float> square{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
const std::string positions = R"({"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"})";

ReadResult read(const std::string& text, const std::string& name = "s.gltf") {
    const TemporaryFolder folder;
    return read_gltf(folder.write(name, text));
}

/// A square of four vertices with these indices and nodes.
std::string file_of(const std::vector<std::uint16_t>& indices, const std::string& primitive,
                    const std::string& more) {
    return gltf_text(
        {bytes_of(square), bytes_of(indices)},
        R"("accessors":[)" + positions + R"(,{"bufferView":1,"componentType":5123,"count":)" +
            std::to_string(indices.size()) +
            R"(,"type":"SCALAR"}],"meshes":[{"name":"m","primitives":[{"attributes":{"POSITION":0})" +
            primitive + "}]}]," + more);
}

Vec3 area_vector(const Scene& scene) {
    Vec3 sum(0.0);
    for (const Facet& facet : scene.facets)
        sum += polygon_of(scene.vertices, facet.vertex).area_vector();
    return sum;
}

bool warns_of(const ReadResult& read, const std::string& text) {
    return std::ranges::any_of(read.warnings, [&](const std::string& warning) {
        return warning.find(text) != std::string::npos;
    });
}

const std::string one_node = R"("nodes":[{"mesh":0}])";

} // namespace

TEST_CASE("triangles, strips and fans face the same way", "[gltf]") {
    const std::vector<std::pair<std::vector<std::uint16_t>, int>> modes{
        {{0, 1, 2, 0, 2, 3}, 4}, {{0, 1, 3, 2}, 5}, {{0, 1, 2, 3}, 6}};
    for (const auto& [indices, mode] : modes) {
        const ReadResult result =
            read(file_of(indices, R"(,"indices":1,"mode":)" + std::to_string(mode), one_node));
        CAPTURE(mode);
        CHECK(result.scene.faces == 2);
        CHECK(area_vector(result.scene) == Vec3(0, 0, 1));
        CHECK(result.scene.vertices.size() == 4);
        CHECK(result.warnings.empty());
    }
}

TEST_CASE("without indices vertices follow each other", "[gltf]") {
    CHECK(area_vector(read(file_of({0}, R"(,"mode":6)", one_node)).scene) == Vec3(0, 0, 1));
}

TEST_CASE("points and lines are left out and reported", "[gltf]") {
    const std::string text = gltf_text(
        {bytes_of(square)},
        R"("accessors":[)" + positions +
            R"(],"meshes":[{"primitives":[{"attributes":{"POSITION":0},"mode":6},)"
            R"({"attributes":{"POSITION":0},"mode":0},{"attributes":{"POSITION":0},"mode":3}]}],)" +
            one_node);
    const ReadResult result = read(text);
    CHECK(result.scene.faces == 2);
    CHECK(warns_of(result, "2 primitives of points or lines"));
}

TEST_CASE("nodes move, turn, scale and mirror; names are groups", "[gltf]") {
    const ReadResult result = read(file_of(
        {0, 1, 2, 0, 2, 3}, R"(,"indices":1)",
        R"("nodes":[{"name":"parent","translation":[10,0,0],"scale":[2,2,2],"children":[1,2]},)"
        R"({"name":"mirrored","mesh":0,"scale":[-1,1,1]},)"
        R"({"mesh":0,"matrix":[0,1,0,0,-1,0,0,0,0,0,1,0,0,5,0,1]}],"scenes":[{"nodes":[0]}])"));
    const Scene& scene = result.scene;
    CHECK(scene.groups == std::vector<std::string>{"mirrored", "m"});
    REQUIRE(scene.facets.size() == 4);
    for (const Facet& facet : scene.facets)
        CHECK(polygon_of(scene.vertices, facet.vertex).normal() == Vec3(0, 0, 1));
    CHECK(scene.vertices[1] == Vec3(8, 0, 0));
    CHECK(scene.vertices[5] == Vec3(10, 12, 0));
    const ReadResult turned = read(
        file_of({0, 1, 2}, R"(,"indices":1)",
                R"("nodes":[{"mesh":0,"rotation":[0,0.7071067811865476,0,0.7071067811865476]}])"));
    CHECK(turned.scene.vertices[1].z == Approx(-1));
}

TEST_CASE("components of all types are read, normalized or not", "[gltf]") {
    const auto corner = [](const std::string& bytes, int component, bool normalized) {
        const std::string text = gltf_text(
            {bytes},
            R"("accessors":[{"bufferView":0,"count":3,"type":"VEC3","componentType":)" +
                std::to_string(component) + R"(,"normalized":)" + (normalized ? "true" : "false") +
                R"(}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],)" + one_node);
        return read(text).scene.vertices.at(1);
    };
    const std::string int8 = bytes_of(std::vector<std::int8_t>{0, 0, 0, 127, -128, 1, 0, 100, 0});
    CHECK(corner(int8, 5120, false) == Vec3(127, -128, 1));
    CHECK(corner(int8, 5120, true) == Vec3(1, -1, 1.0 / 127));
    const std::string uint8 = bytes_of(std::vector<std::uint8_t>{0, 0, 0, 255, 51, 1, 0, 100, 0});
    CHECK(corner(uint8, 5121, true) == Vec3(1, .2, 1.0 / 255));
    const std::string int16 = bytes_of(std::vector<std::int16_t>{0, 0, 0, 32767, -7, 1, 0, 100, 0});
    CHECK(corner(int16, 5122, false) == Vec3(32767, -7, 1));
    const std::string uint16 =
        bytes_of(std::vector<std::uint16_t>{0, 0, 0, 65535, 13107, 1, 0, 100, 0});
    CHECK(corner(uint16, 5123, true) == Vec3(1, .2, 1.0 / 65535));
}

TEST_CASE("sparse elements replace others, also where those are zeros", "[gltf]") {
    const std::vector<std::uint8_t> where{1, 2};
    const std::vector<float> values{3, 0, 0, 0, 3, 0};
    const std::string sparse =
        R"("sparse":{"count":2,"indices":{"bufferView":1,"componentType":5121},)"
        R"("values":{"bufferView":2}}})";
    for (const std::string base : {R"("bufferView":0,)", ""}) {
        const std::string text = gltf_text(
            {bytes_of(square), bytes_of(where), bytes_of(values)},
            R"("accessors":[{)" + base + R"("componentType":5126,"count":3,"type":"VEC3",)" +
                sparse + R"(],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],)" +
                one_node);
        CHECK(area_vector(read(text).scene) == Vec3(0, 0, 4.5));
    }
}

TEST_CASE("materials: base colour, emission, and what is not diffuse", "[gltf]") {
    const ReadResult result = read(file_of(
        {0, 1, 2}, R"(,"indices":1,"material":1)",
        one_node + R"(,"materials":[{"name":"unused"},{"name":"lamp","alphaMode":"BLEND",)"
                   R"("pbrMetallicRoughness":{"baseColorFactor":[0.5,0.25,0,0.25]},)"
                   R"("emissiveFactor":[1,0.5,0],)"
                   R"("extensions":{"KHR_materials_emissive_strength":{"emissiveStrength":4}}}])"));
    const Material& lamp = result.scene.materials.at(1);
    CHECK(lamp.name == "lamp");
    CHECK(lamp.reflectance == Vec3(.5, .25, 0));
    CHECK(lamp.emission.x == Approx(4 * std::numbers::pi));
    CHECK(lamp.emission.y == Approx(2 * std::numbers::pi));
    CHECK(warns_of(result, "a material is a metal"));
    CHECK(warns_of(result, "a material lets light through; it is opaque here"));
    CHECK(result.material_source.at(1).ends_with("s.gltf: /materials/1"));
}

TEST_CASE("unlit materials emit what they show, colours of vertices included", "[gltf]") {
    // A square whose two triangles share the colours of their corners: red 1 on the left, 0.5 on
    // the right.
    const std::vector<float> colours{1, 0, 0, 1, .5f, 0, 0, 1, .5f, 0, 0, 1, 1, 0, 0, 1};
    const std::vector<std::uint16_t> indices{0, 1, 2, 0, 2, 3};
    const auto with_material = [&](const std::string& material) {
        return read(gltf_text(
            {bytes_of(square), bytes_of(indices), bytes_of(colours)},
            R"("accessors":[)" + positions +
                R"(,{"bufferView":1,"componentType":5123,"count":6,"type":"SCALAR"},)"
                R"({"bufferView":2,"componentType":5126,"count":4,"type":"VEC4"}],)"
                R"("meshes":[{"primitives":[{"attributes":{"POSITION":0,"COLOR_0":2},"indices":1,)"
                R"("material":0}]}],)" +
                one_node + R"(,"materials":[)" + material + "]"));
    };
    const ReadResult result =
        with_material(R"({"name":"shown","pbrMetallicRoughness":{"baseColorFactor":[0.5,1,1,1]},)"
                      R"("emissiveFactor":[0,0,9],"extensions":{"KHR_materials_unlit":{}}})");
    const Material& material = result.scene.materials.at(0);
    CHECK(material.reflectance == Vec3(0.0));
    CHECK(material.emission.r == Approx(std::numbers::pi * .5 * .75));
    CHECK(material.emission.g == 0);
    CHECK(material.emission.b == 0);
    REQUIRE(result.scene.colours_vary_on(0));
    for (std::uint32_t f = 0; f < 2; ++f) {
        const Polygon shape = polygon_of(result.scene.vertices, result.scene.facets[f].vertex);
        for (const double x : {.3, .5, .6}) { // both triangles have a point there
            const Vec3 point(x, f == 0 ? x / 2 : (1 + x) / 2, 0);
            CHECK(colours_at_point(result.scene, f, shape, point).emission.r ==
                  Approx(std::numbers::pi * .5 * (1 - x / 2)));
        }
        // The mean of a triangle is the colour at its centre.
        CHECK(mean_colours(result.scene, f, shape, shape).emission.r ==
              Approx(std::numbers::pi * .5 * (1 - shape.centre().x / 2)));
    }
    CHECK(warns_of(result, "material 'shown' is unlit (KHR_materials_unlit)"));
    CHECK_FALSE(warns_of(result, "colours of vertices"));
    CHECK_FALSE(warns_of(result, "a metal"));

    // Those of a material that is lit are colours of a surface, which are not read.
    const ReadResult lit = with_material(R"({"name":"lit"})");
    CHECK(lit.scene.materials.at(0).emission == Vec3(0.0));
    CHECK(warns_of(lit, "colours of vertices, which are not read"));
    CHECK_FALSE(lit.scene.colours_vary_on(0));
}

TEST_CASE("glass lets through what alpha does not cover, and what is transmitted", "[gltf]") {
    const auto read_with = [](const std::string& material) {
        return read(file_of({0, 1, 2}, R"(,"indices":1,"material":0)",
                            one_node + R"(,"materials":[{)" + material + "}]"));
    };
    const auto through = [&](const std::string& material) {
        const ReadResult result = read_with(material);
        return result.glass.empty() ? Vec3(0) : result.glass.at(0).transmittance;
    };
    const std::string quarter =
        R"("pbrMetallicRoughness":{"metallicFactor":0,"baseColorFactor":[0.5,1,0,0.25]})";
    const std::string half =
        R"("extensions":{"KHR_materials_transmission":{"transmissionFactor":0.5}})";
    CHECK(through(quarter) == Vec3(0));
    CHECK(through(R"("alphaMode":"OPAQUE",)" + quarter) == Vec3(0));
    CHECK(through(R"("alphaMode":"BLEND",)" + quarter) == Vec3(.75));
    CHECK(through(half) == Vec3(0)); // a metal, where the file does not say otherwise
    CHECK(through(half + R"(,"pbrMetallicRoughness":{"metallicFactor":0.5})") == Vec3(.25));
    CHECK(through(half + "," + quarter) == Vec3(.25, .5, 0));
    CHECK(through(R"("alphaMode":"BLEND",)" + half + "," + quarter) ==
          Vec3(.8125, .875, .75)); // the rest by half, in the base colour
    CHECK(through(R"("alphaMode":"BLEND")") == Vec3(0));
    CHECK_FALSE(warns_of(read_with(R"("alphaMode":"BLEND")"), "light through"));

    const ReadResult mask = read_with(R"("alphaMode":"MASK",)" + half);
    CHECK(mask.glass.empty());
    CHECK(warns_of(mask, "a material lets light through by a texture; it is opaque here"));
}

TEST_CASE("buffers lie in the file, beside it, or in the binary chunk", "[gltf]") {
    const std::string rest =
        R"("bufferViews":[{"buffer":0,"byteLength":48}],"accessors":[)" + positions +
        R"(],"meshes":[{"primitives":[{"attributes":{"POSITION":0},"mode":6}]}],)" + one_node + "}";
    const std::string asset = R"({"asset":{"version":"2.0"},)";
    const TemporaryFolder folder;
    (void)folder.write("a b.bin", bytes_of(square));
    const std::string beside = folder.write(
        "s.gltf", asset + R"("buffers":[{"byteLength":48,"uri":"a%20b.bin"}],)" + rest);
    const ReadResult result = read_gltf(beside);
    CHECK(area_vector(result.scene) == Vec3(0, 0, 1));
    CHECK(result.libraries == std::vector<std::string>{folder.path("a b.bin")});
    const std::string glb =
        glb_of(asset + R"("buffers":[{"byteLength":48}],)" + rest, bytes_of(square));
    CHECK(area_vector(read(glb, "s.glb").scene) == Vec3(0, 0, 1));
}

TEST_CASE("point and spot lights are lights without extent", "[gltf]") {
    const auto light_of = [](const std::string& light) {
        const ReadResult result = read(file_of(
            {0, 1, 2}, R"(,"indices":1)",
            R"("nodes":[{"mesh":0},{"name":"l","translation":[0,0,3],"extensions":)"
            R"({"KHR_lights_punctual":{"light":0}}}],"extensions":{"KHR_lights_punctual":{"lights":[)" +
                light + "]}}"));
        CHECK(result.warnings.empty());
        CHECK(result.scene.faces == 1);
        REQUIRE(point_emitters_of(result.scene).size() == 1);
        const PointEmitter found = point_emitters_of(result.scene)[0];
        CHECK(found.name == "l");
        CHECK(found.position == Vec3(0, 0, 3));
        CHECK(found.axis == Vec3(0, 0, -1));
        return found;
    };
    const PointEmitter point = light_of(R"({"type":"point","intensity":2,"color":[1,0.5,0]})");
    CHECK(point.intensity == Vec3(2, 1, 0));
    CHECK(relative_intensity(point, {0, 0, 1}) == 1);
    const PointEmitter spot = light_of(
        R"({"type":"spot","intensity":3,"spot":{"innerConeAngle":0.5,"outerConeAngle":1}})");
    CHECK(spot.intensity == Vec3(3));
    CHECK(spot.cos_inner == Approx(std::cos(.5)));
    CHECK(spot.cos_outer == Approx(std::cos(1)));
}

TEST_CASE("a directional light gives its illuminance", "[gltf]") {
    const ReadResult result = read(file_of(
        {0, 1, 2}, R"(,"indices":1)",
        R"("nodes":[{"mesh":0},{"extensions":{"KHR_lights_punctual":{"light":0}}}],)"
        R"("extensions":{"KHR_lights_punctual":{"lights":[{"type":"directional","intensity":3}]}})"));
    const Scene& scene = result.scene;
    const Vec3 below(.3, .3, 0); // the light shines along -z
    double irradiance = 0;
    for (const Facet& facet : scene.facets) {
        const Polygon shape = polygon_of(scene.vertices, facet.vertex);
        const Vec3 way = shape.centre() - below;
        const double distance = glm::length(way);
        irradiance += scene.materials[facet.material].emission.x * shape.area() *
                      -glm::dot(shape.normal(), way) * way.z /
                      (std::numbers::pi * std::pow(distance, 4));
    }
    CHECK(irradiance == Approx(3).epsilon(1e-3));
}

TEST_CASE("the first perspective camera is that of the scene", "[gltf]") {
    const ReadResult result = read(file_of(
        {0, 1, 2}, R"(,"indices":1)",
        R"("nodes":[{"mesh":0},{"camera":0},{"camera":1,"translation":[0,0,5],"scale":[2,2,2]}],)"
        R"("cameras":[{"type":"orthographic"},{"name":"eye","type":"perspective",)"
        R"("perspective":{"yfov":1.5707963267948966}}])"));
    REQUIRE(result.camera);
    CHECK(result.camera_name == "eye");
    CHECK(result.camera->eye == Vec3(0, 0, 5));
    CHECK(result.camera->target == Vec3(0, 0, 4));
    CHECK(result.camera->up == Vec3(0, 1, 0));
    CHECK(result.camera->vertical_fov_degrees == Approx(90));
}

TEST_CASE("a mesh is shown once for each instance, and hidden nodes are not", "[gltf]") {
    const std::vector<float> moves{0, 0, 0, 5, 0, 0, 0, 5, 0}, sizes{1, 1, 1, 2, 2, 1, 1, 1, 1};
    const auto text = [&](const std::string& nodes) {
        return gltf_text(
            {bytes_of(square), bytes_of(moves), bytes_of(sizes)},
            R"("accessors":[)" + positions +
                R"(,{"bufferView":1,"componentType":5126,"count":3,"type":"VEC3"},)"
                R"({"bufferView":2,"componentType":5126,"count":3,"type":"VEC3"}],)"
                R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"mode":6}]}],"nodes":)" +
                nodes);
    };
    const ReadResult stools = read(text(
        R"([{"name":"stools","mesh":0,"scale":[3,1,1],"extensions":{"EXT_mesh_gpu_instancing":)"
        R"({"attributes":{"TRANSLATION":1,"SCALE":2}}}}])"));
    CHECK(stools.scene.faces == 6);
    CHECK(area_vector(stools.scene) == Vec3(0, 0, 3 * (1 + 4 + 1)));
    CHECK(stools.scene.vertices[4] == Vec3(21, 0, 0)); // the corner (1, 0, 0)
    CHECK(stools.warnings.empty());
    REQUIRE(stools.origins.size() == 3);
    CHECK(stools.origins[2].instance == 2);
    CHECK(stools.origins[2].first_face == 4);

    const ReadResult hidden = read(text(
        R"([{"mesh":0},{"extensions":{"KHR_node_visibility":{"visible":false}},"children":[2]},)"
        R"({"mesh":0}])"));
    CHECK(hidden.scene.faces == 2);
    CHECK(hidden.warnings.empty());
}

TEST_CASE("what a file uses and what is not read has a warning", "[gltf]") {
    const ReadResult unknown = read(
        file_of({0, 1, 2}, R"(,"indices":1)", one_node + R"(,"extensionsUsed":["X_bends_light"])"));
    CHECK(warns_of(unknown, "uses extensions that are not read: X_bends_light"));

    const auto read_webp = [](const std::string& uri) {
        return read(file_of(
            {0, 1, 2}, R"(,"indices":1,"material":0)",
            one_node + R"(,"extensionsRequired":["EXT_texture_webp"],"images":[{"uri":")" + uri +
                R"("}],"textures":[{"extensions":{"EXT_texture_webp":{"source":0}}}],"materials":)"
                R"([{"pbrMetallicRoughness":{"metallicFactor":0,"baseColorFactor":)"
                R"([0.25,0.5,0.5,1],"baseColorTexture":{"index":0}}}])"));
    };
    const ReadResult missing = read_webp("a.webp");
    CHECK(warns_of(missing, "a texture is not found, or neither PNG nor JPEG"));
    CHECK(missing.scene.materials[0].reflectance == Vec3(.25, .5, .5));
    // One texel is red, the other one blue.
    const ReadResult found =
        read_webp("data:image/webp;base64,UklGRh4AAABXRUJQVlA4TBEAAAAvAQAAAA8Q87//8x8OMqL/AQA=");
    const bool readable = is_readable_webp("RIFF....WEBP");
    CHECK(warns_of(found, "a texture is not found") != readable);
    CHECK(found.scene.materials[0].reflectance ==
          (readable ? Vec3(.125, 0, .25) : Vec3(.25, .5, .5)));
}
