// A signal at whatever moment leaves every output that was asked for, with what is gathered by then
// and the light of the patches elsewhere. The moments are chosen by the work that is done.
#include "app/program.h"
#include "app/running.h"
#include "app/running/small_room.h"
#include "app/watched_terminal.h"
#include "io/pictures/exr_reader.h"
#include "support/catch.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

using Catch::Contains;
using hemilux::Image;
using test::Running;
using test::Workplace;

namespace {

/// While it lives, programs that are started get a signal by the given question whether to end.
class SignalAt {
  public:
    explicit SignalAt(int question) {
        setenv("HEMILUX_SIGNAL_AT", std::to_string(question).c_str(), 1);
    }
    ~SignalAt() { unsetenv("HEMILUX_SIGNAL_AT"); }
    SignalAt(const SignalAt&) = delete;
    SignalAt& operator=(const SignalAt&) = delete;
};

Workplace::Outcome interrupted(const Workplace& place, const std::string& arguments, int question) {
    const SignalAt signal(question);
    return place.hemilux(arguments);
}

Image exr(const Workplace& place, const std::string& name) {
    return image_of(hemilux::read_exr(place.path(name).string()), "");
}

/// Returns N of "rows 1 to N of"; 0 where no rows are named.
int rows_in(const std::string& talk) {
    std::smatch found;
    return std::regex_search(talk, found, std::regex("rows 1 to ([0-9]+) of"))
               ? std::stoi(found[1].str())
               : 0;
}

/// Returns which share of the pixels of some rows is the same, to within a relative difference.
double share_same(const Image& a, const Image& b, int first, int end, float within = 0) {
    double same = 0;
    for (int y = first; y < end; ++y)
        for (int x = 0; x < a.width; ++x)
            same += glm::distance(a.at(x, y), b.at(x, y)) <= within * glm::length(b.at(x, y));
    return same / ((end - first) * a.width);
}

std::vector<std::vector<std::string>> table(const std::string& text) {
    std::vector<std::vector<std::string>> rows;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        std::vector<std::string>& row = rows.emplace_back();
        std::istringstream fields(line);
        for (std::string field; std::getline(fields, field, ',');)
            row.push_back(field);
    }
    return rows;
}

} // namespace

TEST_CASE("a signal while a picture is gathered leaves its rows above the light of the patches") {
    const Workplace place;
    place.write_room();
    const std::string common =
        "solve room.obj --steps 2 -t 1 --size 48x200 --gather 8 -q " + test::camera_in_room;
    REQUIRE(place.hemilux(common + "-o whole.exr").code == 0);
    REQUIRE(place.hemilux(common + "--no-gather -o patches.exr").code == 0);
    const Image whole = exr(place, "whole.exr"), patches = exr(place, "patches.exr");
    int before = 0, some = 0;
    for (const int question : {1, 30, 60, 90, 120}) {
        const auto outcome =
            interrupted(place, common + "-o a.exr -o a.png -o a.csv --stats a.json", question);
        CAPTURE(question, outcome.err);
        CHECK(outcome.code == 130);
        const int rows = rows_in(outcome.err);
        CHECK(rows >= before);
        before = rows;
        some += rows > 0 && rows < whole.height;
        if (rows == 0)
            CHECK_THAT(outcome.err, Contains("pictures show the light of the patches"));
        for (const char* file : {"a.png", "a.csv", "a.json"})
            CHECK(place.has(file));
        const Image image = exr(place, "a.exr");
        REQUIRE(image.width == whole.width);
        REQUIRE(image.height == whole.height);
        CHECK((rows == 0 || share_same(image, whole, 0, rows) == 1));
        CHECK(share_same(image, patches, rows, image.height, 1e-4f) > .9);
        CHECK_THAT(outcome.err, !Contains("left out"));
    }
    CHECK(some >= 2);
}

