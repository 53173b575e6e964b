// Every way in which the program ends, with the message that goes with it.
#include "app/check_fails.h"
#include "support/catch.h"

#include <unistd.h>

using Catch::Contains;
using test::Workplace;

TEST_CASE("help and version go to stdout and end with 0") {
    const Workplace place;
    for (const char* arguments : {"--help", "solve --help", "compare --help", "info --help"}) {
        const auto help = place.hemilux(arguments);
        CHECK(help.code == 0);
        CHECK(help.err.empty());
        CHECK_THAT(help.out, Contains("hemilux"));
    }
    const std::string help = place.hemilux("solve --help").out;
    CHECK_THAT(help, Contains("(not with --verbose)") && Contains("(not with --quiet)"));
    CHECK_THAT(help, !Contains("Excludes"));
    for (const char* text :
         {"--method", "--literal", "--steps-log", "Examples:", "Exit codes:", " hemisphere ",
          " matrix ", " progressive-monte-carlo ", " stratified"})
        CHECK_THAT(help, Contains(text));
    for (const char* arguments :
         {"--version", "solve --version", "compare --version", "info --version"})
        CHECK(place.hemilux(arguments).out.rfind("hemilux ", 0) == 0);
}

TEST_CASE("help for a word that is no subcommand is refused") {
    const Workplace place;
    CHECK(place.hemilux("help solve").out == place.hemilux("solve --help").out);
    for (const char* arguments : {"help sovle", "sovle --help"})
        check_fails(place, 1, arguments, "sovle");
}

TEST_CASE("wrong usage ends with 1 and says what was expected") {
    const Workplace place;
    place.write_room();
    check_fails(place, 1, "frobnicate", "hemilux --help");
    check_fails(place, 1, "solve -o a.png", "SCENE");
    check_fails(place, 1, "solve room.obj", "-o picture.png, or let `hemilux room.obj` name");
    check_fails(place, 1, "solve room.obj -o a.png --frobnicate", "--frobnicate");
    check_fails(place, 1, "solve room.obj -o", "FILE");
    check_fails(place, 1, "solve room.obj -o a.txt",
                ".png, .hdr, .exr, .ply, .glb, .vtu, .csv or .json, not 'a.txt'");
    check_fails(place, 1, "solve room.obj -o a", "not 'a'");
    check_fails(place, 1, "solve room.obj -o a.png -o ./a.png", "named twice");
    check_fails(place, 1, "solve room.obj -o a.csv --reference a.csv", "named twice");
    check_fails(place, 1, "solve room.obj -q -v -o a.png", "--quiet and --verbose");
    check_fails(place, 1, "solve room.obj -o a.png --method hemisfere",
                "did you mean 'hemisphere'?");
    check_fails(place, 1, "solve room.obj -o a.png --method zzz", "matrix");
    check_fails(place, 1, "solve room.obj -o a.png --emission lmap=1", "did you mean 'lamp'?");
    check_fails(place, 1, "solve room.obj -o a.png --reflectance sky=.5", "white, red, lamp");
    check_fails(place, 1, "solve room.obj -o a.png --detail wals", "did you mean 'walls'?");
    check_fails(place, 1, "solve room.obj -o a.png --max-edge 1e-7", "--max-edge");
}

TEST_CASE("every number has its range", "[slow]") {
    const Workplace place;
    place.write_room();
    for (const char* option : {"--rays 0",
                               "--rays -1",
                               "--rays nan",
                               "--rays 1e10",
                               "--rays many",
                               "--steps 0",
                               "--steps 1.5",
                               "--steps 4294967296",
                               "--time 0",
                               "--time inf",
                               "--error 0",
                               "--error -.1",
                               "--depth 6",
                               "--depth -1",
                               "--threshold -1",
                               "--threshold nan",
                               "--seed -1",
                               "--seed 18446744073709551616",
                               "--threads 1025",
                               "--max-edge 0",
                               "--size 0x10",
                               "--size 800",
                               "--exposure 0",
                               "--exposure 101ev",
                               "--exposure +-1ev",
                               "--time 2x",
                               "--time s",
                               "--error 0%",
                               "--error %",
                               "--emission lamp=-1",
                               "--emission lamp=1,2",
                               "--emission lamp",
                               "--reflectance white=1.5",
                               "--reflectance white=nan",
                               "--camera 1,2,3",
                               "--camera 0,0,0,0,0,0",
                               "--camera 0,0,0,1,0,0,180"}) {
        const std::string text(option);
        const std::size_t blank = text.find(' ');
        const std::string value = text.substr(blank + 1);
        check_fails(place, 1, "solve room.obj -o a.png " + text, text.substr(0, blank));
        check_fails(place, 1, "solve room.obj -o a.png " + text, "not '" + value + "'");
    }
    CHECK_FALSE(place.has("a.png"));
}

