// --spill: what --memory has no room for lies in a file, and nothing else changes.
#include "app/program.h"
#include "app/running.h"
#include "app/settings/memory.h"
#include "support/catch.h"

#include <csignal>
#include <filesystem>

using Catch::Contains;
using test::Workplace;

namespace {

const std::string solve =
    "solve room.obj --divide .1 --steps 3 --size 40x30 " + test::camera_in_room;

} // namespace

TEST_CASE("With --spill no byte of any output changes") {
    const Workplace place;
    place.write_room();
    std::filesystem::create_directory(place.path("disk"));
    REQUIRE(place.hemilux(solve + "-o one.csv -o one.png -o one.ply").code == 0);
    const auto spilled =
        place.hemilux(solve + "-t 2 -v --memory 200k --spill disk -o some.csv -o some.png "
                              "-o some.ply --stats some.json");
    CHECK(spilled.code == 0);
    CHECK_THAT(spilled.err, Contains("the file of --spill has 67.1 MB"));
    CHECK_THAT(place.read("some.json"), Contains("\"bytes_spilled\": 67108864"));
    for (const char* const kind : {".csv", ".png", ".ply"}) {
        CAPTURE(kind);
        CHECK((place.read(std::string("some") + kind) == place.read(std::string("one") + kind)));
    }
    CHECK(std::filesystem::is_empty(place.path("disk")));
    REQUIRE(place.hemilux(solve + "--memory 1G --spill disk -o all.csv --stats all.json").code ==
            0);
    CHECK((place.read("all.csv") == place.read("one.csv")));
    CHECK(place.read("all.json").find("bytes_spilled\":") == std::string::npos);
}

TEST_CASE("With --spill no rays are forgotten for want of memory") {
    hemilux::SceneSettings scene;
    CHECK(hemilux::with_memory({}, scene).memory > 0);
    scene.spill = ".";
    CHECK(hemilux::with_memory({}, scene).memory == 0); // no limit
}

TEST_CASE("Without a folder to write to, or --memory, there is no --spill") {
    const Workplace place;
    place.write_room();
    const auto no_folder = place.hemilux(solve + "--memory 200k --spill none -o a.csv");
    CHECK(no_folder.code == 3);
    CHECK_THAT(no_folder.err, Contains("none: --spill cannot make a file there: No such file"));
    const auto no_memory = place.hemilux(solve + "--spill . -o a.csv");
    CHECK(no_memory.code == 1);
    CHECK_THAT(no_memory.err, Contains("--spill: --memory is to say"));
    CHECK_FALSE(place.has("a.csv"));
}

TEST_CASE("A killed run leaves nothing of --spill behind") {
    const Workplace place;
    place.write_room();
    std::filesystem::create_directory(place.path("disk"));
    test::Running run(place,
                      "solve room.obj --divide .1 --error 1e-9 -v --memory 200k --spill disk "
                      "-o a.json",
                      place.path("stderr.txt").c_str());
    REQUIRE(test::wait_until(
        [&] { return place.read("stderr.txt").find("step 1:") != std::string::npos; }));
    CHECK(std::filesystem::is_empty(place.path("disk")));
    run.send(SIGKILL);
    CHECK(run.wait() == -1);
    CHECK(std::filesystem::is_empty(place.path("disk")));
}
