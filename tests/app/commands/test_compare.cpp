// What `hemilux compare` writes and says.
#include "app/check_fails.h"
#include "app/split.h"
#include "radiosity/engine/solving/method.h"
#include "support/catch.h"

#include <algorithm>
#include <map>
#include <set>
#include <sstream>

using Catch::Contains;
using test::split;
using test::Workplace;

namespace {

const std::string quick = "--reference-error .02 --size 40x30 " + test::camera_in_room;

/// The rows of the table on stdout, by method; a field never has two blanks side by side.
std::map<std::string, std::vector<std::string>> table_of(const std::string& out) {
    std::map<std::string, std::vector<std::string>> table;
    for (const auto& words : split(out, ' ')) {
        std::vector<std::string> fields;
        bool open = false;
        for (const std::string& word : words) {
            if (!word.empty() && open)
                fields.back() += " " + word;
            else if (!word.empty())
                fields.push_back(word);
            open = !word.empty();
        }
        table[fields.front()] = fields;
    }
    return table;
}

} // namespace

TEST_CASE("a comparison leaves a log, a chart, pictures and a table") {
    const Workplace place;
    place.write_room();
    const auto outcome =
        place.hemilux("compare room.obj -o deep/compared --methods hemisphere,progressive-monte-"
                      "carlo --runs 2 --rays 100 --budget-rays 48000 " +
                      quick);
    REQUIRE(outcome.code == 0);
    for (const char* file :
         {"error.csv", "error.svg", "reference.csv", "reference.png", "hemisphere.png",
          "hemisphere_difference.png", "progressive-monte-carlo.png",
          "progressive-monte-carlo_difference.png"}) {
        CHECK(place.has(std::string("deep/compared/") + file));
        CHECK_THAT(outcome.err, Contains(std::string("wrote deep/compared/") + file));
    }
    CHECK_THAT(place.read("deep/compared/error.svg"),
               Contains("hemisphere") && Contains("slope -1/2"));
    // Width and height in the header of a PNG (big endian).
    CHECK(place.read("deep/compared/hemisphere.png").substr(16, 8) ==
          std::string("\0\0\0\x28\0\0\0\x1e", 8));

    const std::string log = place.read("deep/compared/error.csv");
    CHECK(log.rfind("method,run,step,rays,seconds,estimated_error,true_error,true_error_detail,"
                    "true_error_rest,total_error\n",
                    0) == 0);
    std::map<std::string, int> steps;
    std::map<std::string, double> last_rays;
    for (const auto& row : split(log, ',')) {
        if (row[0] == "method")
            continue;
        REQUIRE(row.size() == 9); // the last field is empty: no --total
        const std::string run = row[0] + row[1];
        CHECK(std::stoi(row[2]) == ++steps[run]);
        CHECK(std::stod(row[3]) > last_rays[run]);
        last_rays[run] = std::stod(row[3]);
        CHECK(std::stod(row[6]) > 0);
    }
    CHECK(steps.size() == 4);
    for (const auto& [run, rays] : last_rays)
        CHECK(rays == Approx(48000).epsilon(0.04)); // half a step

    const auto table = table_of(outcome.out);
    REQUIRE(table.size() == 3);
    CHECK(table.at("method") == std::vector<std::string>{"method", "rays", "seconds", "error %",
                                                         "detail %", "rest %", "estimated %",
                                                         "estimated/error", "time gain", "ray gain",
                                                         "density bytes"});
    CHECK(table.at("progressive-monte-carlo")[8] == "1.00");
    CHECK(table.at("progressive-monte-carlo")[9] == "1.00");
    CHECK(table.at("progressive-monte-carlo")[10] == "-");
    CHECK(table.at("hemisphere")[10] == "-"); // a convex room needs no densities
    for (const std::size_t gain : {8u, 9u}) {
        double times = 0, error = 0;
        REQUIRE(std::sscanf(table.at("hemisphere")[gain].c_str(), "%lf +- %lf", &times, &error) ==
                2);
        CHECK(times > 0);
        CHECK(error >= 0);
    }
    CHECK_THAT(outcome.err, Contains("+-: standard error of the gain, from the spread of 2 runs"));
    // 2000 rays per patch on 24 patches.
    for (const char* method : {"hemisphere", "progressive-monte-carlo"})
        CHECK(std::stod(table.at(method)[3]) < 6);
}

TEST_CASE("--total: methods side by side by the error of the light itself") {
    const Workplace place;
    place.write_room();
    const auto outcome =
        place.hemilux("compare room.obj -o a --total --methods stratified,progressive-monte-carlo "
                      "--runs 2 --rays 100 --budget-rays 48000 " +
                      quick);
    REQUIRE(outcome.code == 0);
    const auto table = table_of(outcome.out);
    CHECK(table.at("method")[3] == "total %");
    CHECK(table.at("method")[4] == "error %");
    for (const char* method : {"stratified", "progressive-monte-carlo"})
        CHECK(std::stod(table.at(method)[3]) > std::stod(table.at(method)[4]));
    CHECK_THAT(place.read("a/error.svg"), Contains("error of the light itself"));
    for (const auto& row : split(place.read("a/error.csv"), ','))
        if (row[0] != "method")
            CHECK(std::stod(row[9]) > std::stod(row[6]));
}

