// `hemilux solve --report`: the page has the numbers of the tables, and no name breaks it.
#include "app/check_fails.h"
#include "app/report/base64.h"
#include "app/report/read_report.h"
#include "app/running.h"
#include "io/results/tables.h"
#include "support/catch.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

using Catch::Contains;
using test::element_of;
using test::floats_of;
using test::words_of;
using test::Workplace;

namespace {

using Json = nlohmann::json;

bool same(const std::vector<float>& page, const std::vector<hemilux::Vec3>& table) {
    bool all = page.size() == 3 * table.size();
    for (std::size_t i = 0; all && i < page.size(); ++i)
        all = page[i] == static_cast<float>(table[i / 3][static_cast<int>(i % 3)]);
    return all;
}

std::size_t count(const std::string& text, const std::string& part) {
    std::size_t found = 0;
    for (std::size_t at = text.find(part); at != text.npos; at = text.find(part, at + 1))
        ++found;
    return found;
}

} // namespace

TEST_CASE("base64 is that of RFC 4648") {
    for (const auto& [bytes, text] : {std::pair("", ""),
                                      {"f", "Zg=="},
                                      {"fo", "Zm8="},
                                      {"foo", "Zm9v"},
                                      {"foobar", "Zm9vYmFy"}})
        CHECK(hemilux::base64(bytes) == text);
    CHECK(hemilux::base64("\xff\xfe\xfb") == "//77");
}

TEST_CASE("a report has the numbers of the tables") {
    const Workplace place;
    place.write_room();
    REQUIRE(place
                .hemilux("solve room.obj -q --max-edge .1 --steps 3 -o a.csv --report a.html "
                         "--stats a.json --camera 1,2,3,4,5,6,70")
                .code == 0);
    const std::string page = place.read("a.html");
    const hemilux::PatchTable table = hemilux::read_patch_table(place.path("a.csv").string());
    const std::size_t patches = table.area.size();
    const std::vector<float> area = floats_of(page, "area");
    REQUIRE(area.size() == patches);
    for (std::size_t i = 0; i < patches; ++i)
        CHECK(area[i] == static_cast<float>(table.area[i]));
    CHECK(same(floats_of(page, "radiosity"), table.radiosity));
    CHECK(same(floats_of(page, "error"), table.standard_error));

    const std::vector<std::uint32_t> corners = words_of(page, "corners");
    const std::vector<float> position = floats_of(page, "position");
    const Json run = Json::parse(element_of(page, "run"));
    REQUIRE(corners.size() == 4 * patches);
    REQUIRE(floats_of(page, "light").size() == position.size());
    for (std::size_t i = 0; i < patches; ++i) // quads of a grid: their corners' mean is the centre
        for (std::size_t axis = 0; axis < 3; ++axis) {
            double mean = run["centre"][axis];
            for (std::size_t c = 0; c < 4; ++c)
                mean += double(position.at(3 * corners[4 * i + c] + axis)) / 4;
            CHECK(mean == Approx(table.centre[i][static_cast<int>(axis)]).margin(1e-6));
        }

    CHECK(run["scene"] == "room.obj");
    CHECK_THAT(run["command"].get<std::string>(), Contains("--max-edge .1"));
    CHECK(run["camera"]["eye"] == Json({1, 2, 3}));
    CHECK(run["camera"]["fov"] == 70);
    CHECK(run["steps"].size() == 3);
    CHECK_THAT(run["charts"][0]["svg"].get<std::string>(),
               Contains(">estimated error, step 3: ") && !Contains("true error"));
    const Json statistics = Json::parse(place.read("a.json"));
    CHECK(run["statistics"]["estimated_error"] == statistics["estimated_error"]);
    CHECK(run["steps"][2]["rays"] == statistics["rays_energy"]);
    for (const auto& [list, index] : {std::pair("materials", "material"), {"groups", "group"}}) {
        const std::vector<std::uint32_t> numbers = words_of(page, index);
        REQUIRE(numbers.size() == patches);
        CHECK(*std::ranges::max_element(numbers) < run[list].size());
    }
}

