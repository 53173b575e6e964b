// hemilux bake: the scene's own file comes back with its light, and nothing of it is lost.
#include "app/check_fails.h"
#include "app/running/small_room.h"
#include "support/catch.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

using Catch::Contains;
using test::check_fails;
using test::fast;
using test::floats_of;
using test::Glb;
using test::glb_from;
using test::Json;
using test::SmallRoom;
using test::Workplace;

namespace {

/// Everything that `before` has is in `after`, with the same value, but for what lies at these
/// paths.
void check_additions(const Json& before, const Json& after, const std::string& path,
                     const std::vector<std::string>& changed) {
    CAPTURE(path);
    if (std::find(changed.begin(), changed.end(), path) != changed.end())
        return;
    REQUIRE(before.type() == after.type());
    if (before.is_structured()) {
        for (const auto& [key, value] : before.items()) {
            const bool is_object = before.is_object();
            const std::string inner = path + "/" + key;
            if (std::find(changed.begin(), changed.end(), inner) != changed.end())
                continue;
            CAPTURE(inner);
            REQUIRE((is_object ? after.contains(key) : std::stoul(key) < after.size()));
            check_additions(value, is_object ? after[key] : after[std::stoul(key)], inner, changed);
        }
    } else {
        CHECK(before == after);
    }
}

} // namespace

TEST_CASE("bake adds a lightmap in the second coordinates of the file, and changes nothing else") {
    const Workplace place;
    const SmallRoom room{.cube = false};
    place.write("room.gltf", room.text());
    REQUIRE(place.hemilux("bake room.gltf -o lit.glb --bind lightmap" + std::string(fast)).code ==
            0);
    const Json before = Json::parse(room.text());
    const Glb after = glb_from(place.read("lit.glb"));
    check_additions(before, after.json, "", {"/buffers/0"});
    CHECK(after.json["accessors"] == before["accessors"]);
    CHECK(after.json["nodes"] == before["nodes"]);
    CHECK(after.json["meshes"] == before["meshes"]);
    CHECK(after.json["buffers"] == Json::array({{{"byteLength", after.binary.size()}}}));
    REQUIRE(after.json["textures"].size() == 1);
    CHECK(after.json["images"][0]["mimeType"] == "image/png");
    for (const Json& material : after.json["materials"]) {
        const Json& lightmap = material["extensions"]["MOZ_lightmap"];
        CHECK(lightmap["index"] == 0);
        CHECK(lightmap["texCoord"] == 1);
        CHECK(lightmap["intensity"].get<double>() > 0);
    }
    CHECK(after.json["extensionsUsed"] == Json::array({"X_unknown", "MOZ_lightmap"}));
    CHECK(place.has("lit.lightmap.exr"));
    // It is a scene as before.
    CHECK(place.hemilux("info lit.glb").code == 0);
    CHECK(place.hemilux("info lit.glb").err.find("MOZ_lightmap") == std::string::npos);
}

TEST_CASE("bake makes an atlas where the file has no coordinates for a lightmap") {
    const Workplace place;
    SmallRoom room;
    room.cube_twice = true;
    place.write("room.gltf", room.text());
    const auto outcome =
        place.hemilux("bake room.gltf -o lit.glb --bind lightmap --error 10% --max-rays 200000 "
                      "--gather 4 --lightmap 64");
    REQUIRE(outcome.code == 0);
    CHECK_THAT(outcome.err, Catch::Contains("no place in it: cube, other cube"));
    const Json before = Json::parse(room.text());
    const Glb after = glb_from(place.read("lit.glb"));
    // The cubes have one mesh each, and their vertices are divided where charts meet.
    check_additions(before, after.json, "",
                    {"/buffers/0", "/nodes/4/mesh", "/meshes/2/primitives/0/attributes/POSITION",
                     "/meshes/2/primitives/0/indices"});
    REQUIRE(after.json["meshes"].size() == 4);
    CHECK(after.json["nodes"][4]["mesh"] == 3);
    CHECK(after.json["meshes"][3]["name"] == "c");
    const std::vector<float> shared = floats_of(glb_from(place.read("lit.glb")), 6);
    std::vector<std::vector<float>> places;
    for (const std::size_t mesh : {2u, 3u}) {
        const Json& attributes = after.json["meshes"][mesh]["primitives"][0]["attributes"];
        REQUIRE(attributes.contains("TEXCOORD_2"));
        CHECK(attributes.contains("TEXCOORD_0")); // without which there is no third set
        const std::vector<float> positions =
            floats_of(after, attributes["POSITION"].get<std::size_t>());
        CHECK(positions.size() == 3 * 24);
        CHECK(std::equal(shared.begin(), shared.end(), positions.begin()));
        places.push_back(floats_of(after, attributes["TEXCOORD_2"].get<std::size_t>()));
        CHECK(places.back().size() == 2 * 24);
        for (const float place_of : places.back())
            CHECK((place_of > 0 && place_of < 1));
    }
    CHECK(places[0] != places[1]);
    CHECK(place.hemilux("info lit.glb").code == 0);
}