TEST_CASE("a method is compared with itself by other options") {
    const Workplace place;
    place.write_room();
    const auto outcome = place.hemilux(
        "compare room.obj -o a --methods hemisphere:depth=1,hemisphere:depth=3:threshold=2,"
        "progressive-monte-carlo:rays=16 --runs 1 --budget-rays 20000 " +
        quick);
    CAPTURE(outcome.err);
    REQUIRE(outcome.code == 0);
    const auto table = table_of(outcome.out);
    CHECK(table.at("hemisphere:depth=1")[3] != table.at("hemisphere:depth=3:threshold=2")[3]);
    CHECK(place.has("a/hemisphere-depth-1.png"));
    CHECK(place.has("a/hemisphere-depth-3-threshold-2_difference.png"));
    // The same rows as a run with these options for all.
    REQUIRE(place
                .hemilux("compare room.obj -o b --methods hemisphere --depth 1 --runs 1 "
                         "--budget-rays 20000 --reference a/reference.csv " +
                         quick)
                .code == 0);
    const auto one = split(place.read("a/error.csv"), ','),
               other = split(place.read("b/error.csv"), ',');
    CHECK(one[1][3] == other[1][3]); // rays
    CHECK(one[1][6] == other[1][6]); // true error
    const std::string methods = "compare room.obj -o c --methods ";
    check_fails(place, 1, methods + "hemisphere:dept=2", "did you mean 'depth'");
    check_fails(place, 1, methods + "hemisphere:depth=9", "takes no depth=9");
    check_fails(place, 1, methods + "hemispher:depth=2", "did you mean 'hemisphere'");
    check_fails(place, 1, methods + "hemisphere:depth=2,hemisphere:depth=2", "named twice");
    check_fails(place, 1, methods + "progressive:depth=2", "unknown option 'depth'");
}

TEST_CASE("runs end at an equal error, and relMSE is told where it is asked for") {
    const Workplace place;
    place.write_room();
    const auto outcome = place.hemilux(
        "compare room.obj -o a --methods stratified,progressive-monte-carlo --runs 2 --rays 100 "
        "--budget-error 5% --relative-mse " +
        quick);
    CAPTURE(outcome.err);
    REQUIRE(outcome.code == 0);
    const auto table = table_of(outcome.out);
    CHECK(table.at("method")[3] == "relMSE");
    const auto rows = split(place.read("a/error.csv"), ',');
    for (std::size_t k = 1; k < rows.size(); ++k) {
        const bool is_last =
            k + 1 == rows.size() || rows[k + 1][0] != rows[k][0] || rows[k + 1][1] != rows[k][1];
        CHECK((std::stod(rows[k][6]) <= .05) == is_last);
    }
    for (const char* method : {"stratified", "progressive-monte-carlo"}) {
        CHECK(std::stod(table.at(method)[4]) <= 5);
        // Of even light relMSE is about the square of the error.
        const double error = std::stod(table.at(method)[4]) / 100;
        CHECK(std::stod(table.at(method)[3]) > .1 * error * error);
        CHECK(std::stod(table.at(method)[3]) < 10 * error * error);
    }
    check_fails(place, 1, "compare room.obj -o b --budget-error 5% --budget-time 3", "--budget");
}

TEST_CASE("the uncertainty of a gain from one run is unknown") {
    const Workplace place;
    place.write_room();
    const auto outcome =
        place.hemilux("compare room.obj -o a --methods stratified,progressive-monte-carlo "
                      "--runs 1 --rays 20 --budget-rays 20000 " +
                      quick);
    REQUIRE(outcome.code == 0);
    const auto table = table_of(outcome.out);
    CHECK_THAT(table.at("stratified")[9], Catch::EndsWith(" +- ?"));
    CHECK(table.at("progressive-monte-carlo")[9] == "1.00");
    CHECK_THAT(outcome.err, Contains("gains are from one run: uncertainty unknown"));
}

TEST_CASE("by default stored transport and all unbiased methods are compared, by rays") {
    const Workplace place;
    place.write_room();
    const auto outcome = place.hemilux("compare room.obj -o a --runs 1 --rays 4 -q " + quick);
    REQUIRE(outcome.code == 0);
    CHECK(outcome.err.empty());
    const auto table = table_of(outcome.out);
    std::size_t expected = 0;
    for (const hemilux::Method* const method : hemilux::methods()) {
        const bool compared = method->unbiased || method->name == "stored-transport";
        CHECK(table.contains(std::string(method->name)) == compared);
        expected += compared;
    }
    CHECK(table.size() == expected + 1);
}

TEST_CASE("a comparison labels a method as the user called it") {
    const Workplace place;
    place.write_room();
    const auto outcome =
        place.hemilux("compare room.obj -o a --methods gathering --runs 1 --rays 4 " + quick);
    REQUIRE(outcome.code == 0);
    CHECK(table_of(outcome.out).contains("gathering"));
    CHECK(place.has("a/gathering.png"));
}

