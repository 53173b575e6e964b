// Results go where they were asked to go, each whole: no two into one file under two names, none
// into a stream that takes no bytes.
#include "app/program.h"
#include "support/catch.h"

#include <cstdlib>
#include <filesystem>
#include <sys/stat.h>

using Catch::Contains;
using test::Workplace;

namespace {

constexpr const char* solve = "solve room.obj --method stratified --steps 1 -q ";

/// A scene that cannot be read: who refuses the outputs has not read it.
constexpr const char* unread = "solve none.obj --method stratified --steps 1 -q ";

void check_one_file(const Workplace& place, const std::string& arguments) {
    CAPTURE(arguments);
    const Workplace::Outcome outcome = place.hemilux(unread + arguments);
    CHECK(outcome.code == 1);
    CHECK_THAT(place.read("stderr.txt"), Contains("are one file, named twice"));
}

} // namespace

TEST_CASE("two outputs in one stream or file are refused, whatever names they have") {
    const Workplace place;
    place.write("f.csv", "old");
    std::filesystem::create_hard_link(place.path("f.csv"), place.path("hard.json"));
    std::filesystem::create_symlink("/dev/stdout", place.path("link.json"));
    REQUIRE(mkfifo(place.path("pipe.csv").c_str(), 0600) == 0);
    std::filesystem::create_symlink("pipe.csv", place.path("pipe.json"));
    for (const char* const name : {"/dev/stdout", "/dev/fd/1", "/proc/self/fd/1", "link.json"}) {
        check_one_file(place, std::string("-o - --stats ") + name + " >f.csv");
        const auto piped = place.hemilux(unread + std::string("-o - --stats ") + name + " | cat");
        CHECK_THAT(piped.err, Contains("are one file, named twice")); // the code is that of cat
    }
    check_one_file(place, "-o - --stats f.csv >>f.csv");
    check_one_file(place, "-o - --stats hard.json >>f.csv");
    check_one_file(place, "-o f.csv --stats hard.json");
    check_one_file(place, "-o a.csv --steps-log /dev/fd/3 --stats /dev/fd/4 3>>f.csv 4>>f.csv");
    check_one_file(place, "-o pipe.csv --stats pipe.json");
    check_one_file(place, "-o - --points p --points-output /dev/stdout >f.csv");
}

TEST_CASE("an output that is the scene as this process has it open is refused") {
    const Workplace place;
    place.write_room();
    const auto outcome = place.hemilux(solve + std::string("-o - >>room.obj"));
    CHECK(outcome.code == 1);
    CHECK_THAT(outcome.err, Contains("'room.obj'") && Contains("are one file"));
}

TEST_CASE("a stream that takes no bytes is refused before the scene is read") {
    const Workplace place;
    place.write("f", "old");
    const auto check = [&](const std::string& arguments, const std::string& message) {
        CAPTURE(arguments);
        const Workplace::Outcome outcome = place.hemilux(arguments);
        CHECK(outcome.code == 3);
        CHECK_THAT(outcome.err, Contains(message));
    };
    const std::string closed = "is closed, or not open for writing";
    check(unread + std::string("-o - >&-"), "standard output: " + closed);
    check(unread + std::string("-o a.csv --stats /dev/stdout >&-"), "/dev/stdout: " + closed);
    check(unread + std::string("-o a.csv --stats /dev/fd/7"), "/dev/fd/7: " + closed);
    check(unread + std::string("-o a.csv --stats /dev/fd/3 3<f"), "/dev/fd/3: " + closed);
    std::filesystem::create_symlink("/dev/fd/9", place.path("link.csv"));
    std::filesystem::create_symlink("/dev/stdout", place.path("link.svg"));
    check("formfactors none.obj -o link.csv", "link.csv: " + closed);
    check("density none.obj -o link.svg >&-", "link.svg: " + closed);
    CHECK(place.read("f") == "old");
}

TEST_CASE("an output that this process has open is written behind what is there") {
    const Workplace place;
    place.write_room();
    REQUIRE(
        place
            .hemilux("solve room.obj --method stratified --steps 1 -q -o a.csv; { echo before; '" +
                     std::string(HEMILUX_PROGRAM) + "' " + solve +
                     "-o b.json --steps-log /dev/fd/3; echo after; } 3>f >&3")
            .code == 0);
    const std::string text = place.read("f");
    CHECK(text.starts_with("before\nmethod,run,step,"));
    CHECK(text.ends_with("\nafter\n"));
    CHECK(place.has("a.csv"));
}
