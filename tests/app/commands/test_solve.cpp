// What `hemilux solve` and `hemilux info` write and say.
#include "app/check_fails.h"
#include "app/program.h"
#include "app/split.h"
#include "app/statistics_file.h"
#include "io/results/tables.h"
#include "support/catch.h"

#include <algorithm>
#include <sstream>

using Catch::Contains;
using test::lines_of;
using test::Workplace;

TEST_CASE("each output appears, whole and by its extension") {
    const Workplace place;
    place.write_room();
    const auto outcome = place.hemilux("solve room.obj --method hemisphere --steps 3 --size 40x30 "
                                       "--max-edge .3 -o p.png -o p.hdr -o p.ply -o p.csv "
                                       "-o p.json --stats s.json --steps-log steps.csv");
    REQUIRE(outcome.code == 0);
    CHECK(outcome.out.empty());
    CHECK(place.read("p.png").substr(1, 3) == "PNG");
    CHECK(place.read("p.hdr").rfind("#?RADIANCE", 0) == 0);
    CHECK(place.read("p.ply").rfind("ply\n", 0) == 0);
    CHECK_THAT(place.read("p.json"), Contains("\"patches\": 96") && Contains("\"faces\": 24") &&
                                         Contains("\"steps\": 3"));
    CHECK(place.read("p.json") == place.read("s.json"));
    CHECK(lines_of(place.read("p.csv")).size() == 97);

    const auto steps = lines_of(place.read("steps.csv"));
    REQUIRE(steps.size() == 4);
    CHECK(steps[0] == "method,run,step,rays,seconds,estimated_error,true_error,true_error_detail,"
                      "true_error_rest,total_error");
    CHECK(steps[3].rfind("hemisphere,0,3,", 0) == 0);
    CHECK(steps[3].ends_with(",,,,")); // no reference, no true errors
    for (const char* text : {"hemisphere: 96 patches, 3 steps", "rays/s", "estimated error",
                             "balance", "wrote p.png", "wrote steps.csv"})
        CHECK_THAT(outcome.err, Contains(text));
    CHECK_THAT(outcome.err, !Contains("\r")); // no bar where there is no terminal
}

TEST_CASE("-q is silent and -v tells of every step") {
    const Workplace place;
    place.write_room();
    CHECK(place.hemilux("solve room.obj --steps 2 -q -o a.csv").err.empty());
    const std::string printed = place.hemilux("solve room.obj --steps 2 -v -o a.csv").err;
    for (const char* text : {"24 patches", "BVH:", "step 1: ", "step 2: ", "memory:"})
        CHECK_THAT(printed, Contains(text));
}

TEST_CASE("the same seed gives the same bytes whatever the number of threads", "[slow]") {
    const Workplace place;
    place.write_room();
    const std::string common = "solve room.obj --max-edge .2 --steps 3 --size 64x48 -q " +
                               test::camera_in_room + "--seed ";
    for (const std::string method : {"hemisphere", "stratified", "progressive-monte-carlo"}) {
        const std::string options = " --method " + method;
        REQUIRE(
            place.hemilux(common + "7 -t 1 -o 1.csv -o 1.ply -o 1.png -o 1.hdr" + options).code ==
            0);
        REQUIRE(
            place.hemilux(common + "7 -t 2 -o 2.csv -o 2.ply -o 2.png -o 2.hdr" + options).code ==
            0);
        REQUIRE(place.hemilux(common + "8 -t 2 -o 3.csv" + options).code == 0);
        for (const std::string kind : {".csv", ".ply", ".png", ".hdr"}) {
            CAPTURE(method, kind);
            CHECK(place.read("1" + kind) == place.read("2" + kind));
        }
        CHECK(place.read("1.csv") != place.read("3.csv"));
    }
}