TEST_CASE("a signal while points are gathered leaves all rows, with an error that covers them") {
    const Workplace place;
    place.write_room();
    std::string points = ".5 .5 .5 0 0 1\n";
    constexpr std::size_t count = 3000;
    for (std::size_t k = 1; k < count; ++k) // on the floor
        points += std::to_string(.05 + .9 * double(k) / count) + " 0 .4 0 1 0\n";
    points += ".5 .5 .5 0 1 0\n"; // in the air
    place.write("points", points);
    const std::string common = "solve room.obj --steps 2 -t 1 --points points --gather 1 ";
    REQUIRE(place.hemilux(common + "-q --points-output whole.csv").code == 0);
    const auto outcome = interrupted(place, common + "--points-output a.csv", 1);
    CHECK(outcome.code == 130);
    CHECK_THAT(outcome.err, Contains("points 0 to 1 023 of 3 001 are gathered"));
    CHECK_THAT(outcome.err, Contains("1 point away from them hold"));
    const auto whole = table(place.read("whole.csv")), rows = table(place.read("a.csv"));
    REQUIRE(rows.size() == count + 2);
    std::size_t within = 0;
    double worst = 0;
    for (std::size_t k = 1; k <= count; ++k) {
        REQUIRE(rows[k].size() == whole[k].size());
        const double off = std::abs(std::stod(rows[k][7]) - std::stod(whole[k][7])),
                     error = std::stod(rows[k][13]);
        if (k <= 1024) {
            REQUIRE(rows[k] == whole[k]);
            continue;
        }
        CHECK(error > 0);
        within += off < 2 * error;
        worst = std::max(worst, off);
    }
    CHECK(worst > 0);
    CHECK(within > (count - 1024) * 9 / 10);
    CHECK(rows.back()[7].empty());
}

TEST_CASE("a signal while a lightmap is gathered leaves its rows, in .glb and in .obj") {
    const Workplace place;
    place.write_room();
    REQUIRE(place.hemilux("solve room.obj --divide none --steps 1 -q -o room.glb").code == 0);
    const std::string scene = GENERATE("room.glb", "room.obj"), extension = scene.substr(4);
    const std::string common = "bake " + scene +
                               " --reflectance *=.5,.5,.5 "
                               "--steps 2 -t 1 --lightmap 96 --gather 4 ";
    REQUIRE(place.hemilux(common + "-q -o whole" + extension).code == 0);
    const Image whole = exr(place, "whole.lightmap.exr");
    int some = 0;
    for (const int question : {1, 50, 80, 110}) {
        const auto outcome = interrupted(place, common + "-o lit" + extension, question);
        CAPTURE(scene, question, outcome.err);
        CHECK(outcome.code == 130);
        CHECK(place.has("lit" + extension));
        const int rows = rows_in(outcome.err);
        const Image image = exr(place, "lit.lightmap.exr");
        REQUIRE(image.width == whole.width);
        REQUIRE(image.height == whole.height);
        some += rows > 0 && rows < image.height;
        // Texels that are filled from those around may read a row below.
        CHECK((rows == 0 || share_same(image, whole, 0, rows) > .9));
        CHECK(std::ranges::all_of(image.pixels, [](const glm::vec3& texel) {
            return std::isfinite(texel.r) && texel.r >= 0;
        }));
        CHECK((rows == image.height || share_same(image, whole, rows, image.height) < 1));
    }
    CHECK(some >= 1);
}

TEST_CASE("a picture on the way does not change what a run writes in the end") {
    test::WatchedTerminal terminal;
    setenv("TERM", "xterm", 1);
    const Workplace place;
    place.write_room();
    const std::string common =
        "solve room.obj --steps 2 --gather 64 --size 400x300 -o a.png " + test::camera_in_room;
    REQUIRE(place.hemilux(common + "-q").code == 0);
    const std::string without = place.read("a.png");
    Running run(place, common, terminal.name());
    std::size_t versions = 0;
    test::FileVersion last = test::version_of(place, "a.png");
    test::wait_until([&] {
        const test::FileVersion now = test::version_of(place, "a.png");
        versions += now != last;
        last = now;
        return run.ended();
    });
    CHECK(run.wait() == 0);
    const std::string with = place.read("a.png");
    CHECK(versions >= 2);
    CHECK(with.substr(with.find("IDAT")) == without.substr(without.find("IDAT")));
}

TEST_CASE("a baked file on the way does not change what a run writes in the end") {
    test::WatchedTerminal terminal;
    setenv("TERM", "xterm", 1);
    const Workplace place;
    place.write("room.gltf", test::SmallRoom{}.text());
    const std::string common =
        "bake room.gltf -o lit.glb --max-rays 200000 --gather 16 --lightmap 400";
    REQUIRE(place.hemilux(common + " -q").code == 0);
    const std::string without = place.read("lit.glb");
    std::size_t versions = 0;
    test::FileVersion last = test::version_of(place, "lit.glb");
    Running run(place, common, terminal.name());
    test::wait_until([&] {
        const test::FileVersion now = test::version_of(place, "lit.glb");
        versions += now != last;
        last = now;
        return run.ended();
    });
    CHECK(run.wait() == 0);
    CHECK(versions >= 2);
    CHECK(test::glb_from(place.read("lit.glb")).binary == test::glb_from(without).binary);
}
