// What hemilux bake writes without --bind: any viewer shows the file as it is lit, and what the
// file says of its materials stays as a variant.
#include "app/check_fails.h"
#include "app/running/small_room.h"
#include "io/pictures/picture_files.h"
#include "io/textures/texture_files.h"
#include "radiosity/answers/images/image.h"
#include "support/catch.h"

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

using Catch::Contains;
using test::fast;
using test::Glb;
using test::glb_from;
using test::Json;
using test::SmallRoom;
using test::Workplace;

namespace {

std::string picture_of(const Glb& file, std::size_t texture) {
    const Json& image = file.json["images"][file.json["textures"][texture]["source"].get<int>()];
    const Json& view = file.json["bufferViews"][image["bufferView"].get<std::size_t>()];
    return file.binary.substr(view["byteOffset"], view["byteLength"]);
}

/// A primitive's material that is shown, and that of a variant.
struct Shown {
    Json lit, own;
};
Shown shown_by(const Json& json, std::size_t mesh) {
    const Json& primitive = json["meshes"][mesh]["primitives"][0];
    const Json& variants = json["extensions"]["KHR_materials_variants"]["variants"];
    const Json& mappings = primitive["extensions"]["KHR_materials_variants"]["mappings"];
    Shown shown;
    shown.lit = json["materials"][primitive["material"].get<std::size_t>()];
    for (const Json& mapping : mappings)
        for (const Json& variant : mapping["variants"]) {
            const Json& material = json["materials"][mapping["material"].get<std::size_t>()];
            if (variants[variant.get<std::size_t>()]["name"] == "lightmap")
                shown.own = material;
            if (variants[variant.get<std::size_t>()]["name"] == "lit")
                CHECK(material == shown.lit);
        }
    return shown;
}

/// Lets a material of the room have this picture as its base colour.
void add_texture(Json& scene, std::size_t material, const std::string& uri) {
    scene["images"].push_back({{"uri", uri}});
    scene["textures"].push_back({{"source", scene["images"].size() - 1}});
    scene["materials"][material]["pbrMetallicRoughness"]["baseColorTexture"] = {
        {"index", scene["textures"].size() - 1}};
}

} // namespace

TEST_CASE("a baked file is shown as it is lit, and keeps its materials for engines") {
    const Workplace place;
    Json scene = Json::parse(SmallRoom{}.text());
    scene["materials"][0]["doubleSided"] = true;
    place.write("room.gltf", scene.dump());
    for (const std::string threads : {"1", "3"}) {
        const auto run = place.hemilux("bake room.gltf -o lit.glb --error 10% --max-rays 200000 "
                                       "--gather 4 --lightmap 64 -t " +
                                       threads);
        REQUIRE(run.code == 0);
        CHECK_THAT(run.err, Contains("to see it, drag lit.glb into a glTF viewer") &&
                                Contains("lit.lightmap.exr, TEXCOORD_2"));
        place.write("lit" + threads + ".glb", place.read("lit.glb"));
    }
    const Glb file = glb_from(place.read("lit1.glb"));
    const Json& json = file.json;
    for (const std::size_t mesh : {0u, 1u, 2u}) {
        const auto [lit, own] = shown_by(json, mesh);
        CHECK(lit["extensions"].contains("KHR_materials_unlit"));
        const Json& info = lit["pbrMetallicRoughness"]["baseColorTexture"];
        CHECK(info["texCoord"] == 2);
        CHECK(json["textures"][info["index"].get<std::size_t>()]["extras"]["hemilux"]["bake"] ==
              "shown");
        CHECK(own["extensions"]["MOZ_lightmap"]["texCoord"] == 2);
        CHECK(own["extensions"]["MOZ_lightmap"]["index"] == json["textures"].size() - 1);
        CHECK(lit.value("doubleSided", false) == (mesh == 0));
    }
    Json paint = shown_by(json, 0).own;
    paint.erase("extensions");
    CHECK(paint == scene["materials"][0]);
    // The cube has no material, which would be a metal.
    const Json cube = shown_by(json, 2).own["pbrMetallicRoughness"];
    CHECK(cube["baseColorFactor"] == Json::array({.5, .5, .5, 1}));
    CHECK(cube["metallicFactor"] == 0);
    CHECK(cube["roughnessFactor"] == 1);
    for (const char* const name : {"KHR_materials_unlit", "KHR_materials_variants", "MOZ_lightmap"})
        CHECK(std::ranges::count(json["extensionsUsed"], name) == 1);
    CHECK(place.hemilux("info lit.glb").code == 0);
}

