// glTF files that are wrong: one message each, with the JSON path of what is wrong, in bounded
// time.

#include "io/files/error.h"
#include "io/gltf/gltf.h"
#include "io/gltf/gltf_text.h"
#include "support/catch.h"
#include "support/temporary_folder.h"

using namespace hemilux;
using namespace hemilux::test;

namespace {

/// The message without the folder; empty where nothing was thrown.
std::string error_of(const std::string& content, const std::string& name = "s.gltf") {
    const TemporaryFolder folder;
    const std::string path = folder.write(name, content);
    try {
        (void)read_gltf(path);
    } catch (const InputError& error) {
        return std::string(error.what()).substr(path.size() - name.size());
    }
    return {};
}

/// A file that is right.
std::string right() {
    const std::vector<float> square{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
    const std::vector<std::uint16_t> indices{0, 1, 2, 0, 2, 3};
    return gltf_text(
        {bytes_of(square), bytes_of(indices)},
        R"("accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"},)"
        R"({"bufferView":1,"componentType":5123,"count":6,"type":"SCALAR"}],)"
        R"("materials":[{"emissiveFactor":[1,1,1]}],)"
        R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1,"material":0}]}],)"
        R"("nodes":[{"mesh":0},{"children":[2]},{"name":"empty"}],"scenes":[{"nodes":[0,1]}])");
}

/// That file with one text replaced by another.
std::string with(const std::string& old_text, const std::string& new_text) {
    std::string text = right();
    const std::size_t at = text.find(old_text);
    REQUIRE(at != std::string::npos);
    return text.replace(at, old_text.size(), new_text);
}

} // namespace

TEST_CASE("each error names its place in the JSON", "[gltf]") {
    CHECK(error_of(right()).empty());
    struct Wrong {
        std::string before, after, message;
    };
    const std::vector<Wrong> all{
        {R"("2.0")", R"("1.0")", "/asset/version: expected version 2.0"},
        {R"("count":4)", R"("count":40)",
         "/accessors/0/count: expected at most 4, as bufferView 0 has 48 bytes, found 40"},
        {R"("count":4)", R"("count":-1)", "/accessors/0/count: expected a whole number"},
        {R"("count":4)", R"("count":9007199254740992)", "/accessors/0/count: expected at most 4"},
        {R"("count":4)", R"("count":1e300)", "/accessors/0/count: expected a whole number"},
        {R"("count":4)", R"("count":2.5)", "/accessors/0/count: expected a whole number"},
        {R"("count":4)", R"("counts":4)", "/accessors/0: expected a member \"count\""},
        {R"("bufferView":0,)", R"("bufferView":2,)",
         "/accessors/0/bufferView: expected a whole number from 0 to 1, found 2"},
        {R"("bufferView":0,)", R"("bufferView":0,"byteOffset":44,)",
         "/accessors/0/byteOffset: expected a whole number from 0 to 36, found 44"},
        {R"("bufferView":0,"componentType":5126,"count":4)",
         R"("componentType":5126,"count":4000000000)",
         "/accessors/0/count: expected at most 1048576"},
        {"5126", "5124", "/accessors/0/componentType: expected 5120"},
        {R"("VEC3")", R"("VEC5")", "/accessors/0/type: expected SCALAR"},
        {R"("VEC3")", R"("VEC2")", "/accessors/0: expected the type VEC3, found VEC2"},
        {R"("byteLength":12})", R"("byteLength":1200})", "/bufferViews/1/byteLength: expected"},
        {R"("byteLength":12})", R"("byteLength":12,"byteStride":1})",
         "/bufferViews/1/byteStride: expected a whole number from 4 to 252, found 1"},
        {R"("byteLength":60)", R"("byteLength":64)",
         "/buffers/0/byteLength: expected at most 60, the bytes there are, found 64"},
        {"base64,", "base64,!", "/buffers/0/uri: expected data in base 64"},
        {"data:application", "http://x.org/", "/buffers/0/uri: expected a data URI or a path"},
        {R"("POSITION":0)", R"("POSITION":1)", "/accessors/1: expected the type VEC3"},
        {R"("indices":1)", R"("indices":0)",
         "/meshes/0/primitives/0: expected a multiple of 3 corners, found 4"},
        {R"("count":6)", R"("count":5)",
         "/meshes/0/primitives/0: expected a multiple of 3 corners, found 5"},
        {R"("indices":1)", R"("indices":1,"mode":7)", "/meshes/0/primitives/0/mode: expected"},
        {R"("material":0)", R"("material":1)", "/meshes/0/primitives/0/material: expected"},
        {R"("mesh":0)", R"("mesh":1)", "/nodes/0/mesh: expected a whole number from 0 to 0"},
        {R"("mesh":0)", R"("mesh":0,"matrix":[1,2])", "/nodes/0/matrix: expected an array of 16"},
        {R"("mesh":0)", R"("mesh":0,"rotation":[0,0,0,0])", "/nodes/0/rotation: expected"},
        {R"("mesh":0)", R"("mesh":0,"scale":[1e100,1e100,1e100],"translation":[1e100,0,0])",
         "/nodes/0: expected a transform"},
        {R"("name":"empty")", R"("children":[1])", "/nodes/1: expected a tree of nodes"},
        {R"("name":"empty")", R"("children":[2])",
         "/nodes/2/children: expected nodes without other parents"},
        {R"("mesh":0})", R"("mesh":0,"children":[2]})",
         "/nodes/1/children: expected nodes without"},
        {R"("nodes":[0,1])", R"("nodes":[0,2])", "/scenes/0/nodes/1: expected a node without"},
        {R"("nodes":[0,1])", R"("nodes":[0,0])", "/scenes/0/nodes: expected each node once"},
        {R"("emissiveFactor":[1,1,1])", R"("emissiveFactor":[1,-1,1])",
         "/materials/0/emissiveFactor: expected numbers of at least 0"},
        {R"("materials":)", R"("extensionsRequired":["KHR_draco_mesh_compression"],"materials":)",
         "/extensionsRequired/0: the file requires the extension"},
        {R"("emissiveFactor":[1,1,1])", R"("emissiveTexture":{"index":0})",
         "/materials/0/emissiveTexture/index: expected no index, as there are no textures"},
        {R"("materials":[{)",
         R"("textures":[{"source":3}],"materials":[{"emissiveTexture":{"index":0},)",
         "/textures/0/source: expected an image"},
        {R"("materials":)", R"("materials":{},"old":)", "/materials: expected an array"},
        {R"("nodes":[0,1])", R"("nodes":[])", "no triangles"},
    };
    for (const auto& [before, after, message] : all) {
        const std::string found = error_of(with(before, after));
        CAPTURE(before, after, found);
        CHECK(found.find("s.gltf: " + message) == 0);
    }
}

