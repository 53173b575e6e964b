#pragma once
// A glTF scene to be baked, and what a .glb file holds.

#include "io/gltf/gltf_text.h"
#include "support/catch.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace test {

using Json = nlohmann::json;
using hemilux::test::bytes_of;
using hemilux::test::gltf_text;

/// The scene: a floor of 2 x 2 m below a lamp, and a cube on the floor whose eight vertices its
/// faces share. `second` are the places of the floor and the lamp in TEXCOORD_1.
struct SmallRoom {
    std::vector<float> second{0, 0, .45f, 0, .45f, .45f, 0, .45f};
    bool cube = true, cube_twice = false;

    [[nodiscard]] std::string text() const {
        const std::vector<float> floor{-1, 0, 1, 1, 0, 1, 1, 0, -1, -1, 0, -1},
            lamp{-.5f, 2, -.5f, .5f, 2, -.5f, .5f, 2, .5f, -.5f, 2, .5f},
            first{0, 0, 1, 0, 1, 1, 0, 1}, of_lamp{.5f, .5f, 1, .5f, 1, 1, .5f, 1};
        std::vector<float> corners;
        for (int k = 0; k < 8; ++k)
            for (const float x : {k & 1 ? .2f : -.2f, k & 2 ? .4f : 0.f, k & 4 ? .2f : -.2f})
                corners.push_back(x);
        const std::vector<std::uint16_t> quad{0, 1, 2, 0, 2, 3},
            sides{0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                  2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};
        const auto accessor = [](int view, const char* type, std::size_t count, int component) {
            return R"({"bufferView":)" + std::to_string(view) + R"(,"componentType":)" +
                   std::to_string(component) + R"(,"count":)" + std::to_string(count) +
                   R"(,"type":")" + type + R"("})";
        };
        const std::string accessors =
            accessor(0, "VEC3", 4, 5126) + "," + accessor(1, "VEC3", 4, 5126) + "," +
            accessor(2, "VEC2", 4, 5126) + "," + accessor(3, "VEC2", 4, 5126) + "," +
            accessor(4, "VEC2", 4, 5126) + "," + accessor(5, "SCALAR", 6, 5123) + "," +
            accessor(6, "VEC3", 8, 5126) + "," + accessor(7, "SCALAR", 36, 5123);
        const std::string cubes =
            std::string(cube ? R"(,{"name":"cube","mesh":2,"extras":{"kept":[1,2.5,"x"]}})" : "") +
            (cube_twice ? R"(,{"name":"other cube","mesh":2,"translation":[0.6,0,0.6]})" : "");
        const std::string members =
            R"("accessors":[)" + accessors + R"(],"scene":0,"scenes":[{"nodes":[0)" +
            (cube ? std::string(",3") + (cube_twice ? ",4" : "") : "") + R"(]}],"nodes":[)" +
            R"({"name":"all","children":[1,2],"extensions":{"X_unknown":{"a":1}}},)" +
            R"({"name":"floor","mesh":0},{"name":"lamp","mesh":1})" + cubes +
            R"(],"meshes":[{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":2,)" +
            R"("TEXCOORD_1":3},"indices":5,"material":0}]},)" +
            R"({"primitives":[{"attributes":{"POSITION":1,"TEXCOORD_0":2,"TEXCOORD_1":4},)" +
            R"("indices":5,"material":1}]},)" +
            R"({"name":"c","primitives":[{"attributes":{"POSITION":6},"indices":7}]}],)" +
            R"("materials":[{"name":"paint","pbrMetallicRoughness":{"baseColorFactor":)" +
            R"([0.5,0.5,0.5,1],"metallicFactor":0}},{"name":"light","emissiveFactor":[1,1,1],)" +
            R"("pbrMetallicRoughness":{"baseColorFactor":[0,0,0,1],"metallicFactor":0}}],)" +
            R"("extensionsUsed":["X_unknown"],"extras":{"by":"hand"})";
        return gltf_text({bytes_of(floor), bytes_of(lamp), bytes_of(first), bytes_of(second),
                          bytes_of(of_lamp), bytes_of(quad), bytes_of(corners), bytes_of(sides)},
                         members);
    }
};

struct Glb {
    Json json;
    std::string binary;
};

inline Glb glb_from(const std::string& bytes) {
    const auto word = [&](std::size_t at) {
        std::uint32_t value = 0;
        std::memcpy(&value, bytes.data() + at, sizeof value);
        return std::size_t{value};
    };
    REQUIRE(bytes.size() > 28);
    REQUIRE(word(8) == bytes.size());
    const std::size_t json = word(12);
    REQUIRE(json % 4 == 0);
    return {Json::parse(bytes.substr(20, json)), bytes.substr(28 + json, word(20 + json))};
}

inline std::vector<float> floats_of(const Glb& file, std::size_t accessor) {
    const Json& of = file.json["accessors"][accessor];
    const Json& view = file.json["bufferViews"][of["bufferView"].get<std::size_t>()];
    const std::size_t components = of["type"] == "VEC2" ? 2 : 3;
    std::vector<float> floats(of["count"].get<std::size_t>() * components);
    std::memcpy(floats.data(),
                file.binary.data() + view.value("byteOffset", 0) + of.value("byteOffset", 0),
                floats.size() * sizeof(float));
    return floats;
}

/// Options of a quick run.
inline constexpr const char* fast = " -q --error 10% --max-rays 200000 --gather 4 --lightmap 64 ";

} // namespace test