TEST_CASE("a reference gives true errors, apart for the detail groups") {
    const Workplace place;
    place.write_room();
    REQUIRE(place.hemilux("solve room.obj --method matrix --error .02 -q -o reference.csv").code ==
            0);
    const auto outcome = place.hemilux(
        "solve room.obj --steps 8 --rays 500 --reference reference.csv --steps-log steps.csv");
    REQUIRE(outcome.code == 0);
    CHECK_THAT(outcome.err, Contains("true error") && Contains("detail") && Contains("z-scores"));
    for (const std::string& row : lines_of(place.read("steps.csv")))
        CHECK(std::count(row.begin(), row.end(), ',') == 9);
    const std::string last = lines_of(place.read("steps.csv")).back();
    std::vector<double> fields;
    std::istringstream stream(last);
    for (std::string field; std::getline(stream, field, ',');)
        fields.push_back(fields.empty() ? 0 : std::stod(field));
    REQUIRE(fields.size() == 9);
    // 4000 rays per patch on 24 patches: well below 5 %.
    for (std::size_t i = 5; i < 9; ++i) {
        CHECK(fields[i] > 0);
        CHECK(fields[i] < 0.05);
    }
    const auto named = place.hemilux("solve room.obj --steps 2 --reference reference.csv "
                                     "--detail walls --detail lamp -o a.csv");
    CHECK_THAT(named.err, Contains("(detail "));
}

TEST_CASE("the run stops at the first rule that is met") {
    const Workplace place;
    place.write_room();
    REQUIRE(place.hemilux("solve room.obj --error .2 --steps 1000 -q -o a.json").code == 0);
    CHECK_THAT(place.read("a.json"), !Contains("\"steps\": 1000,"));
    REQUIRE(place.hemilux("solve room.obj --time .2 --error 1e-9 -q -o a.json").code == 0);
    REQUIRE(place.hemilux("solve room.obj --error 1e-9 --steps 2 -q -o a.json").code == 0);
    CHECK_THAT(place.read("a.json"), Contains("\"steps\": 2,"));
    // Nothing reflects, so that there is no error to wait for.
    REQUIRE(place.hemilux("solve room.obj --error .01 --reflectance '*=0' -q -o a.json").code == 0);
}

TEST_CASE("the command line changes materials") {
    const Workplace place;
    place.write_room();
    REQUIRE(place
                .hemilux("solve room.obj --steps 1 -q -o a.csv --reflectance '*=.25' "
                         "--reflectance red=.1,.2,.3 --emission lamp=5")
                .code == 0);
    const std::string table = place.read("a.csv");
    CHECK_THAT(table, Contains(",0.25,0.25,0.25,0,0,0,"));
    CHECK_THAT(table, Contains(",red,") && Contains(",0.1,0.2,0.3,0,0,0,"));
    CHECK_THAT(table, Contains(",0.25,0.25,0.25,5,5,5,"));
}

TEST_CASE("--two-sided gives each face two patches") {
    const Workplace place;
    place.write_room();
    REQUIRE(place.hemilux("solve room.obj --two-sided --steps 1 -q -o a.csv").code == 0);
    CHECK(lines_of(place.read("a.csv")).size() == 49);
}

TEST_CASE("warnings of the reader are shown, but not without end") {
    const Workplace place;
    std::string scene = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";
    for (int i = 0; i < 30; ++i)
        scene += "f 1 1 2\n";
    place.write("flat.obj", scene);
    const auto outcome = place.hemilux("solve flat.obj --emission default=1 --steps 1 -o a.csv");
    CHECK(outcome.code == 0);
    CHECK_THAT(outcome.err, Contains("warning: "));
    CHECK(lines_of(outcome.err).size() < 20);
}

TEST_CASE("info describes a scene on stdout") {
    const Workplace place;
    place.write_room();
    const auto outcome = place.hemilux("info room.obj");
    CHECK(outcome.code == 0);
    CHECK(outcome.err.empty());
    for (const char* text : {"faces", "24", "quads", "total area", "emitted power", "lamp"})
        CHECK_THAT(outcome.out, Contains(text));
    // What solve refuses is shown, not refused.
    CHECK(place.hemilux("info room.obj --emission '*=0'").code == 0);
    CHECK_THAT(place.hemilux("info room.obj --max-edge .3").out, Contains("96"));
}

TEST_CASE("info says how much the light differs within patches, where it can be known") {
    const Workplace place;
    place.write_room();
    const auto within = [&](const std::string& options) {
        const std::string text = place.hemilux("info room.obj --json " + options).out;
        return text.substr(text.find("\"error_division\": "));
    };
    const auto number = [](const std::string& text) {
        return std::stod(text.substr(text.find(' ')));
    };
    CHECK(number(within("--max-edge .1")) < number(within("")));
    CHECK(number(within("")) > .05);
    CHECK_THAT(place.hemilux("info room.obj").out, Contains("within patches"));
    CHECK_THAT(within("--emission '*=0'"), Contains("null"));
}

