#include "io/scene_files/mtl.h"
#include "radiosity/light/textures/scene_textures.h"

#include "io/files/error.h"
#include "io/scene_files/material_table.h"
#include "support/catch.h"
#include "support/temporary_folder.h"

#include <string>

using namespace hemilux;
using hemilux::test::TemporaryFolder;

namespace {

std::vector<MtlMaterial> read(const std::string& content) {
    const TemporaryFolder folder;
    return read_mtl(folder.write("m.mtl", content)).materials;
}

} // namespace

TEST_CASE("reflectance and emission are read, all else is passed over", "[mtl]") {
    const std::vector<MtlMaterial> materials = read("\xef\xbb\xbf# library\r\n"
                                                    "Kd of no material\r\n"
                                                    "newmtl short box # with a comment\r\n"
                                                    "  Ns 10.0000\r\n"
                                                    "\tillum 2\r\n"
                                                    "\tKa nonsense\r\n"
                                                    "  Kd 0.725 0.71 .68 # White\r\n"
                                                    "  v .1 0 0\r\n"
                                                    "\r\n"
                                                    "newmtl Material #25\r\n"
                                                    "Kd 1.5\r\n"
                                                    "Ke 17 12 4\r\n"
                                                    "map_Kd textures\\a b.png\r\n"
                                                    "newmtl bare");
    REQUIRE(materials.size() == 3);
    CHECK(materials[0].name == "short box");
    CHECK(materials[0].line == 3);
    CHECK(materials[0].reflectance == Vec3(0.725, 0.71, 0.68));
    CHECK_FALSE(materials[0].emission.has_value());
    CHECK_FALSE(materials[0].reflectance_map);
    CHECK(materials[1].name == "Material #25");
    CHECK(materials[1].reflectance == Vec3(1.5));
    CHECK(materials[1].emission == Vec3(17, 12, 4));
    REQUIRE(materials[1].reflectance_map);
    CHECK(materials[1].reflectance_map->name == "textures/a b.png");
    CHECK(materials[2].name == "bare");
    CHECK_FALSE(materials[2].reflectance.has_value());
}

TEST_CASE("colours that are none are refused with file and line", "[mtl]") {
    for (const std::string colour :
         {"Kd", "Kd .1 .2", "Kd -.1", "Kd .1 .2 -1", "Kd nan", "Ke inf", "Ke 1e200", "Kd 0,5"}) {
        const TemporaryFolder folder;
        const std::string path = folder.write("m.mtl", "newmtl a\n\n" + colour + "\n");
        INFO(colour);
        CHECK_THROWS_WITH(read_mtl(path), Catch::StartsWith(path + ":3: expected 1 or 3 numbers"));
    }
    CHECK(read("newmtl # no name\n").at(0).name == unnamed_material);
    CHECK(read("").empty());
}

TEST_CASE("the first of several definitions is taken", "[mtl]") {
    const TemporaryFolder folder;
    const std::string a = folder.write("a.mtl", "newmtl m\nKd .25\nnewmtl m\nKd .75\n");
    const std::string b = folder.write("b.mtl", "newmtl m\nKe 1\n");
    ReadResult result;
    MaterialTable table(folder.path("scene.obj"), result);
    const std::uint32_t m = table.use("m", 7);
    table.read_libraries("a.mtl b.mtl", 1);
    table.finish();
    CHECK(result.scene.materials[m].reflectance == Vec3(.25));
    CHECK(result.scene.materials[m].emission == Vec3(0.0));
    CHECK(result.material_source[m] == a + ":1");
    REQUIRE(result.warnings.size() == 2);
    CHECK(result.warnings[0].find(a + ":3: material \"m\"") == 0);
    CHECK(result.warnings[1].find(b + ":1: material \"m\"") == 0);
}

