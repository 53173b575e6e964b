// `hemilux compare --report`: the page has the numbers of the table, and the light of the methods.
#include "app/check_fails.h"
#include "app/report/half_light.h"
#include "app/report/read_report.h"
#include "app/split.h"
#include "io/results/tables.h"
#include "support/catch.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <string>
#include <vector>

using Catch::Contains;
using test::element_of;
using test::floats_of;
using test::words_of;
using test::Workplace;

using Json = nlohmann::json;

namespace {

/// The text of a field of the CSV as a number of JSON; an empty one as null.
Json json_of(const std::string& field) { return field.empty() ? Json() : Json(std::stod(field)); }

} // namespace

TEST_CASE("halves are the nearest numbers of binary16") {
    using hemilux::half_of;
    for (const auto& [value, half] : {std::pair(0.0, 0),
                                      {1.0, 0x3c00},
                                      {-2.0, 0xc000},
                                      {1 + 0x1p-10, 0x3c01},
                                      {1 + 0x1p-11, 0x3c00}, // in the middle: to the even one
                                      {1 + 0x3p-11, 0x3c02},
                                      {0x1p-24, 1},
                                      {0x3p-26, 1},
                                      {65504.0, 0x7bff},
                                      {1e300, 0x7bff},
                                      {std::nan(""), 0}})
        CHECK(half_of(value) == half);
}

TEST_CASE("the page of a comparison has the numbers of its CSV, and light after steps 1, 2, 4...") {
    const Workplace place;
    place.write_room();
    REQUIRE(
        place
            .hemilux("compare room.obj -q -o a --methods stratified,stored-transport --runs 2 "
                     "--rays 4 --budget-rays 4000 --reference-error .05 --size 8x8 --max-edge .5 "
                     "--report a.html")
            .code == 0);
    const std::string page = place.read("a.html");
    const Json run = Json::parse(element_of(page, "run"));
    const auto csv = test::split(place.read("a/error.csv"), ',');
    REQUIRE(run["rows"].size() + 1 == csv.size());
    CHECK(run["columns"] == Json(csv[0]));
    std::vector<std::size_t> steps(2);
    for (std::size_t i = 1; i < csv.size(); ++i) {
        const Json& row = run["rows"][i - 1];
        CHECK(row[0] == csv[i][0]);
        for (std::size_t k = 1; k < row.size(); ++k)
            CHECK(row[k] == json_of(k < csv[i].size() ? csv[i][k] : ""));
        if (row[1] == 0)
            steps[row[0] == "stratified" ? 0 : 1] = row[2];
    }
    const std::size_t patches = floats_of(page, "area").size();
    for (std::size_t m = 0; m < 2; ++m) {
        std::vector<std::size_t> kept;
        for (std::size_t step = 1; step < steps[m]; step *= 2)
            kept.push_back(step);
        kept.push_back(steps[m]);
        CHECK(run["methods"][m]["steps"] == Json(kept));
        for (std::size_t k = 0; k < kept.size(); ++k)
            CHECK(words_of(page, "light-" + std::to_string(m) + "-" + std::to_string(k)).size() ==
                  3 * patches / 2);
    }
    const hemilux::PatchTable reference =
        hemilux::read_patch_table(place.path("a/reference.csv").string());
    const std::vector<std::uint32_t> pairs = words_of(page, "reference");
    const double unit = run["unit"];
    for (std::size_t i = 0; i < 3 * patches; ++i)
        CHECK((pairs[i / 2] >> (16 * (i % 2)) & 0xffff) ==
              hemilux::half_of(reference.radiosity[i / 3][static_cast<int>(i % 3)] / unit));
    CHECK(run["summary"][1][0] == "stratified");
    REQUIRE(run["charts"].size() >= 2);
    CHECK(run["charts"][0]["name"] == "true error");
    CHECK(run["charts"][1]["name"] == "estimated error");
    CHECK_THAT(run["charts"][0]["svg"].get<std::string>(),
               Contains(">stored-transport, step 1: ") && Contains("class=\"curve0 step2\""));
    CHECK_THAT(run["warnings"].dump(), Contains("the reference's own error"));
}

TEST_CASE(
    "compare --report takes a file name that ends with .html and replaces no file that is read") {
    const Workplace place;
    place.write_room();
    test::check_fails(place, 1, "compare room.obj -o a --report a.txt",
                      "--report: expected a file name that ends with .html");
    CHECK(place.hemilux("compare room.obj -o a --report none/a.html").code == 3);
}