TEST_CASE("the reference that was computed serves again, and steps do not depend on threads") {
    const Workplace place;
    place.write_room();
    const std::string common =
        "compare room.obj --methods stratified,matrix --runs 2 --rays 30 --budget-rays 20000 -v " +
        quick;
    const auto first = place.hemilux(common + "-o a -t 1");
    REQUIRE(first.code == 0);
    CHECK_THAT(first.err, Contains("reference, step 1:") && Contains("stratified, run 2, step 1:"));
    const std::string table = place.read("a/reference.csv");
    const auto again = place.hemilux(common + "-o a --reference a/reference.csv -t 2");
    REQUIRE(again.code == 0);
    CHECK_THAT(again.err, !Contains("reference, step 1:") && !Contains("wrote a/reference.csv"));
    CHECK(place.read("a/reference.csv") == table);
    CHECK(table_of(again.out).at("stratified")[8] == "-"); // there is no base method
    // The runs have seeds of their own, and the reference has none of them.
    std::set<std::string> errors;
    const auto rows = split(place.read("a/error.csv"), ',');
    for (std::size_t i = 1; i < rows.size(); ++i)
        errors.insert(rows[i][6]);
    CHECK(errors.size() == rows.size() - 1);
    CHECK(errors.count("0") == 0);

    REQUIRE(place.hemilux(common + "-o b --reference a/reference.csv -t 1").code == 0);
    CHECK(place.read("b/stratified.png") == place.read("a/stratified.png"));
    CHECK(place.read("b/stratified_difference.png") == place.read("a/stratified_difference.png"));
}

TEST_CASE("a budget of time ends within half a step of it for every method") {
    const Workplace place;
    place.write_room();
    REQUIRE(place
                .hemilux("compare room.obj -o a --methods hemisphere,stratified --runs 1 --rays 50 "
                         "--budget-time .2 " +
                         quick)
                .code == 0);
    std::map<std::string, std::vector<double>> times{{"hemisphere", {0}}, {"stratified", {0}}};
    for (const auto& row : split(place.read("a/error.csv"), ','))
        if (row[0] != "method")
            times.at(row[0]).push_back(std::stod(row[4]));
    for (const auto& [method, seconds] : times) {
        CAPTURE(method, seconds);
        REQUIRE(seconds.size() > 1);
        const double last = seconds.back(), before = *(seconds.end() - 2);
        // Steps grow to at most twice the one before, so half a step is at most the last one.
        CHECK(before < 0.2);
        CHECK(last + (last - before) > 0.2);
    }
}

TEST_CASE("--literal goes to the methods that have it, and shows") {
    const Workplace place;
    place.write_room();
    const auto outcome = place.hemilux("compare room.obj -o a --methods hemisphere,stratified "
                                       "--runs 1 --literal --budget-rays 100000 " +
                                       quick);
    REQUIRE(outcome.code == 0);
    const auto table = table_of(outcome.out);
    REQUIRE(table.contains("hemisphere (literal)"));
    CHECK(std::stod(table.at("hemisphere (literal)")[3]) > 10);
    CHECK(std::stod(table.at("stratified")[3]) < 5);
}

TEST_CASE("a scene that reflects nothing has no error, and says so by dashes") {
    const Workplace place;
    place.write_room();
    const auto outcome =
        place.hemilux("compare room.obj -o a --methods stratified --runs 1 --rays 4 "
                      "--budget-rays 1000 --reflectance '*=0' " +
                      quick);
    CHECK(outcome.code == 0);
    CHECK(table_of(outcome.out).at("stratified")[3] == "-");
}

TEST_CASE("what cannot be compared is refused before any work") {
    const Workplace place;
    place.write_room();
    check_fails(place, 1, "compare room.obj -o a --methods hemisfere",
                "did you mean 'hemisphere'?");
    check_fails(place, 1, "compare room.obj -o a --methods hemisphere,stratifed",
                "did you mean 'stratified'?");
    check_fails(place, 1, "compare room.obj -o a --methods matrix,matrix", "named twice");
    check_fails(place, 1, "compare room.obj -o a --methods hemisphere,", "--methods");
    check_fails(place, 1, "compare room.obj -o a --budget-rays 1e6 --budget-time 3",
                "--budget-time");
    check_fails(place, 1, "compare room.obj -o a --budget-rays 0", "--budget-rays");
    check_fails(place, 1, "compare room.obj -o a --runs 0", "--runs");
    check_fails(place, 1, "compare room.obj -o a --detail wals", "did you mean 'walls'?");
    check_fails(place, 1, "compare room.obj", "output");
    check_fails(place, 2, "compare room.obj -o a --reference none.csv", "none.csv");
    check_fails(place, 2, "compare none.obj -o a", "none.obj");
    check_fails(place, 3, "compare room.obj -o room.mtl", "room.mtl: is a file");
    check_fails(place, 3, "compare room.obj -o room.mtl/a", "room.mtl/a");
    CHECK_FALSE(place.has("a/error.csv"));
}
