// `hemilux solve --for`: a part of the scene is right, and all outputs say so.
#include "app/check_fails.h"
#include "app/running/run_target.h"
#include "app/statistics_file.h"
#include "io/scene_files/obj.h"
#include "support/catch.h"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

using Catch::Contains;
using test::Workplace;

namespace {

const std::string solve = "solve room.obj --max-edge .25 --error .01 --seed 4 -o light.csv ";
const std::string camera = "--camera .5,.5,.5,0,.5,.5 ";

/// The last fields of the rows of a table, the header's first.
std::vector<std::string> last_column(const std::string& table) {
    std::vector<std::string> fields;
    std::istringstream lines(table);
    for (std::string line; std::getline(lines, line);)
        fields.push_back(line.substr(line.rfind(',') + 1));
    return fields;
}

} // namespace

TEST_CASE("What a run is for stands in the summary, the statistics and the patch table") {
    const Workplace place;
    place.write_room();
    const auto outcome =
        place.hemilux(solve + "--for group:detail_floor --stats s.json --steps-log steps.csv");
    REQUIRE(outcome.code == 0);
    CHECK_THAT(outcome.err, Contains("of the light on group:detail_floor; elsewhere it is rough"));
    const std::string statistics = place.read("s.json");
    CHECK_THAT(statistics, Contains("\"for\": [\n    \"group:detail_floor\"\n  ]"));
    CHECK(test::statistic(statistics, "estimated_error") <= .01);
    CHECK(test::statistic(statistics, "estimated_error_elsewhere") > 0);
    CHECK(std::isnan(test::statistic(statistics, "error_division")));
    const std::vector<std::string> target = last_column(place.read("light.csv"));
    CHECK(target[0] == "target");
    std::size_t counted = 0;
    std::istringstream rows(place.read("light.csv"));
    std::string row;
    std::getline(rows, row);
    for (std::size_t i = 1; std::getline(rows, row); ++i) {
        const bool on_floor = row.find(",detail_floor,") != std::string::npos;
        CHECK(target[i] == (on_floor ? "1" : "0"));
        counted += on_floor;
    }
    CHECK(counted == 16);
}

TEST_CASE("Without --for nothing speaks of a target") {
    const Workplace place;
    place.write_room();
    const auto outcome = place.hemilux(solve + "--stats s.json");
    REQUIRE(outcome.code == 0);
    CHECK_THAT(outcome.err, !Contains("elsewhere"));
    CHECK_THAT(place.read("s.json"), !Contains("\"for\"") && !Contains("elsewhere"));
    CHECK(last_column(place.read("light.csv"))[0] == "stderr_b");
}

TEST_CASE("Groups, points and a camera are one target together") {
    const Workplace place;
    place.write_room();
    place.write("p.txt", "x,y,z,nx,ny,nz\n.6 .6 0 0 0 1\n");
    REQUIRE(place.hemilux(solve + "-q --for points:p.txt").code == 0);
    const auto of_point = last_column(place.read("light.csv"));
    CHECK(std::count(of_point.begin(), of_point.end(), "1") == 1);
    REQUIRE(place.hemilux(solve + camera + "-q --for camera").code == 0);
    const auto of_camera = last_column(place.read("light.csv"));
    REQUIRE(place
                .hemilux(solve + camera +
                         "-q --stats s.json --for points:p.txt --for camera --for group:lamp "
                         "--for group:detail_floor")
                .code == 0);
    const auto of_all = last_column(place.read("light.csv"));
    for (std::size_t i = 1; i < of_all.size(); ++i)
        CHECK(std::stod(of_all[i]) >= std::stod(of_camera[i]));
    CHECK_THAT(place.read("s.json"), Contains("\"camera\",\n    \"group:lamp\",\n    "
                                              "\"group:detail_floor\",\n    \"points:p.txt\""));
}

TEST_CASE("Points of --for are read once, however often patches are divided") {
    const Workplace place;
    place.write_room();
    place.write("p.txt", ".6 .6 0 0 0 1\n");
    hemilux::SolveSettings settings;
    settings.target.points = {place.path("p.txt")};
    const auto points = hemilux::points_of_target(settings.target);
    std::filesystem::remove(place.path("p.txt"));
    hemilux::Watcher nobody;
    hemilux::Problem problem = hemilux::prepare(
        std::make_shared<hemilux::Mesh>(hemilux::read_obj(place.path("room.obj")).scene), {}, {},
        nobody);
    hemilux::aim_at(problem, settings, points);
    CHECK(std::ranges::count(problem.weights, 1) == 1);
    problem.find_again();
    CHECK(std::ranges::count(problem.weights, 1) == 1);
}