TEST_CASE("textures that are missing are one warning", "[mtl]") {
    const TemporaryFolder folder;
    folder.write("a.mtl", "newmtl a\nmap_Kd x.png\nnewmtl b\nKd .1\nmap_Kd y.png\nnewmtl c\n");
    ReadResult result;
    MaterialTable table(folder.path("scene.obj"), result);
    table.read_libraries("a.mtl", 1);
    (void)table.use("a", 2);
    (void)table.use("b", 3);
    table.finish();
    REQUIRE(result.warnings.size() == 1);
    CHECK(result.warnings[0].find("2 textures are not found") != std::string::npos);
    CHECK(textures_of(result.scene).of_material.empty());
    CHECK(result.scene.materials[0].reflectance == Vec3(0.5));
    CHECK(result.scene.materials[1].reflectance == Vec3(0.1));
}

TEST_CASE("what a surface is besides diffuse is kept by its statement", "[mtl]") {
    const auto of = [](const std::string& statements) {
        return read("newmtl a\n" + statements).at(0);
    };
    CHECK(of("d 0.1\nillum 4\n").transparent == "d 0.1");
    CHECK(of("Tr 0.3\n").transparent == "Tr 0.3");
    CHECK(of("d 1\nTr 1\n").transparent.empty()); // exporters disagree on Tr
    CHECK(of("Tr 1\nd 1\n").transparent.empty());
    CHECK(of("map_d leaf.png\n").cut_out == "map_d");
    CHECK(of("map_d leaf.png\n").transparent.empty());
    CHECK(of("illum 7\n").transparent == "illum 7");
    CHECK(of("illum 4\nTf 1 1 1\n").transparent.empty());
    CHECK(of("illum 3\n").mirror == "illum 3");
    CHECK(of("Pm 0.9\n").mirror == "Pm 0.9");
    CHECK(of("Pm 0.1\nNs 5\nillum 2\nd 1\n").mirror.empty());
}

TEST_CASE("what comes through glass follows from d, Tr, Tf and illum", "[mtl]") {
    const auto of = [](const std::string& statements) {
        return read("newmtl a\n" + statements).at(0).transmittance();
    };
    CHECK(of("Kd 1 1 1\n") == Vec3(0));
    CHECK(of("d 0.25\nillum 4\n") == Vec3(.75));
    CHECK(of("Tr 0.25\n") == Vec3(.25));
    CHECK(of("Tr 0.25\nd 0.5\n") == Vec3(.5));
    CHECK(of("Tf .2 .4 .6\n") == Vec3(0)); // exporters write it for all materials
    CHECK(of("Tf .2 .4 .6\nd .5\n") == Vec3(.1, .2, .3));
    CHECK(of("Tf .5\nillum 6\nd 1\n") == Vec3(.5));
    CHECK(of("illum 7\n") == Vec3(1));
    CHECK(of("illum 6\nd .75\n") == Vec3(.25));
    CHECK(of("d -3\nTf 9 -1 .5\n") == Vec3(1, 0, 1)); // within [0,1] whatever it says
    CHECK(of("d .5\nTf spectral a.rfl\n") == Vec3(.5));
}

TEST_CASE("what other readers take is read, with a word", "[mtl]") {
    const TemporaryFolder folder;
    const MtlFile file = read_mtl(folder.write(
        "m.mtl", "newmtl\nKd xyz .1 .2 .3\nmap_Kd a b.png -s 2 2 1\nKe spectral f.rfl\n"));
    REQUIRE(file.materials.size() == 1);
    CHECK_FALSE(file.materials[0].reflectance);
    CHECK(file.materials[0].reflectance_map->name == "a b.png");
    REQUIRE(file.warnings.size() == 3);
    CHECK(file.warnings[0].starts_with("1: a material without a name"));
    CHECK(file.warnings[1] == "2: Kd as a spectrum or in XYZ is not read");
    CHECK(file.warnings[2] == "4: Ke as a spectrum or in XYZ is not read");
}