TEST_CASE("bad input ends with 2 and names the file") {
    const Workplace place;
    place.write_room();
    check_fails(place, 2, "solve nothing.obj -o a.png", "nothing.obj");
    check_fails(place, 2, "solve room.mtl -o a.png", "room.mtl: expected a scene of a kind");
    place.write("bad.obj", "v 0 0 0\nv 1 0 0\nf 1 2 7\n");
    check_fails(place, 2, "solve bad.obj -o a.png", "bad.obj:3");
    check_fails(place, 2, "info bad.obj", "bad.obj:3");
    place.write("empty.obj", "");
    check_fails(place, 2, "solve empty.obj -o a.png", "empty.obj");

    check_fails(place, 2, "solve room.obj -o a.png --emission '*=0'", "--emission");
    check_fails(place, 2, "solve room.obj -o a.png --emission '*=0'", "white, red, lamp");

    place.write("room.mtl", "newmtl white\nKd 1.5 .5 .5\nnewmtl red\nnewmtl lamp\nKe 1 1 1\n");
    check_fails(place, 2, "solve room.obj -o a.png", "white");
    check_fails(place, 2, "solve room.obj -o a.png", "room.mtl:1");
    CHECK(place.hemilux("solve room.obj -o a.csv --steps 1 --reflectance white=.9").code == 0);
}

TEST_CASE("a reference of other patches is bad input") {
    const Workplace place;
    place.write_room();
    REQUIRE(place.hemilux("solve room.obj --steps 1 -o reference.csv").code == 0);
    check_fails(place, 2, "solve room.obj -o a.csv --reference none.csv", "none.csv");
    check_fails(place, 2, "solve room.obj -o a.csv --reference room.obj", "room.obj");
    check_fails(place, 2, "solve room.obj --max-edge .3 -o a.csv --reference reference.csv",
                "reference.csv: has 24 patches");
    CHECK(place.hemilux("solve room.obj --steps 1 -o a.csv --reference reference.csv").code == 0);
}

TEST_CASE("outputs that cannot be written end with 3 before any work") {
    const Workplace place;
    place.write("slow.obj", "not even read");
    check_fails(place, 3, "solve slow.obj -o nowhere/a.png", "the folder 'nowhere' does not exist");
    check_fails(place, 3, "solve slow.obj -o a.csv --stats nowhere/a.json", "nowhere");
    std::filesystem::create_directory(place.path("folder.png"));
    check_fails(place, 3, "solve slow.obj -o folder.png", "is a folder");
    if (geteuid() != 0) { // root may write anywhere
        std::filesystem::permissions(place.path("folder.png"), std::filesystem::perms::owner_read);
        check_fails(place, 3, "solve slow.obj -o folder.png/a.csv", "folder.png");
    }
}

TEST_CASE("an output that fails does not keep the others from being written") {
    const Workplace place;
    place.write_room();
    std::filesystem::create_symlink("/dev/full", place.path("full.csv"));
    check_fails(place, 3, "solve room.obj --steps 1 -o full.csv -o good.csv -o good.json",
                "full.csv");
    CHECK(place.has("good.csv"));
    CHECK(place.has("good.json"));

    CHECK(place.hemilux("info room.obj").code == 0);
    CHECK(std::system(("'" HEMILUX_PROGRAM "' info '" + place.path("room.obj").string() +
                       "' >/dev/full 2>/dev/null")
                          .c_str()) == 3 << 8);
}