TEST_CASE("bake adds to the variants of a file, and leaves unlit materials as they are") {
    const Workplace place;
    Json scene = Json::parse(SmallRoom{.cube = false}.text());
    scene["materials"].push_back(
        {{"name", "sign"}, {"extensions", {{"KHR_materials_unlit", Json::object()}}}});
    scene["meshes"][1]["primitives"][0]["material"] = 2;
    scene["extensionsUsed"] = {"KHR_materials_unlit", "KHR_materials_variants"};
    scene["extensions"]["KHR_materials_variants"]["variants"] = {{{"name", "old"}}};
    scene["meshes"][0]["primitives"][0]["extensions"]["KHR_materials_variants"]["mappings"] = {
        {{"material", 1}, {"variants", {0}}}};
    place.write("room.gltf", scene.dump());
    REQUIRE(place.hemilux("bake room.gltf -o lit.glb" + std::string(fast)).code == 0);
    const Json json = glb_from(place.read("lit.glb")).json;
    CHECK(json["extensions"]["KHR_materials_variants"]["variants"] ==
          Json::array({{{"name", "old"}}, {{"name", "lit"}}, {{"name", "lightmap"}}}));
    CHECK(json["meshes"][0]["primitives"][0]["extensions"]["KHR_materials_variants"]["mappings"]
              .size() == 3);
    CHECK(json["meshes"][1] == scene["meshes"][1]);
    CHECK(json["materials"][2] == scene["materials"][2]);
    CHECK(json["extensionsUsed"].size() == 3);
}

TEST_CASE("what a baked file shows has the alpha and the texels of its textures") {
    const Workplace place;
    Json scene = Json::parse(SmallRoom{.cube = false}.text());
    // Columns that are open and covered in turn, 64 of them on the floor.
    constexpr int side = 64;
    std::vector<std::uint8_t> bytes;
    for (int k = 0; k < side * side; ++k)
        for (const int byte : {200, 100, 50, k % 2 == 0 ? 0 : 255})
            bytes.push_back(static_cast<std::uint8_t>(byte));
    place.write("net.png", hemilux::png_of(side, side, bytes, 4));
    add_texture(scene, 0, "net.png");
    scene["materials"][0]["alphaMode"] = "MASK";
    scene["materials"][0]["alphaCutoff"] = .25;
    place.write("room.gltf", scene.dump());
    REQUIRE(place
                .hemilux("bake room.gltf -o lit.glb -q --error 10% --max-rays 200000 --gather 4 "
                         "--lightmap 32")
                .code == 0);
    const Glb file = glb_from(place.read("lit.glb"));
    const auto [lit, own] = shown_by(file.json, 0);
    CHECK(lit["alphaMode"] == "MASK");
    CHECK(lit["alphaCutoff"] == .25);
    const hemilux::Texture shown = hemilux::decode_texture(
        picture_of(file, lit["pbrMetallicRoughness"]["baseColorTexture"]["index"]), "picture");
    // The floor is 14.4 texels wide in the lightmap: five times as many hold the texture's columns.
    REQUIRE(shown.width() == 5 * 32);
    int open = 0, covered = 0;
    for (int x = 2; x < 70; ++x) {
        const double cover = shown.cover_at({(x + .5) / (5 * 32), 30.5 / (5 * 32)}, {});
        open += cover == 0;
        covered += cover == 1;
    }
    CHECK(open > 25);
    CHECK(covered > 25);
    CHECK(open + covered == 68);
    const hemilux::Vec3 colour = shown.texel_at({40.5 / 160, 30.5 / 160}, {});
    CHECK(colour.x > 1.5 * colour.y);
    CHECK(colour.y > 1.5 * colour.z);
}

TEST_CASE("the size of a lightmap follows the faces and their area, unless it is given") {
    const Workplace place;
    const auto size = [&](const Json& scene, const std::string& more) {
        place.write("room.gltf", scene.dump());
        const auto run = place.hemilux("bake room.gltf -o lit.glb -v --error 20% --gather 1 "
                                       "--max-rays 100000 --lightmap-uv new " +
                                       more);
        CAPTURE(run.err);
        REQUIRE(run.code == 0);
        const std::size_t at = run.err.find("in a lightmap of ");
        REQUIRE(at != std::string::npos);
        return std::stoi(run.err.substr(at + 17));
    };
    Json scene = Json::parse(SmallRoom{}.text());
    CHECK(size(scene, "") == 192);
    CHECK(size(scene, "--lightmap 40") == 40);
    scene["nodes"][0]["scale"] = {2, 2, 2}; // texels of 5 cm
    scene["nodes"][3]["scale"] = {2, 2, 2};
    CHECK(size(scene, "") == 192);
    scene["nodes"][0]["scale"] = {1000, 1000, 1000};
    CHECK(size(scene, "") == 384);
    scene["nodes"][0]["scale"] = scene["nodes"][3]["scale"] = {1e-3, 1e-3, 1e-3};
    CHECK(size(scene, "") == 192);
}
