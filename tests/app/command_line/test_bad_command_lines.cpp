// Command lines that cannot be meant: exit code 1, a message that says what could be.
#include "app/check_fails.h"
#include "support/catch.h"

using Catch::Contains;
using test::Workplace;

namespace {

void check_usage(const Workplace& place, const std::string& arguments, const std::string& message) {
    test::check_fails(place, 1, arguments, message);
    CHECK(place.read("stderr.txt").size() < 1000);
}

} // namespace

TEST_CASE("the nearest option and the nearest subcommand are suggested") {
    const Workplace place;
    place.write_room();
    check_usage(place, "solve room.obj -o a.png --metod matrix", "did you mean '--method'?");
    check_usage(place, "solve room.obj -o a.png --reflectence white=.5",
                "did you mean '--reflectance'?");
    check_usage(place, "solve room.obj -o a.png --checkpiont=c", "did you mean '--checkpoint'?");
    check_usage(place, "compare room.obj -o a --budget-ray 3", "did you mean '--budget-rays'?");
    check_usage(place, "sovle room.obj -o a.png", "did you mean 'solve'?");
    check_usage(place, "density room.obj -o a.png --patc 1", "did you mean '--patch'?");
    check_usage(place, "solve room.obj -o a.png -Z", "unknown option '-Z'");
}

TEST_CASE("an option that earlier versions had names what takes its place") {
    const Workplace place;
    place.write_room();
    place.write("spill.toml", "spill = \".\"\n");
    const std::string instead = "--spill: the program has this option no more; where memory is too "
                                "small, a swap file";
    for (const char* const option : {"--spill .", "--spill=.", "--memory 1G --spill . --steps 1"})
        check_usage(place, std::string("solve room.obj -o a.csv ") + option, instead);
    check_usage(place, "compare room.obj -o a --spill .", instead);
    test::check_fails(place, 2, "solve room.obj -o a.csv --config spill.toml",
                      "spill.toml:1: " + instead);
    CHECK_FALSE(place.has("a.csv"));
}

TEST_CASE("values that are missing, doubled or contradict each other", "[slow]") {
    const Workplace place;
    place.write_room();
    for (const char* option :
         {"-o",          "--method",    "--rays",       "--depth",  "--seed",     "--steps",
          "--time",      "--error",     "--camera",     "--size",   "--emission", "--reflectance",
          "--reference", "--detail",    "--checkpoint", "--resume", "--every",    "--memory",
          "--max-edge",  "--threshold", "--exposure",   "--stats"})
        check_usage(place, "solve room.obj -o a.png " + std::string(option), option);
    check_usage(place, "solve room.obj other.obj -o a.png", "other.obj");
    check_usage(place, "solve room.obj -o a.png --rays 5 --rays 6", "--rays");
    check_usage(place, "solve room.obj -o a.png --rays ''", "--rays");
    check_usage(place, "compare room.obj -o a --budget-rays 1e5 --budget-time 3", "--budget-");
    check_usage(place, "compare room.obj -o a --methods hemisphere,hemisphere", "named twice");
    check_usage(place, "compare room.obj -o a --methods stored-transport,gathering", "named twice");
    check_usage(place, "compare room.obj -o a --methods hemisphere,", "method");
    check_usage(place, "compare room.obj", "-o");
    check_usage(place, "solve room.obj -o a.png -q -v", "contradict");
    check_usage(place, "solve room.obj -o a.png --exact", "--exact is for --method matrix");
    check_usage(place, "solve room.obj -o a.png --one-shot", "--one-shot is for");
    check_usage(place, "solve room.obj -o a.png --parts 16",
                "--parts 16 is for --method hemisphere-1997");
    const std::string of_1997 = "solve room.obj -o a.png --method hemisphere-1997 ";
    check_usage(place, of_1997 + "--parts 9", "--parts: expected 1, 4, 16 or 64, not '9'");
    check_usage(place, of_1997 + "--stored-steps 6", "--stored-steps: expected 0, 1, 2, 3, 4 or 5");
    check_usage(place, of_1997 + "--estimated-steps -1", "--estimated-steps: expected 0, 1, ");
    check_usage(place, of_1997 + "--stored-steps 5 --parts 16", "expected 16384 at most");
    check_usage(place, "solve -o a.png", "SCENE");
    check_usage(place, "solve room.obj -o ''", "a file name");
    check_usage(place, "solve room.obj -o .png", "a file name");
    check_usage(place, "solve room.obj -o a.", "a file name");
    check_usage(place, "solve room.obj -o a.png.bak", "a file name");
}

TEST_CASE("empty and odd file names are refused, not opened") {
    const Workplace place;
    place.write_room();
    for (const char* arguments :
         {"info ''", "info .", "info .obj", "info /dev/null", "info nul.obj"}) {
        CAPTURE(arguments);
        const auto outcome = place.hemilux(arguments);
        CHECK(outcome.code == 2);
        CHECK_FALSE(outcome.err.empty());
    }
    const auto outcome = place.hemilux("info \"$(printf '%05000d' 0).obj\"");
    CHECK(outcome.code == 2);
}

TEST_CASE("a reflectance above one names the material and its line") {
    const Workplace place;
    place.write_room();
    for (const char* colour : {"2 2 2", "1.5 .5 .5", ".5 .5 1.0001"}) {
        place.write("room.mtl", "newmtl lamp\nKe 1 1 1\nnewmtl red\n\nnewmtl white\nKd " +
                                    std::string(colour) + "\n");
        const auto outcome = place.hemilux("solve room.obj -o a.png");
        CHECK(outcome.code == 2);
        CHECK_THAT(outcome.err, Contains("white") && Contains("room.mtl:5"));
    }
}
