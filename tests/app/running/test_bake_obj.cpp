// hemilux bake of OBJ files: the same text with coordinates for the light, which lies beside it.
#include "app/check_fails.h"
#include "support/catch.h"

#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

using Catch::Contains;
using test::check_fails;
using test::Workplace;

namespace {

constexpr const char* fast = " --error 10% --max-rays 200000 --gather 4 --lightmap 64 ";

/// The lines of a file but for faces and texture coordinates.
std::vector<std::string> other_lines(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);)
        if (!line.starts_with("f ") && !line.starts_with("vt "))
            lines.push_back(line);
    return lines;
}

} // namespace

TEST_CASE("bake of an OBJ file adds an atlas once, and then takes it as it is") {
    const Workplace place;
    place.write_room();
    const auto first = place.hemilux(std::string("bake room.obj -o lit.obj") + fast);
    CAPTURE(first.err);
    REQUIRE(first.code == 0);
    CHECK_THAT(first.err, Contains("the lightmap has coordinates of its own, vt"));
    CHECK(place.has("lit.lightmap.exr"));
    const std::string lit = place.read("lit.obj");
    CHECK(other_lines(lit) == other_lines(place.read("room.obj")));
    CHECK_THAT(lit, Contains("\nvt 0."));
    CHECK(place.hemilux("info lit.obj").out == place.hemilux("info room.obj").out);

    const auto second = place.hemilux(std::string("bake lit.obj -o again.obj") + fast);
    CAPTURE(second.err);
    REQUIRE(second.code == 0);
    CHECK_THAT(second.err, !Contains("coordinates of its own"));
    CHECK(place.read("again.obj") == lit);

    std::filesystem::create_directory(place.path("inner"));
    CHECK_THAT(
        place.hemilux(std::string("bake lit.obj -o inner/lit.obj --bake ao --lightmap 64")).err,
        Contains("mtllib names files that lie beside it"));
    CHECK(place.read("inner/lit.obj") == lit);
}

TEST_CASE("what bake cannot do with an OBJ file is refused") {
    const Workplace place;
    place.write_room();
    check_fails(place, 1, "bake room.obj -o lit.glb", "name it -o lit.obj");
    check_fails(place, 1, "bake room.gltf -o lit.obj", "name it -o lit.glb");
    check_fails(place, 1, "bake room.obj -o room.obj", "are one file");
    check_fails(place, 1, "bake room.obj -o lit.obj --per-object", "--per-object is for glTF");
    check_fails(place, 1, "bake room.obj -o lit.obj --bind unlit", "no place for their light");
    check_fails(place, 1, "bake room.stl -o lit.obj", "bake is for glTF and OBJ files");
    check_fails(place, 2, "bake room.obj -o lit.obj --lightmap-uv 1", "one set of texture");
    check_fails(place, 2, "bake room.obj -o lit.obj --lightmap-uv 0",
                "these objects have no place in it: ");
    CHECK_FALSE(place.has("lit.obj"));
}