TEST_CASE("A run with --for goes on from its checkpoint, and from no other") {
    const Workplace place;
    place.write_room();
    place.write("p.txt", ".6 .6 0 0 0 1\n");
    const std::string run =
        "solve room.obj -q --max-edge .25 --for points:p.txt " +
        GENERATE(std::string(), "--method hemisphere ", "--method monte-carlo ");
    REQUIRE(place.hemilux(run + "--steps 4 -o whole.csv -t 1").code == 0);
    REQUIRE(place.hemilux(run + "--steps 2 -o parts.csv --checkpoint saved -t 2").code == 0);
    REQUIRE(place.hemilux(run + "--steps 4 -o parts.csv --resume saved -t 2").code == 0);
    CHECK(place.read("whole.csv") == place.read("parts.csv"));
    const std::string go_on = run.substr(0, run.find("--for")) + run.substr(run.find(".txt ") + 5) +
                              "--steps 4 -o x.csv --resume saved";
    test::check_fails(place, 2, go_on, "is a checkpoint of another run");
    test::check_fails(place, 2, go_on + " --for group:walls", "expected --for group:walls");
    place.write("p.txt", ".1 .1 0 0 0 1\n");
    test::check_fails(place, 2, run + "--steps 4 -o x.csv --resume saved", "what the run was for");
}

TEST_CASE("With --divide auto patches of the target are divided, and all of its error is reported",
          "[slow]") {
    const Workplace place;
    place.write_room();
    const std::string run = "solve room.obj --divide auto --for group:detail_floor --seed 3 ";
    const auto outcome = place.hemilux(run + "--error .05 -t 1 -o 1.csv --stats s.json");
    REQUIRE(outcome.code == 0);
    REQUIRE(place.hemilux(run + "--error .05 -t 2 -o 2.csv -q").code == 0);
    CHECK(place.read("1.csv") == place.read("2.csv"));
    CHECK_THAT(outcome.err, Contains("of the light on group:detail_floor: sampling "));
    const std::string json = place.read("s.json");
    CHECK_THAT(json, Contains("\"estimated_error_of\": \"target\""));
    const double whole = test::statistic(json, "estimated_error");
    CHECK(whole == Approx(std::hypot(test::statistic(json, "error_sampling"),
                                     test::statistic(json, "error_division"))));
    CHECK(whole <= .05);
    REQUIRE(place.hemilux("solve room.obj --divide auto --seed 3 --error .05 -o all.csv -q").code ==
            0);
    const auto patches_elsewhere = [](const std::string& table) {
        std::istringstream rows(table);
        std::ptrdiff_t count = 0;
        for (std::string row; std::getline(rows, row);)
            count += row.find(",detail_floor,") == std::string::npos;
        return count;
    };
    CHECK(2 * patches_elsewhere(place.read("1.csv")) < patches_elsewhere(place.read("all.csv")));
}

TEST_CASE("A target that cannot be is refused") {
    const Workplace place;
    place.write_room();
    place.write("air.txt", "0 0 0 0 0 1\n.5 .5 .5 0 0 1\n");
    place.write("words.txt", "here and there\n1 2 3\n");
    const auto refused = [&](int code, const std::string& arguments, const std::string& message) {
        test::check_fails(place, code, "solve room.obj -o x.csv " + arguments, message);
        CHECK_FALSE(place.has("x.csv"));
    };
    refused(1, "--for floor", "--for: expected camera, group:NAME or points:FILE, found 'floor'");
    refused(1, "--for group:", "expected camera, group:NAME or points:FILE");
    refused(1, "--for camera:1", "expected camera, group:NAME or points:FILE");
    refused(1, camera + "--for camera --for camera", "'camera' is named twice");
    refused(1, "--for group:lamp --for group:lamp", "'group:lamp' is named twice");
    refused(1, "--for camera", "--for camera needs the view of --camera");
    refused(1, "--for group:wall", "unknown group 'wall'; did you mean 'walls'?");
    refused(2, "--for points:none.txt", "none.txt");
    refused(2, "--for points:air.txt", "air.txt:2: --for: expected a point on a face");
    refused(2, "--for points:words.txt", "words.txt:2: expected six numbers");
    refused(2, "--for group:lamp", "nothing that --for names reflects light");
    refused(1, "--for group:walls --method matrix", "these take a target: ");
    refused(1, "--for group:walls --literal --method stored-transport",
            "with --literal each patch");
    refused(1, "--for group:walls --plain", "--plain solves for all patches alike");
    place.write("p.txt", ".6 .6 0 0 0 1\n");
    test::check_fails(place, 1, "solve room.obj -o x.csv --stats p.txt --for points:p.txt",
                      "file of --for");
}
