// Names, numbers and figures as the user types and reads them.
#include "app/settings/names.h"
#include "app/settings/numbers.h"
#include "app/settings/outputs.h"
#include "app/settings/overrides.h"
#include "radiosity/answers/asked/text.h"
#include "support/catch.h"

#include <limits>

using namespace hemilux;

TEST_CASE("edit distance is that of the textbook") {
    CHECK(edit_distance("", "") == 0);
    CHECK(edit_distance("", "abc") == 3);
    CHECK(edit_distance("kitten", "sitting") == 3);
    CHECK(edit_distance("flaw", "lawn") == 2);
    CHECK(edit_distance("lamp", "lamp") == 0);
}

TEST_CASE("the nearest name is offered only where it is near") {
    const std::vector<std::string> known{"lamp", "wall", "floor"};
    CHECK(nearest_name("lmap", known) == "lamp");
    CHECK(nearest_name("flor", known) == "floor");
    CHECK(nearest_name("fl", known) == "floor");
    CHECK(nearest_name("zebra", known).empty());
    CHECK(nearest_name("x", {}).empty());
    CHECK(unknown_name("material", "zebra", known) ==
          "unknown material 'zebra'; there are lamp, wall, floor");
    CHECK(list_names(known, 2) == "lamp, wall and 1 more");
}

TEST_CASE("a number is all of the text and finite") {
    CHECK(parse_number("1.5") == 1.5);
    CHECK(parse_number(".5e-3") == .5e-3);
    CHECK(parse_number("-2") == -2);
    for (const char* text :
         {"", " 1", "1 ", "1x", "nan", "inf", "-inf", "1e999", "0x10", "1,5", "+1"})
        CHECK_FALSE(parse_number(text).has_value());
    CHECK(parse_whole("18446744073709551615") == std::numeric_limits<std::uint64_t>::max());
    CHECK(parse_whole("1e8") == 100'000'000);
    CHECK(parse_whole("2.5e3") == 2500);
    for (const char* text : {"", "-1", "1.0", "1.5", "25e-1", "-1e3", "e3", "1e3.5", "1e30",
                             "18446744073709551616", "0x1"})
        CHECK_FALSE(parse_whole(text).has_value());
}

TEST_CASE("a range names itself and keeps its ends") {
    CHECK(positive.text() == "above 0");
    CHECK_FALSE(positive.contains(0));
    CHECK(reflectance_range.text() == "from 0 to 1");
    CHECK(reflectance_range.contains(0));
    CHECK(reflectance_range.contains(1));
    CHECK_FALSE(reflectance_range.contains(1 + 1e-15));
    CHECK_FALSE(reflectance_range.contains(std::numeric_limits<double>::quiet_NaN()));
}

TEST_CASE("a material and its new value") {
    const auto lamp = parse_override("lamp=1,2,3", non_negative);
    REQUIRE(lamp);
    CHECK(lamp->material == "lamp");
    CHECK(lamp->value == Vec3(1, 2, 3));
    CHECK(parse_override("*=.5", reflectance_range)->value == Vec3(.5));
    CHECK(parse_override("a=b=7", non_negative)->material == "a=b");
    for (const char* text : {"", "lamp", "lamp=", "=1", "lamp=1,2", "lamp=1,2,3,4", "lamp=1,,3",
                             "lamp=a", "lamp=-1", "lamp=nan"})
        CHECK_FALSE(parse_override(text, non_negative).has_value());
    CHECK_FALSE(parse_override("wall=1.01", reflectance_range).has_value());
}

TEST_CASE("overrides are applied in the order given") {
    Scene scene;
    scene.materials = {{"a", Vec3(.1), Vec3(0)}, {"b", Vec3(.2), Vec3(0)}};
    apply_overrides(scene, &Material::reflectance, {{"*", Vec3(.3)}, {"b", Vec3(.4)}});
    CHECK(scene.materials[0].reflectance == Vec3(.3));
    CHECK(scene.materials[1].reflectance == Vec3(.4));
    CHECK_THROWS_WITH(apply_overrides(scene, &Material::emission, {{"c", Vec3(1)}}),
                      "unknown material 'c'; there are a, b");
}

TEST_CASE("outputs and picture sizes") {
    CHECK(parse_output("a/b.png")->kind == OutputKind::png);
    CHECK(parse_output("b.HDR")->kind == OutputKind::hdr);
    for (const char* path : {"", "png", "a.txt", "a.png.gz", ".png", "dir.png/file"})
        CHECK_FALSE(parse_output(path).has_value());
    CHECK(parse_output("-")->kind == OutputKind::csv);
    CHECK(parse_output("-.PLY")->path == "-");
    CHECK(parse_output("./-.ply")->path == "./-.ply");
    CHECK(parse_output("a-.ply")->path == "a-.ply");
    CHECK_FALSE(parse_output("-.txt").has_value());
    CHECK(parse_size("800x600")->width == 800);
    for (const char* text : {"", "800", "x", "0x600", "800x", "800x600x2", "-1x5", "99999x1"})
        CHECK_FALSE(parse_size(text).has_value());
}

TEST_CASE("shares, times and exposures have units") {
    CHECK(parse_share("1%") == .01);
    CHECK(parse_share(".025") == .025);
    CHECK(parse_share("150%") == 1.5);
    CHECK(parse_seconds("90") == 90);
    CHECK(parse_seconds("90s") == 90);
    CHECK(parse_seconds("1.5m") == 90);
    CHECK(parse_seconds("2h") == 7200);
    for (const char* text : {"", "%", "s", "1 %", "2d", "2ms", "1h30m", "1e308h"}) {
        CHECK_FALSE(parse_share(text).has_value());
        CHECK_FALSE(parse_seconds(text).has_value());
    }
    CHECK(parse_exposure("2.5")->factor == 2.5);
    CHECK(parse_exposure("+1.5ev")->stops == 1.5);
    CHECK(parse_exposure("-2EV")->stops == -2);
    CHECK_FALSE(parse_exposure("0ev")->factor.has_value());
    for (const char* text : {"", "ev", "0", "-1", "+1", "++1ev", "+-1ev", "101ev", "1e"})
        CHECK_FALSE(parse_exposure(text).has_value());
}

TEST_CASE("figures for people") {
    CHECK(short_count(0) == "0");
    CHECK(short_count(999) == "999");
    CHECK(short_count(999.9) == "1.00 k");
    CHECK(short_count(12345) == "12.3 k");
    CHECK(short_count(4.56e6) == "4.56 M");
    CHECK(short_counted(1, "ray", "rays") == "1 ray");
    CHECK(short_counted(12345, "ray", "rays") == "12.3 k rays");
    CHECK(grouped(1234567) == "1 234 567");
    CHECK(grouped(123) == "123");
    CHECK(duration(0.00123) == "1.23 ms");
    CHECK(duration(0.42) == "0.42 s");
    CHECK(duration(185) == "3:05");
    CHECK(duration(3723) == "1:02:03");
    CHECK(duration(std::numeric_limits<double>::infinity()) == "over 100 h");
    CHECK(byte_size(1) == "1 byte");
    CHECK(byte_size(12345) == "12.3 kB");
    CHECK(percent(0.0231) == "2.31 %");
    CHECK(percent(std::numeric_limits<double>::quiet_NaN()) == "unknown");
}