TEST_CASE("bake names overlaps and places beyond the square by object") {
    const Workplace place;
    SmallRoom room{.second = {.4f, .4f, 1, .4f, 1, 1, .4f, 1}, .cube = false};
    place.write("over.gltf", room.text());
    check_fails(place, 2, "bake over.gltf -o lit.glb --lightmap-uv 1",
                "it has overlaps: floor with lamp");
    room.second = {0, 0, 2, 0, 2, 2, 0, 2};
    place.write("beyond.gltf", room.text());
    check_fails(place, 2, "bake beyond.gltf -o lit.glb --lightmap-uv 1",
                "these objects reach beyond [0,1]: floor");
    check_fails(place, 2, "bake beyond.gltf -o lit.glb --lightmap-uv 7",
                "these objects have no place in it: floor, lamp");
    check_fails(place, 1, "bake beyond.gltf -o lit.glb --bake radiosity --bind lightmap",
                "--bind unlit");
    check_fails(place, 1, "bake beyond.gltf -o lit.glb --bake indirect --bind lit",
                "--bake irradiance");
    check_fails(place, 1, "bake over.gltf -o lit.png", "a file name that ends with .glb");
    place.write("self.glb", "");
    check_fails(place, 1, "bake self.glb -o self.glb", "are one file");
    CHECK_FALSE(place.has("lit.glb"));
}

TEST_CASE("a baked file can be shown by any viewer, and is the same for any number of threads") {
    const Workplace place;
    place.write("room.gltf", SmallRoom{.cube = false}.text());
    for (const std::string threads : {"1", "3"})
        REQUIRE(place
                    .hemilux("bake room.gltf --bind unlit -o lit" + threads + ".glb -t " + threads +
                             fast)
                    .code == 0);
    CHECK(place.read("lit1.glb") == place.read("lit3.glb"));
    CHECK(place.read("lit1.lightmap.exr") == place.read("lit3.lightmap.exr"));
    const Json json = glb_from(place.read("lit1.glb")).json;
    for (const Json& material : json["materials"]) {
        CHECK(material["extensions"].contains("KHR_materials_unlit"));
        CHECK(material["pbrMetallicRoughness"]["baseColorTexture"]["texCoord"] == 1);
        CHECK_FALSE(material.contains("emissiveFactor"));
    }
    CHECK(json["textures"][0]["extras"]["hemilux"]["bake"] == "radiosity");
}

TEST_CASE("bake takes whole numbers that are written as fractions, and keeps what it cannot read") {
    const Workplace place;
    Json scene = Json::parse(SmallRoom{}.text());
    Json& views = scene["bufferViews"];
    REQUIRE(scene["buffers"].size() == 1);
    // A second buffer that holds all, named by 1.0.
    scene["buffers"].push_back(scene["buffers"][0]);
    scene["buffers"][0] = {{"byteLength", 4}, {"uri", "data:;base64,AAAAAA=="}};
    for (Json& view : views)
        view["buffer"] = 1.0;
    views[0]["extensions"]["X_odd"] = {{"buffer", "none"}, {"byteOffset", Json::array()}};
    views[1]["extensions"] = "odd";
    scene["images"] = {{{"uri", "http://example.org/a.png"}}, {{"uri", "none.png"}}};
    for (Json& mesh : scene["meshes"])
        for (Json& primitive : mesh["primitives"])
            for (Json& accessor : primitive["attributes"])
                accessor = accessor.get<double>();
    place.write("room.gltf", scene.dump());
    const auto run = place.hemilux(std::string("bake room.gltf -o lit.glb") + fast);
    CAPTURE(run.err);
    REQUIRE(run.code == 0);
    const Glb lit = glb_from(place.read("lit.glb"));
    for (const Json& view : lit.json["bufferViews"])
        CHECK(view["buffer"] == 0);
    CHECK(lit.json["images"][0]["uri"] == "http://example.org/a.png");
    CHECK(lit.json["images"][1]["uri"] == "none.png");
    CHECK(lit.json["bufferViews"][0]["extensions"]["X_odd"]["buffer"] == "none");
    CHECK(floats_of(lit, 0) == std::vector<float>{-1, 0, 1, 1, 0, 1, 1, 0, -1, -1, 0, -1});
}