TEST_CASE("a picture after every step shows one view as it gets brighter") {
    const Workplace place;
    place.write_room();
    const auto outcome = place.hemilux("solve room.obj --method progressive --one-shot --steps 3 "
                                       "--every-step --no-gather --size 40x30 -o p.png -o p.hdr "
                                       "-o p.csv");
    REQUIRE(outcome.code == 0);
    for (const char* name : {"p-0001.png", "p-0002.png", "p-0003.png", "p-0003.hdr", "p.png"})
        CHECK(place.has(name));
    CHECK_FALSE(place.has("p-0004.png"));
    CHECK_FALSE(place.has("p-0001.csv"));
    CHECK(place.read("p-0001.hdr") != place.read("p-0003.hdr"));
    CHECK(place.read("p-0003.hdr") == place.read("p.hdr"));
    CHECK_THAT(outcome.err, Contains("wrote p-0002.png"));
}

TEST_CASE("monte-carlo shows a picture each time a patch has shot, until all is shot") {
    const Workplace place;
    place.write_room();
    const std::string run =
        "solve room.obj --method monte-carlo --rays 4 -q " + test::camera_in_room;
    REQUIRE(place
                .hemilux(run + "--one-shot --every-step --no-gather --size 20x15 -o p.png "
                               "-o shots.csv --stats s.json")
                .code == 0);
    CHECK(place.has("p-0001.png"));
    CHECK(place.has("p-0020.png")); // more than the usual steps of a method
    CHECK(place.read("p-0001.png") != place.read("p-0020.png"));
    CHECK_THAT(place.read("s.json"), Contains("\"estimated_error\": null"));
    REQUIRE(place.hemilux(run + "--steps 1 -o whole.csv").code == 0);
    CHECK(place.read("shots.csv") == place.read("whole.csv"));
    test::check_fails(place, 1, run + "--one-shot --plain -o a.csv", "leave out --one-shot");
    test::check_fails(place, 1, run + "--one-shot --checkpoint a -o a.csv",
                      "--one-shot does not keep its state");
}

TEST_CASE("what a method alone can do is asked of that method alone") {
    const Workplace place;
    place.write_room();
    // In an empty box all factors are known: one step, and no error is left.
    REQUIRE(place.hemilux("solve room.obj --method matrix --exact -q -o a.json").code == 0);
    CHECK_THAT(place.read("a.json"), Contains("\"steps\": 1,"));
    CHECK(place
              .hemilux("solve room.obj --method progressive --ambient --overshoot --one-shot "
                       "--steps 4 -q -o a.json")
              .code == 0);
    for (const std::string option : {"--exact", "--one-shot", "--ambient", "--overshoot"}) {
        const auto outcome = place.hemilux("solve room.obj -o b.json " + option);
        CHECK(outcome.code == 1);
        CHECK_THAT(outcome.err, Contains(option + " is for --method "));
    }
    CHECK(place.hemilux("solve room.obj --every-step -o b.json").code == 1);
    CHECK_FALSE(place.has("b.json"));
}

TEST_CASE("with hemicubes the summary says that their error is not estimated") {
    const Workplace place;
    place.write_room();
    for (const std::string method : {"matrix", "progressive"}) {
        const auto outcome = place.hemilux("solve room.obj --factors hemicube:16 --method " +
                                           method + " -o a.csv -o a.json");
        REQUIRE(outcome.code == 0);
        CHECK_THAT(outcome.err, Contains("estimated error unknown"));
        CHECK_THAT(outcome.err, Contains("the error of hemicube factors is not estimated"));
        CHECK_THAT(place.read("a.csv"), Contains(",nan,nan,nan\n"));
        CHECK_THAT(place.read("a.json"), Contains("\"estimated_error\": null"));
    }
    const auto refused = [&](const std::string& arguments, const std::string& message) {
        const auto outcome = place.hemilux("solve room.obj -o b.json " + arguments);
        CHECK(outcome.code == 1);
        CHECK_THAT(outcome.err, Contains(message));
    };
    refused("--factors hemicube", "--factors hemicube is for --method matrix or progressive");
    refused("--method progressive --factors exact", "--exact is for --method matrix");
    refused("--method matrix --factors hemicube:31", "an even N from 2 to 1024");
    CHECK_FALSE(place.has("b.json"));
}

