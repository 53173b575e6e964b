// Names that attack the terminal, files under a wrong name, and the words for them.
#include "app/program.h"
#include "support/catch.h"

using Catch::Contains;
using test::Workplace;

namespace {

void check_clean(const std::string& text) {
    CHECK_THAT(text, !Contains("\x1b") && !Contains("\a") && !Contains("\xc2\x9b"));
    CHECK_THAT(text, !Contains("\xff"));
    CHECK(text.size() < 5000);
}

const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

} // namespace

TEST_CASE("names from files reach the terminal without control characters") {
    const Workplace place;
    const std::string evil = "\x1b]0;owned\a\xc2\x9b"
                             "2J\xff" +
                             std::string(100'000, 'x');
    place.write("a.obj", "mtllib " + evil + "\nmtllib a.mtl\n" + triangle + "g " + evil +
                             "\nusemtl " + evil + "\nf 1 2 3\n");
    place.write("a.mtl", "newmtl " + evil + "\nKe 1 1 1\nnewmtl " + evil + "\nKe 2 2 2\n");
    for (const char* arguments : {"info a.obj", "solve a.obj -o a.csv --rays 1 --steps 1 -v",
                                  "solve a.obj -o a.csv --emission $(printf 'x\\033[31m')=1"}) {
        CAPTURE(arguments);
        const auto outcome = place.hemilux(arguments);
        check_clean(outcome.out);
        check_clean(outcome.err);
    }
    CHECK_THAT(place.hemilux("info a.obj").out, Contains("\xef\xbf\xbd]0;owned"));
    place.write("b.obj", "v \x1b[2J 0 0\n");
    check_clean(place.hemilux("info b.obj").err);
    check_clean(place.hemilux("info $(printf 'no\\033[2Jfile.obj')").err);
}

TEST_CASE("files of other formats are named") {
    const Workplace place;
    const auto check = [&](const std::string& content, const std::string& words) {
        place.write("a.obj", content);
        const auto outcome = place.hemilux("info a.obj");
        CAPTURE(words);
        CHECK(outcome.code == 2);
        CHECK_THAT(outcome.err, Contains("a.obj") && Contains(words));
    };
    check("\x1f\x8b\x08" + std::string(20, '\0'), "gzip");
    check("PK\x03\x04xyz", "zip archive");
    check("<!DOCTYPE html><html>", "a web page");
    check("\n  <HTML>", "a web page");
    check("<?xml version=\"1.0\"?>", "XML");
    check("\xff\xfev" + std::string(1, '\0'), "UTF-16");
    check(std::string("v\0 \0001\0", 6), "UTF-16");
    check("ply\nformat ascii 1.0\n", "PLY");
    check("{\"asset\":{\"version\":\"2.0\"}}", "glTF");
    check(std::string("glTF\2\0\0\0", 8), "glTF");
    check("solid cube\nfacet normal 0 0 1\n", "STL");
    check("V 0 0 0\nV 1 0 0\nV 0 1 0\nF 1 2 3\n", "small letters");
}

TEST_CASE("what is left out of a scene is said in the right words") {
    const Workplace place;
    place.write("a.obj", "mtllib a.mtl\nusemtl a\n" + triangle + "f 1 2 3\nUSEMTL b\n");
    place.write("a.mtl", "newmtl a\nKd .5\nmap_Ke glow.png\n");
    CHECK_THAT(place.hemilux("info a.obj").err,
               Contains("texture is not found") && Contains("capitals"));
    place.write("a.mtl", "newmtl a\nKd -.5\n");
    CHECK_THAT(place.hemilux("info a.obj").err, Contains("negative") && !Contains("finite"));
    place.write("a.mtl", "newmtl a\nKd 1e200\n");
    CHECK_THAT(place.hemilux("info a.obj").err, Contains("finite"));
    place.write("a.mtl", "newmtl a\nKD 1\n");
    CHECK_THAT(place.hemilux("info a.obj").err, Contains("expected Kd"));
}

TEST_CASE("mistakes of the command line are said in the program's own words") {
    const Workplace place;
    place.write_room();
    const auto check = [&](const std::string& arguments, const std::string& words) {
        const auto outcome = place.hemilux(arguments);
        CAPTURE(arguments, outcome.err);
        CHECK(outcome.code == 1);
        CHECK_THAT(outcome.err, Contains(words));
        CHECK_THAT(outcome.err, !Contains("required") && !Contains("At Most"));
    };
    check("solve room.obj -o a.png --rays", "--rays: expected a value");
    check("solve room.obj -o a.png --rays 1 --rays 2",
          "--rays: expected once, it is given 2 times");
    check("solve -o a.png", "expected SCENE");
    check("--up y", "unknown option '--up'");
    check("solve room.obj -o a.png --two-sided --sides both", "contradict");
    check("solve room.obj b.obj -o a.png", "'b.obj' was not expected");
}

TEST_CASE("a camera whose eye is its target is refused before solving") {
    const Workplace place;
    place.write_room();
    for (const char* camera : {"1,1,1,1,1,1", "0,0,0,1e-300,0,0"}) {
        const auto outcome =
            place.hemilux("solve room.obj -o a.png --camera " + std::string(camera));
        CHECK(outcome.code == 1);
        CHECK_THAT(outcome.err, Contains("--camera") && !Contains("rays in"));
    }
}
