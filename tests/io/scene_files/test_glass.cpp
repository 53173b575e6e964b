// Panes of the faces of glass, with a warning of what they are not.
#include "io/scene_files/glass.h"

#include "io/scene_files/obj.h"
#include "radiosity/engine/rays/panes.h"
#include "radiosity/light/textures/scene_textures.h"
#include "support/catch.h"
#include "support/temporary_folder.h"

#include <string>

using namespace hemilux;
using Catch::Contains;
using test::TemporaryFolder;

namespace {

/// A square of glass, then one of wall, with texture coordinates.
ReadResult read_squares(const TemporaryFolder& folder, const std::string& glass) {
    (void)folder.write("s.mtl", "newmtl wall\nKd .5 .5 .5\nmap_Kd t.tga\nnewmtl glass\n" + glass);
    // One white texel: an uncompressed TGA picture of 24 bits.
    (void)folder.write("t.tga",
                       std::string("\0\0\2\0\0\0\0\0\0\0\0\0\1\0\1\0\x18\0\xff\xff\xff", 21));
    return read_obj(folder.write("s.obj", "mtllib s.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
                                          "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nusemtl glass\n"
                                          "f 1 2 3 4\nusemtl wall\nf 4/1 3/2 2/3 1/4\n"));
}

std::string all(const std::vector<std::string>& warnings) {
    std::string text;
    for (const std::string& warning : warnings)
        text += warning + "\n";
    return text;
}

} // namespace

TEST_CASE("glass is opaque, with a warning, until it is opened", "[glass]") {
    const TemporaryFolder folder;
    ReadResult read = read_squares(folder, "Kd 0 0 0\nd .3\n");
    CHECK_THAT(all(read.warnings),
               Contains("s.mtl:4: a material lets light through; it is opaque "
                        "here; solve and bake open it by --glass open (\"glass\": d .3)"));
    REQUIRE(read.scene.facets.size() == 2);
    REQUIRE(read.glass.size() == 1);
    CHECK_FALSE(read.glass[0].open);

    open_glass(read);
    CHECK(read.warnings.empty());
    CHECK(read.glass[0].open);
    REQUIRE(read.scene.facets.size() == 1);
    CHECK(read.scene.facets[0].face == 1);
    CHECK(read.scene.faces == 2);
    REQUIRE(panes_of(read.scene).size() == 1);
    CHECK(panes_of(read.scene)[0].transmittance == Approx(.7));
    CHECK(panes_of(read.scene)[0].corner[2] == Vec3(1, 1, 0));
    // What belongs to facets follows them.
    const auto& texcoords = textures_of(read.scene).texcoords;
    REQUIRE(texcoords.size() == 1);
    REQUIRE(texcoords[0].size() == 1);
    CHECK(texcoords[0][0][1] == glm::vec2(1, 0));
}

TEST_CASE("panes that are not all that the file says are warned of", "[glass]") {
    const TemporaryFolder folder;
    const auto opened = [&](const std::string& glass) {
        ReadResult read = read_squares(folder, glass);
        open_glass(read);
        return read;
    };
    const ReadResult coloured = opened("Kd 0 0 0\nTf .3 .6 .9\nillum 6\n");
    CHECK_THAT(all(coloured.warnings),
               Contains("a glass is coloured; the mean of its channels comes through here "
                        "(\"glass\": 0.3 0.6 0.9)"));
    CHECK(panes_of(coloured.scene)[0].transmittance == Approx(.6));
    CHECK_THAT(all(opened("Kd .8 .8 .8\nd .3\n").warnings),
               Contains("a glass reflects nothing here; it absorbs what does not come through "
                        "(\"glass\": reflectance 0.8 0.8 0.8)"));
    const ReadResult lamp = opened("Kd 0 0 0\nKe 1 1 1\nd .3\n");
    CHECK_THAT(all(lamp.warnings), Contains("a material emits and lets light through; it is opaque "
                                            "here (\"glass\": d .3)"));
    CHECK(panes_of(lamp.scene).empty());
    CHECK(lamp.scene.facets.size() == 2);
    const ReadResult leaf = opened("d .3\nmap_d leaf.png\n");
    CHECK_THAT(all(leaf.warnings), Contains("a material has holes by a texture; it is whole here"));
    CHECK(leaf.scene.facets.size() == 2);
}
