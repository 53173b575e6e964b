// The kinds of light that bake writes beside irradiance: ambient occlusion, and what gathers around
// the normals of the file.
#include "app/check_fails.h"
#include "app/running/small_room.h"
#include "support/catch.h"

#include <algorithm>
#include <string>

using Catch::Contains;
using test::check_fails;
using test::fast;
using test::Glb;
using test::glb_from;
using test::Json;
using test::SmallRoom;
using test::Workplace;

TEST_CASE("bake --bake ao needs no light, and binds it as occlusionTexture") {
    const Workplace place;
    place.write("room.gltf", SmallRoom{}.text());
    const auto run = place.hemilux("bake room.gltf --bake ao -o ao.glb --emission '*=0' "
                                   "--lightmap 64 --stats run.json");
    CAPTURE(run.err);
    REQUIRE(run.code == 0);
    CHECK_THAT(run.err, Contains("ambient occlusion: ") && Contains("of the whole hemisphere") &&
                            Contains("the object with the largest error: "));
    CHECK_THAT(run.err, !Contains("energy"));
    const Json json = glb_from(place.read("ao.glb")).json;
    for (const Json& material : json["materials"]) {
        CHECK(material["occlusionTexture"]["index"] == 0);
        CHECK(material["occlusionTexture"]["texCoord"] == 2);
        CHECK_FALSE(material.contains("extensions"));
    }
    CHECK(json["extensionsUsed"] == Json::array({"X_unknown"}));
    CHECK(json["textures"][0]["extras"]["hemilux"]["bake"] == "ao");
    CHECK(json["textures"][0]["extras"]["hemilux"]["intensity"] == 1.0);
    CHECK(place.has("ao.lightmap.exr"));
    const Json statistics = Json::parse(place.read("run.json"));
    REQUIRE(statistics["objects"].size() == 3);
    for (const Json& object : statistics["objects"]) {
        CHECK(object["error_bound"].get<double>() <= .01);
        CHECK(object["texels"].get<int>() > 0);
    }
    CHECK(statistics["estimated_error_of"] == "gathered");
    CHECK_THAT(run.err, !Contains("replaced"));
    const auto again = place.hemilux("bake ao.glb --bake ao -o again.glb --lightmap 64");
    CHECK(again.code == 0);
    CHECK_THAT(again.err, Contains("an occlusionTexture") && Contains("replaced"));
    for (const std::string threads : {"1", "3"})
        REQUIRE(place
                    .hemilux("bake room.gltf --bake ao -q --lightmap 64 -o ao" + threads +
                             ".glb -t " + threads)
                    .code == 0);
    CHECK(place.read("ao1.glb") == place.read("ao3.glb"));
    CHECK(place.read("ao1.lightmap.exr") == place.read("ao3.lightmap.exr"));
}

TEST_CASE("what contradicts --bake ao is refused, and what it does not use is reported") {
    const Workplace place;
    place.write("room.gltf", SmallRoom{}.text());
    check_fails(place, 1, "bake room.gltf -o lit.glb --bake ao --bind lightmap", "is no light");
    check_fails(place, 1, "bake room.gltf -o lit.glb --bake ao --bind unlit", "is no light");
    check_fails(place, 1, "bake room.gltf -o lit.glb --bake indirect --bind occlusion",
                "--bind occlusion is for --bake ao");
    check_fails(place, 1, "bake room.gltf -o lit.glb --ao-distance 1", "is for --bake ao");
    check_fails(place, 1, "bake room.gltf -o lit.glb --bake ao --ao-distance 0", "--ao-distance");
    check_fails(place, 1, "bake room.gltf -o room.gltf --bake ao", "ends with .glb");
    check_fails(place, 3, "bake room.gltf -o ao.glb --bake ao --lightmap 8192 --memory 1G",
                "--memory");
    CHECK_FALSE(place.has("lit.glb"));
    CHECK_FALSE(place.has("ao.glb"));
    CHECK_THAT(place
                   .hemilux("bake room.gltf -o ao.glb --bind occlusion --gather 4 --lightmap 32 "
                            "--ao-distance 0.5")
                   .err,
               Contains("--gather changes nothing in this run"));
    CHECK(place.has("ao.glb"));
}

TEST_CASE("--normals smooth changes texels of objects with normals alone") {
    const Workplace place;
    Json scene = Json::parse(SmallRoom{.cube = false}.text());
    place.write("flat.gltf", scene.dump());
    const auto without =
        place.hemilux("bake flat.gltf -o flat.glb --normals smooth --error 10% --max-rays 200000 "
                      "--gather 4 --lightmap 64");
    CHECK(without.code == 0);
    CHECK_THAT(without.err, Contains("no face has normals"));
    REQUIRE(place.hemilux("bake flat.gltf -o facet.glb" + std::string(fast)).code == 0);
    const auto picture = [&](const std::string& name) {
        const Glb glb = glb_from(place.read(name));
        const Json& view =
            glb.json["bufferViews"][glb.json["images"][0]["bufferView"].get<std::size_t>()];
        return glb.binary.substr(view["byteOffset"], view["byteLength"]);
    };
    CHECK(picture("flat.glb") == picture("facet.glb"));

    // The places of the lamp as normals of the floor: they are up to 20 degrees off its own.
    scene["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = 1;
    place.write("bent.gltf", scene.dump());
    const auto bent =
        place.hemilux("bake bent.gltf -o bent.glb --normals smooth" + std::string(fast));
    CAPTURE(bent.err);
    REQUIRE(bent.code == 0);
    REQUIRE(place.hemilux("bake bent.gltf -o same.glb" + std::string(fast)).code == 0);
    CHECK(picture("same.glb") == picture("facet.glb"));
    CHECK(picture("bent.glb") != picture("facet.glb"));
}