TEST_CASE("an option that changes nothing in a run gets a warning", "[slow]") {
    const Workplace place;
    place.write_room();
    const auto warned = [&](const std::string& command, const std::string& option) {
        const auto outcome = place.hemilux(command + " " + option);
        CAPTURE(command, option);
        CHECK(outcome.code == 0);
        return outcome.err.find("warning: " + option.substr(0, option.find(' ')) +
                                " changes nothing in this run; it is for ") != std::string::npos;
    };
    const std::string solve = "solve room.obj --steps 1 --method monte-carlo -o a.csv";
    for (const std::string option :
         {"--literal", "--depth 1", "--threshold 1", "--detail walls", "--bake irradiance",
          "--ply-colours shown", "--camera auto", "--size 8x6", "--exposure 2", "--tone srgb",
          "--gather 4", "--no-gather"}) {
        CHECK(warned(solve, option));
        CHECK(place.hemilux(solve + " -q " + option).err.empty());
    }
    const std::string all = "solve room.obj --steps 1 --method hemisphere -o a.ply -o a.png " +
                            test::camera_in_room + "--reference a.csv";
    for (const std::string option : {"--literal", "--depth 1", "--threshold 1", "--detail walls",
                                     "--bake irradiance", "--ply-colours shown", "--size 8x6",
                                     "--exposure 2", "--tone srgb", "--gather 4", "--no-gather"})
        CHECK_FALSE(warned(all + (option == "--size 8x6" ? "" : " --size 9x6"), option));
    CHECK(warned(all + " --size 9x6 --no-gather", "--gather 4"));
    CHECK_FALSE(warned("solve room.obj --steps 1 --method stratified -o a.csv", "--depth 1"));
    CHECK(warned("compare room.obj --methods stratified --runs 1 --budget-rays 1e3 --size 8x6 "
                 "--reference a.csv -o c",
                 "--literal"));
    CHECK(warned("formfactors room.obj -o a.npy --factors hemicube", "--rays 64"));
    CHECK_FALSE(warned("formfactors room.obj -o a.npy", "--rays 64"));
    CHECK(warned("density room.obj -o a.svg", "--size 200x150"));
    CHECK_FALSE(warned("density room.obj -o a.png", "--size 200x150"));
}

TEST_CASE("stored transport solves, or hemisphere where one of its own options is given") {
    const Workplace place;
    place.write_room();
    const auto method_of = [&](const std::string& arguments) {
        const auto outcome = place.hemilux("solve room.obj --steps 1 -o a.csv " + arguments);
        REQUIRE(outcome.code == 0);
        std::istringstream lines(outcome.err);
        std::string line;
        while (std::getline(lines, line) && line.starts_with("warning:")) // of unused options
            continue;
        return line.substr(0, line.find(':'));
    };
    CHECK(method_of("") == "stored-transport");
    CHECK(method_of("--method gathering") == "stored-transport"); // its former name
    for (const char* option : {"--depth 1", "--threshold 2", "--literal"}) {
        CHECK(method_of(option) == "hemisphere");
        CHECK(method_of(std::string("--method stratified ") + option) == "stratified");
    }
    const auto unasked = place.hemilux("solve room.obj -o a.csv --stats a.json");
    CHECK(unasked.code == 0);
    CHECK_THAT(unasked.err, Contains("stored-transport: ") && Contains("give or take"));
    CHECK_THAT(place.read("a.json"), Contains("\"estimated_error\": 0.0"));
}

TEST_CASE("no more rays are traced than are allowed, and nearly as many") {
    const Workplace place;
    place.write_room();
    for (const std::string limit : {"1e4", "123456", "1e6"}) {
        const auto outcome =
            place.hemilux("solve room.obj --divide none --error .01% -o a.csv --stats s.json "
                          "--max-rays " +
                          limit);
        REQUIRE(outcome.code == 0);
        CHECK_THAT(outcome.err, Contains("--max-rays lets it go on"));
        const double rays = test::statistic(place.read("s.json"), "rays_energy");
        CAPTURE(limit, rays);
        CHECK(rays <= std::stod(limit));
        CHECK(rays > .6 * std::stod(limit));
    }
}