TEST_CASE("a report is the same for any number of threads, but for its times") {
    const Workplace place;
    place.write_room();
    const std::string common = "solve room.obj -q --max-edge .2 --steps 2 ";
    REQUIRE(place.hemilux(common + "-t 1 --report a.html").code == 0);
    REQUIRE(place.hemilux(common + "-t 3 --report b.html").code == 0);
    const std::string a = place.read("a.html"), b = place.read("b.html");
    for (const char* const id : {"position", "light", "corners", "radiosity", "error", "hits"}) {
        CAPTURE(id);
        CHECK(!element_of(a, id).empty());
        CHECK(element_of(a, id) == element_of(b, id));
    }
}

TEST_CASE("a report of a method that is guided by densities has them") {
    const Workplace place;
    place.write_room();
    REQUIRE(place.hemilux("solve room.obj -q --steps 1 --method hemisphere --report a.html").code ==
            0);
    const std::string page = place.read("a.html");
    const std::size_t patches = floats_of(page, "area").size(), vertices = 41; // of depth 2
    CHECK(floats_of(page, "vertices").size() == 3 * vertices);
    const std::string counts = test::from_base64(element_of(page, "counts"));
    REQUIRE(counts.size() == patches * vertices);
    // A closed room without a thing in it has one surface in every direction, and all is divided.
    CHECK(counts == std::string(counts.size(), 1));
    double shares = 0;
    for (const float share : floats_of(page, "shares"))
        shares += double(share);
    CHECK(shares == Approx(3)); // of each level
    REQUIRE(place.hemilux("solve room.obj -q --steps 1 --method stratified --report b.html").code ==
            0);
    CHECK(element_of(place.read("b.html"), "counts").empty());
}

TEST_CASE("no name of a file breaks a report") {
    const Workplace place;
    const std::string name = "</script><script>alert(1)</script>\"'&lt;<!--<script>";
    place.write("x.mtl", "newmtl " + name + "\nKd .5 .5 .5\nKe 1 1 1\nnewmtl \xff\nKd 0 0 0\n");
    place.write("x.obj", "mtllib x.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\ng " + name +
                             "\nusemtl " + name + "\nf 1 2 3\nusemtl \xff\nf 1 3 4\n");
    REQUIRE(place.hemilux("solve x.obj -q --steps 2 --report a.html").code == 0);
    const std::string page = place.read("a.html");
    CHECK(count(page, "<script") == count(page, "</script>"));
    CHECK(page.find("alert(1)</") == page.npos);
    const std::string json = element_of(page, "run");
    CHECK(json.find('<') == json.npos);
    const Json run = Json::parse(json);
    CHECK(run["materials"][0]["name"] == name);
    CHECK(run["materials"][1]["name"] == "\xef\xbf\xbd"); // U+FFFD
    CHECK(run["groups"].back() == name);
}

TEST_CASE("warnings stand in a report, and unknown errors are null") {
    const Workplace place;
    place.write_room();
    REQUIRE(place
                .hemilux("solve room.obj -q --error 1e-9 --max-rays 1000 --rays 1 "
                         "--method progressive-monte-carlo --report a.html")
                .code == 0);
    const Json run = Json::parse(element_of(place.read("a.html"), "run"));
    CHECK_THAT(run["warnings"].dump(), Contains("the run ended before the error of"));
    CHECK(run["steps"][0]["estimated_error"].is_null());
}

TEST_CASE("a report of an interrupted run says so") {
    const Workplace place;
    place.write_room();
    test::Running run(place, "solve room.obj --steps 4000000000 -v --report a.html",
                      place.path("stderr.txt").c_str());
    REQUIRE(test::wait_for(place, "stderr.txt", "step 2:"));
    run.interrupt();
    CHECK(run.wait() == 130);
    const Json json = Json::parse(element_of(place.read("a.html"), "run"));
    CHECK_THAT(json["warnings"].back().get<std::string>(),
               Contains("the run was interrupted after " + json["statistics"]["steps"].dump()));
}

TEST_CASE("--report takes a file name that ends with .html and is no other file of the run") {
    const Workplace place;
    place.write_room();
    test::check_fails(place, 1, "solve room.obj --report a.txt",
                      "--report: expected a file name that ends with .html");
    test::check_fails(place, 1, "solve room.obj --report a.html --stats a.html", "are one file");
    std::filesystem::create_symlink("room.obj", place.path("room.html"));
    test::check_fails(place, 1, "solve room.obj --report room.html", "are one file");
    CHECK(place.hemilux("solve room.obj --report none/a.html").code == 3);
}
