// Nothing of a scene file is passed over in silence, none of its names looks like a message, and
// what it reaches outside its folder is reported or refused.
#include "io/files/error.h"
#include "io/gltf/gltf.h"
#include "io/gltf/gltf_text.h"
#include "io/scene_files/obj.h"
#include "io/scene_files/stl.h"
#include "support/catch.h"
#include "support/temporary_folder.h"

#include <cstring>
#include <filesystem>

using namespace hemilux;
using namespace hemilux::test;
using Catch::Contains;

namespace {

const std::vector<float> triangle{0, 0, 0, 1, 0, 0, 0, 1, 0};

/// The members of a model of one triangle.
std::string members(const std::string& nodes, const std::string& more = "") {
    return R"("accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],)"
           R"("materials":[{"pbrMetallicRoughness":{"metallicFactor":0},"name":"a\nhemilux: wrote b\u001b[2J\t"}],)"
           R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"material":0}]}],)"
           R"("nodes":[{"mesh":0},)" +
           nodes + "]" + more;
}

std::string error_of(const std::string& path, Outside outside = Outside::reported) {
    try {
        (void)(path.ends_with(".obj") ? read_obj(path, {}, true, outside)
                                      : read_gltf(path, {}, true, outside));
    } catch (const InputError& error) {
        return error.what();
    }
    return {};
}

std::string stl_of(std::uint32_t count, std::size_t triangles, std::size_t more) {
    std::string bytes(84, ' ');
    std::memcpy(bytes.data() + 80, &count, 4);
    for (std::size_t t = 0; t < triangles; ++t)
        bytes += std::string(12, '\0') + bytes_of(triangle) + std::string(2, '\0');
    return bytes + std::string(more, 'x');
}

} // namespace

TEST_CASE("what stands behind the triangles of an STL file is reported", "[stl]") {
    const TemporaryFolder folder;
    CHECK(read_stl(folder.write("s.stl", stl_of(2, 2, 0))).warnings.empty());
    const ReadResult read = read_stl(folder.write("s.stl", stl_of(1, 2, 7)));
    CHECK(read.scene.facets.size() == 1);
    REQUIRE(read.warnings.size() == 1);
    CHECK_THAT(read.warnings[0],
               Contains("s.stl: byte 80: the file counts 1 triangle; 57 bytes behind them, 1 "
                        "triangles more, are not read"));
}

TEST_CASE("what stands behind a binary model is reported, and a cut chunk is refused", "[gltf]") {
    const TemporaryFolder folder;
    std::string json = gltf_text({bytes_of(triangle)}, members("{}"));
    const std::string glb = glb_of(json, "");
    CHECK(read_gltf(folder.write("s.glb", glb)).warnings.empty());
    const ReadResult read = read_gltf(folder.write("s.glb", glb + "junk"));
    REQUIRE(read.warnings.size() == 1);
    CHECK_THAT(read.warnings[0], Contains("s.glb: byte 8: the file has 4 bytes behind the length"));
    std::string cut = glb + std::string(4, '\0');
    const auto length = static_cast<std::uint32_t>(cut.size());
    std::memcpy(cut.data() + 8, &length, 4);
    CHECK_THAT(error_of(folder.write("s.glb", cut)),
               Contains("expected a chunk of at least 8 bytes, found 4"));
}

TEST_CASE("names from a model are one line without control characters", "[gltf]") {
    const TemporaryFolder folder;
    const ReadResult read =
        read_gltf(folder.write("s.gltf", gltf_text({bytes_of(triangle)}, members("{}"))));
    CHECK(read.scene.materials[0].name ==
          "a\xef\xbf\xbdhemilux: wrote b\xef\xbf\xbd[2J\xef\xbf\xbd");
    const std::string error = error_of(folder.write(
        "s.gltf",
        gltf_text({bytes_of(triangle)},
                  members("{}", R"(,"images":[{"uri":"x"}],"extensionsRequired":["a\nb"])"))));
    CHECK_THAT(error, Contains("a\xef\xbf\xbd"
                               "b"));
    CHECK(InputError("a\nb", 1, "c\nd").what() == std::string("a\xef\xbf\xbd"
                                                              "b:1: c\xef\xbf\xbd"
                                                              "d"));
}

TEST_CASE("a camera that is nowhere is refused with its node, one without a direction passed over",
          "[gltf]") {
    const TemporaryFolder folder;
    const auto model = [&](const std::string& transform) {
        return folder.write(
            "s.gltf",
            gltf_text({bytes_of(triangle)},
                      members(R"({"camera":0,)" + transform + "}",
                              R"(,"cameras":[{"type":"perspective","perspective":{"yfov":1}}])")));
    };
    for (const char* const far :
         {R"("translation":[1e99,0,0])", R"("matrix":[1,0,0,0,0,1,0,0,0,0,1,0,0,0,1e99,1])",
          R"("translation":[0,0,1e17])"}) {
        CAPTURE(far);
        CHECK_THAT(error_of(model(far)), Contains("s.gltf: /nodes/1: expected a transform that "
                                                  "gives the camera a place and a direction"));
    }
    CHECK_FALSE(read_gltf(model(R"("scale":[0,0,0])")).camera);
    CHECK(read_gltf(model(R"("translation":[0,0,5])")).camera);
}

TEST_CASE("buffers and textures outside the folder are reported once, or refused", "[gltf]") {
    const TemporaryFolder folder;
    folder.write("b.bin", bytes_of(triangle));
    folder.write("in/b.bin", bytes_of(triangle));
    folder.write("t.png", "\x89PNG\r\n\x1a\n");
    std::filesystem::create_symlink("../b.bin", folder.path("in/link.bin"));
    const auto model = [&](const std::string& uri) {
        return folder.write("in/s.gltf",
                            R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":36,"uri":")" +
                                uri + R"("}],"bufferViews":[{"buffer":0,"byteLength":36}],)" +
                                members("{}") + "}");
    };
    CHECK(read_gltf(model("b.bin"), {}, true, Outside::refused).warnings.empty());
    for (const char* const uri : {"../b.bin", "link.bin", "../in/../b.bin"}) {
        CAPTURE(uri);
        const ReadResult read = read_gltf(model(uri));
        REQUIRE(read.warnings.size() == 1);
        CHECK_THAT(read.warnings[0], Contains("s.gltf: /buffers/0/uri: buffer \"") &&
                                         Contains("lies outside the scene's folder"));
        CHECK_THAT(error_of(model(uri), Outside::refused),
                   Contains("/buffers/0/uri: buffer") && Contains("--no-outside-files refuses it"));
    }
    folder.write("in/m.mtl", "newmtl a\nmap_Kd ../t.png\n");
    const std::string obj =
        folder.write("in/s.obj", "mtllib m.mtl\nusemtl a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    CHECK_THAT(error_of(obj, Outside::refused), Contains("m.mtl:1: texture \""));
    folder.write("in/s.obj", "mtllib ../m.mtl\nusemtl a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    folder.write("m.mtl", "newmtl a\n");
    CHECK_THAT(error_of(obj, Outside::refused), Contains("s.obj:1: material library \""));
}
