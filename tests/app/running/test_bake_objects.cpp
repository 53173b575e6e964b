// hemilux bake --per-object: each node with a mesh has a lightmap of its own.
#include "app/check_fails.h"
#include "app/gathering/objects_of_file.h"
#include "app/running/small_room.h"
#include "support/catch.h"

#include <set>
#include <string>

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

/// The texture that a material's lightmap is, by the node that shows it.
std::size_t texture_of(const Json& json, std::size_t node) {
    const Json& mesh = json["meshes"][json["nodes"][node]["mesh"].get<std::size_t>()];
    const auto material = mesh["primitives"][0]["material"].get<std::size_t>();
    return json["materials"][material]["extensions"]["MOZ_lightmap"]["index"];
}

} // namespace

TEST_CASE("each object has its lightmap, its texture and its error") {
    const Workplace place;
    SmallRoom room;
    room.cube_twice = true;
    place.write("room.gltf", room.text());
    const auto run =
        place.hemilux("bake room.gltf -o lit.glb --per-object --bind lightmap "
                      "--error 10% --max-rays 200000 --gather 4 --lightmap 64 --stats run.json");
    CAPTURE(run.err);
    REQUIRE(run.code == 0);
    const std::string names[] = {"floor", "lamp", "cube", "other_cube"};
    for (const std::string& name : names) {
        CHECK(place.has("lit." + name + ".lightmap.exr"));
        CHECK_THAT(run.err, Contains("wrote lit." + name + ".lightmap.exr"));
    }
    CHECK_FALSE(place.has("lit.lightmap.exr"));
    CHECK_THAT(run.err, Contains("have coordinates of their own, TEXCOORD_2: cube, other_cube"));
    const Json json = glb_from(place.read("lit.glb")).json;
    REQUIRE(json["textures"].size() == 4);
    CHECK(json["images"].size() == 4);
    CHECK(json["samplers"].size() == 1);
    std::set<std::size_t> textures, meshes;
    for (const std::size_t node : {1u, 2u, 3u, 4u}) {
        textures.insert(texture_of(json, node));
        meshes.insert(json["nodes"][node]["mesh"].get<std::size_t>());
    }
    CHECK(textures.size() == 4);
    CHECK(meshes.size() == 4);
    CHECK(json["textures"][texture_of(json, 4)]["name"] == "lightmap other_cube");
    // Floor and lamp keep their own coordinates, and all that the file says of them.
    CHECK(json["materials"][0]["name"] == "paint");
    CHECK(json["materials"][0]["extensions"]["MOZ_lightmap"]["texCoord"] == 1);
    CHECK(json["materials"][1]["name"] == "light");
    CHECK(json["meshes"][0]["primitives"][0]["attributes"] ==
          Json::parse(room.text())["meshes"][0]["primitives"][0]["attributes"]);
    const Json objects = Json::parse(place.read("run.json"))["objects"];
    REQUIRE(objects.size() == 4);
    for (std::size_t k = 0; k < 4; ++k) {
        CHECK(objects[k]["name"] == names[k]);
        CHECK(objects[k]["texels"].get<int>() > 0);
        CHECK(objects[k]["estimated_error"].get<double>() <=
              objects[k]["error_bound"].get<double>());
    }
    CHECK(place.hemilux("info lit.glb").code == 0);
}

TEST_CASE("objects that share a material and coordinates have each its own picture") {
    const Workplace place;
    // Floor and lamp lie over each other in their coordinates.
    SmallRoom room{.second = {.4f, .4f, 1, .4f, 1, 1, .4f, 1}, .cube = false};
    Json scene = Json::parse(room.text());
    scene["meshes"][1]["primitives"][0]["material"] = 0;
    scene["nodes"][1]["name"] = "a/b: c";
    scene["nodes"][2]["name"] = "A_B__C";
    scene["materials"][0]["emissiveFactor"] = {1, 1, 1};
    place.write("room.gltf", scene.dump());
    for (const std::string threads : {"1", "3"})
        REQUIRE(place
                    .hemilux("bake room.gltf --per-object --bind lightmap -o lit" + threads +
                             ".glb -t " + threads + fast)
                    .code == 0);
    CHECK(place.has("lit1.a_b__c.lightmap.exr"));
    CHECK(place.has("lit1.A_B__C_2.lightmap.exr"));
    CHECK(place.read("lit1.glb") == place.read("lit3.glb"));
    CHECK(place.read("lit1.a_b__c.lightmap.exr") == place.read("lit3.a_b__c.lightmap.exr"));
    const Json json = glb_from(place.read("lit1.glb")).json;
    CHECK(json["accessors"] == scene["accessors"]);
    REQUIRE(json["materials"].size() == 3);
    CHECK(json["materials"][2]["name"] == "paint");
    CHECK(texture_of(json, 1) != texture_of(json, 2));
    for (const std::size_t node : {1u, 2u})
        CHECK(json["nodes"][node]["mesh"] == node - 1);
}

TEST_CASE("lightmaps of objects overwrite no input, and are refused before anything is solved") {
    const Workplace place;
    Json scene = Json::parse(SmallRoom{.cube = false}.text());
    place.write("room.gltf", scene.dump());
    REQUIRE(place.hemilux("bake room.gltf -o whole.glb" + std::string(fast)).code == 0);
    const Glb whole = glb_from(place.read("whole.glb"));
    // The buffer of this scene has the name of a lightmap.
    scene["buffers"][0] = {{"byteLength", whole.binary.size()}, {"uri", "lit.lamp.lightmap.exr"}};
    place.write("odd.gltf", scene.dump());
    place.write("lit.lamp.lightmap.exr", whole.binary);
    check_fails(place, 1, "bake odd.gltf -o lit.glb --per-object", "are one file, named twice");
    CHECK(place.read("lit.lamp.lightmap.exr") == whole.binary);
    CHECK_FALSE(place.has("lit.glb"));
    check_fails(place, 1, "bake room.gltf -o lit.glb --per-object --stats lit.floor.lightmap.exr",
                "are one file, named twice");
    check_fails(place, 3, "bake room.gltf -o lit.glb --per-object --lightmap 2048 --memory 300M",
                "--memory");
    const auto occlusion =
        place.hemilux("bake room.gltf -o ao.glb --per-object --bake ao --lightmap 64");
    CHECK(occlusion.code == 0);
    CHECK(place.has("ao.floor.lightmap.exr"));
    CHECK(place.has("ao.lamp.lightmap.exr"));
}

TEST_CASE("names of objects become parts of names of files") {
    using hemilux::name_for_file;
    CHECK(name_for_file("Chair.001") == "Chair_001");
    CHECK(name_for_file("../../etc/passwd") == "______etc_passwd");
    CHECK(name_for_file("K\xc3\xbc"
                        "che-2") == "K\xc3\xbc"
                                    "che-2");
    CHECK(name_for_file("") == "object");
    CHECK(name_for_file(std::string("a\0b\n", 4)) == "a_b_");
    CHECK(name_for_file(std::string(100, 'x')).size() == 60);
    std::string letters(59, 'x');
    for (int k = 0; k < 9; ++k)
        letters += "\xc3\xbc";
    CHECK(name_for_file(letters) == std::string(59, 'x'));
}