TEST_CASE("texts that are no JSON are refused with their line", "[gltf]") {
    CHECK(error_of("{\n\"asset\": nothing\n}").starts_with("s.gltf:2: expected JSON"));
    CHECK(error_of("").starts_with("s.gltf:1: expected JSON"));
    CHECK(error_of("[]").starts_with("s.gltf: /: expected an object"));
    CHECK(error_of(std::string(1'000'000, '[')).starts_with("s.gltf:1: expected JSON"));
    CHECK(error_of("{\"asset\":{\"version\":\"\xff\"}}").starts_with("s.gltf:1: expected JSON"));
}

TEST_CASE("binary files whose lengths are wrong are refused", "[gltf]") {
    const std::string glb = glb_of("{}", "1234");
    const auto changed = [&](std::size_t at, char value) {
        std::string bytes = glb;
        bytes[at] = value;
        return error_of(bytes, "s.glb");
    };
    CHECK(changed(4, 1).starts_with("s.glb: byte 4: expected version 2, found 1"));
    CHECK(changed(8, 127).starts_with("s.glb: byte 8: expected a length"));
    CHECK(changed(12, 127).starts_with("s.glb: byte 12: expected a chunk of at most"));
    CHECK(changed(16, 'X').starts_with("s.glb: byte 16: expected the chunk JSON"));
    CHECK(error_of(glb.substr(0, 15), "s.glb").starts_with("s.glb: expected a binary glTF file"));
}

TEST_CASE("few bytes that ask for very many triangles are refused at once", "[gltf]") {
    std::string nodes = R"({"mesh":0})";
    for (int k = 0; k < 999; ++k)
        nodes += R"(,{"mesh":0})";
    const std::string text =
        R"({"asset":{"version":"2.0"},"accessors":[{"componentType":5126,"count":1048575,)"
        R"("type":"VEC3"}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"nodes":[)" +
        nodes + "]}";
    CHECK(error_of(text).find("expected a scene of at most 50000000 triangles") !=
          std::string::npos);
}

TEST_CASE("few bytes that ask for very many primitives of points are refused at once", "[gltf]") {
    const auto many = [](const std::string& item, int count) {
        std::string items = item;
        for (int k = 1; k < count; ++k)
            items += "," + item;
        return items;
    };
    const std::string text =
        R"({"asset":{"version":"2.0"},"accessors":[{"componentType":5126,"count":3,)"
        R"("type":"VEC3"}],"meshes":[{"primitives":[)" +
        many(R"({"attributes":{"POSITION":0},"mode":0})", 7100) + R"(]}],"nodes":[)" +
        many(R"({"mesh":0})", 7100) + "]}";
    CHECK(error_of(text).find("expected a scene of at most 50000000 triangles and primitives") !=
          std::string::npos);
}

TEST_CASE("indices and places that are wrong are refused with their element", "[gltf]") {
    std::vector<float> square{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
    const auto file = [&](const std::vector<std::uint16_t>& indices) {
        return gltf_text(
            {bytes_of(square), bytes_of(indices)},
            R"("accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"},)"
            R"({"bufferView":1,"componentType":5123,"count":3,"type":"SCALAR"}],)"
            R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],)"
            R"("nodes":[{"mesh":0}])");
    };
    CHECK(error_of(file({0, 1, 4})) ==
          "s.gltf: /accessors/1: element 2: expected an index below 4, the number of vertices, "
          "found 4");
    square[3] = std::numeric_limits<float>::infinity();
    CHECK(error_of(file({0, 1, 2})) == "s.gltf: /accessors/0: element 1: expected finite numbers");
    CHECK(error_of(file({0, 0, 0})).starts_with("s.gltf: none of the triangles has an area"));
}