TEST_CASE("bake embeds no picture from outside the file's folder in silence") {
    const Workplace place;
    std::filesystem::create_directory(place.path("inner"));
    place.write("secret.png", "no picture that is looked at");
    Json scene = Json::parse(SmallRoom{}.text());
    scene["images"] = {{{"uri", "../secret.png"}}};
    place.write("inner/room.gltf", scene.dump());
    const auto refused =
        place.hemilux(std::string("bake inner/room.gltf -o lit.glb --no-outside-files") + fast);
    CHECK(refused.code == 2);
    CHECK_THAT(refused.err, Contains("/images/0/uri") && Contains("--no-outside-files refuses it"));
    CHECK_FALSE(place.has("lit.glb"));
    const auto warned = place.hemilux("bake inner/room.gltf -o lit.glb --error 10% --max-rays "
                                      "200000 --gather 4 --lightmap 64");
    CHECK(warned.code == 0);
    CHECK_THAT(warned.err, Contains("lies outside the scene's folder"));
}

TEST_CASE("bake keeps instances that are so far away that their triangles have no area") {
    const Workplace place;
    std::filesystem::copy(HEMILUX_SOURCE_DIR "/tests/fuzz/corpus/lit_file/far_instance.gltf",
                          place.path("far.gltf"));
    const auto run =
        place.hemilux(std::string("bake far.gltf -o lit.glb --emission '*=1,1,1'") + fast);
    CAPTURE(run.err);
    REQUIRE(run.code == 0);
    const Glb lit = glb_from(place.read("lit.glb"));
    const Json& nodes = lit.json["nodes"];
    REQUIRE(nodes[0]["children"] == Json::array({1, 2}));
    CHECK_FALSE(nodes[0].contains("extensions"));
    CHECK(nodes[2].contains("mesh"));
    CHECK(nodes[1]["matrix"][12] == 0.0);
    CHECK(nodes[2]["matrix"][12].get<double>() > 1e17);
    CHECK_THAT(place.hemilux("info lit.glb").err, Contains("2 triangles without area"));
}

TEST_CASE("a file that solve has lit is read as what it shows") {
    const Workplace place;
    place.write_room();
    REQUIRE(place.hemilux("solve room.obj -q --steps 4 --divide none -o lit.glb").code == 0);
    const auto again = place.hemilux("solve lit.glb --steps 2 --divide none -o again.csv");
    CAPTURE(again.err);
    REQUIRE(again.code == 0);
    CHECK_THAT(again.err,
               Contains("material 'light' is unlit") && Contains("nothing is reflected"));
    // The column of the reflectance of red is zero, and that of its emission is its radiosity.
    std::istringstream rows(place.read("again.csv"));
    std::string row;
    std::getline(rows, row);
    double most = 0;
    std::size_t count = 0;
    while (std::getline(rows, row)) {
        std::vector<std::string> cells;
        std::istringstream line(row);
        for (std::string cell; std::getline(line, cell, ',');)
            cells.push_back(cell);
        REQUIRE(cells.size() > 16);
        CHECK(std::stod(cells[11]) == 0);
        CHECK(cells[14] == cells[17]);
        most = std::max(most, std::stod(cells[14]));
        ++count;
    }
    CHECK(count > 24);
    CHECK(most > .1);
    CHECK(most <= std::numbers::pi * 1.0001); // as glTF limits colours to 1
}
