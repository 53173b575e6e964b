// --divide, and the error of the light within patches.
#include "app/outputs/results.h"
#include "app/program.h"
#include "app/running.h"
#include "app/statistics_file.h"

#include "support/catch.h"

#include <cstdio>
#include <sstream>
#include <string>

using Catch::Contains;
using test::Running;
using test::statistic;
using test::wait_for;
using test::Workplace;

TEST_CASE("a run on fixed patches reports what sampling and what the division leaves") {
    const Workplace place;
    place.write_room();
    const auto outcome =
        place.hemilux("solve room.obj --divide none --whole-error -o r.csv --stats s.json");
    REQUIRE(outcome.code == 0);
    CHECK_THAT(outcome.err, Contains("of the patches' mean light") &&
                                Contains("within patches the light differs by") &&
                                Contains("--divide auto"));
    const std::string json = place.read("s.json");
    CHECK(statistic(json, "estimated_error") == statistic(json, "error_sampling"));
    CHECK(statistic(json, "error_division") > .05);
    CHECK(statistic(json, "error_division_uncertainty") > 0);
    CHECK(statistic(json, "rays_divide") == 0);
    const auto plain = place.hemilux("solve room.obj -o p.csv --stats s.json");
    CHECK_THAT(plain.err, Contains("--whole-error finds what they leave out"));
    CHECK_THAT(place.read("s.json"), Contains("\"error_division\": null"));
    CHECK(place.read("p.csv") == place.read("r.csv"));
}

TEST_CASE("the error of the division is found where it is shown; tables do not depend on it") {
    hemilux::SolveSettings settings;
    settings.outputs = {{"a.csv", hemilux::OutputKind::csv}};
    CHECK(shows_statistics(settings));
    settings.verbosity = hemilux::Verbosity::quiet;
    settings.steps_log = "steps.csv"; // the errors of steps are those of sampling
    CHECK_FALSE(shows_statistics(settings));
    const auto shown_by = [&](auto change) {
        hemilux::SolveSettings other = settings;
        change(other);
        return shows_statistics(other);
    };
    CHECK(shown_by([](auto& s) { s.statistics = "s.json"; }));
    CHECK(shown_by([](auto& s) { s.report = "page.html"; }));
    CHECK(shown_by([](auto& s) { s.outputs.push_back({"-.json", hemilux::OutputKind::json}); }));

    const Workplace place;
    place.write_room();
    for (const std::string divide : {"none --whole-error", "auto"}) {
        const std::string command = "solve room.obj --error .2 --divide " + divide;
        REQUIRE(place.hemilux(command + " -q -o quiet.csv").code == 0);
        REQUIRE(place.hemilux(command + " -o shown.csv --stats s.json").code == 0);
        CHECK(place.read("quiet.csv") == place.read("shown.csv"));
        CHECK(statistic(place.read("s.json"), "error_division") > 0);
    }
}

TEST_CASE("--divide auto ends near the whole error asked for, with the same bytes for any threads",
          "[slow]") {
    const Workplace place;
    place.write_room();
    const std::string command = "solve room.obj --divide auto --error .1 --seed 3 ";
    const auto outcome = place.hemilux(command + "-t 1 -o 1.csv -o 1.ply -o 1.png --stats s.json");
    REQUIRE(outcome.code == 0);
    REQUIRE(place.hemilux(command + "-t 2 -o 2.csv -o 2.ply -o 2.png -q").code == 0);
    for (const std::string kind : {".csv", ".ply", ".png"})
        CHECK(place.read("1" + kind) == place.read("2" + kind));
    CHECK_THAT(outcome.err, Contains("of the light on the surfaces: sampling"));
    const std::string json = place.read("s.json");
    const double whole = statistic(json, "estimated_error");
    CHECK(whole ==
          Approx(std::hypot(statistic(json, "error_sampling"), statistic(json, "error_division"))));
    CHECK(whole < .15);
    CHECK(statistic(json, "patches") > 24);
    CHECK(statistic(json, "rays_divide") > 0);
}

TEST_CASE("patches get their rays as they are divided, where some faces need none", "[slow]") {
    const Workplace place;
    place.write_room();
    // A bright block whose lower side lies on the floor: no light reaches that.
    place.write("block.mtl", "newmtl bright\nKd .9 .9 .9\n");
    std::string text = place.read("room.obj") + "mtllib block.mtl\nusemtl bright\n";
    const auto side = [&](const std::string& corners) { text += corners + "f -4 -3 -2 -1\n"; };
    side("v .3 .3 0\nv .3 .9 0\nv .9 .9 0\nv .9 .3 0\n");
    side("v .3 .3 .8\nv .9 .3 .8\nv .9 .9 .8\nv .3 .9 .8\n");
    side("v .3 .3 0\nv .9 .3 0\nv .9 .3 .8\nv .3 .3 .8\n");
    side("v .9 .3 0\nv .9 .9 0\nv .9 .9 .8\nv .9 .3 .8\n");
    side("v .9 .9 0\nv .3 .9 0\nv .3 .9 .8\nv .9 .9 .8\n");
    side("v .3 .9 0\nv .3 .3 0\nv .3 .3 .8\nv .3 .9 .8\n");
    place.write("block.obj", text);
    REQUIRE(place.hemilux("solve block.obj --divide auto --error .05 -q -o a.csv --stats s.json")
                .code == 0);
    const std::string json = place.read("s.json");
    CHECK(statistic(json, "patches") > 100);
    CHECK(statistic(json, "estimated_error") <= .05);
    CHECK(statistic(json, "rays_energy") < 3000 * statistic(json, "patches"));
}

TEST_CASE("--divide auto gives out linear functions, with their gradients in the table") {
    const Workplace place;
    place.write_room();
    REQUIRE(place.hemilux("solve room.obj --divide auto --error .1 -q -o a.csv").code == 0);
    REQUIRE(place.hemilux("solve room.obj --divide none -q -o b.csv").code == 0);
    CHECK_THAT(place.read("a.csv"), Contains(",gradient_r_x,gradient_r_y,gradient_r_z,"));
    CHECK(place.read("b.csv").find("gradient") == std::string::npos);
}

TEST_CASE("--divide auto leaves alone what is even: it costs a thousand points") {
    const Workplace place;
    place.write_room();
    const std::string command = "solve room.obj --error .9 -q --seed 2 ";
    REQUIRE(place.hemilux(command + "--divide auto -o a.csv --stats s.json").code == 0);
    CHECK(statistic(place.read("s.json"), "patches") == 24);
    CHECK(place.read("a.csv").find("gradient") == std::string::npos);
}

TEST_CASE("--divide auto goes on until the whole error is as asked for, or says what ended it",
          "[slow]") {
    const Workplace place;
    place.write_room();
    for (const std::string seed : {"1", "2", "3", "4"}) {
        const auto outcome =
            place.hemilux("solve room.obj --divide auto --error .06 --stats s.json "
                          "--seed " +
                          seed);
        REQUIRE(outcome.code == 0);
        CHECK(statistic(place.read("s.json"), "estimated_error") <= .06);
        CHECK_THAT(outcome.err, !Contains("before the whole error"));
    }
    const auto outcome =
        place.hemilux("solve room.obj --divide auto --error .01 --max-rays 5000 --stats s.json");
    REQUIRE(outcome.code == 0);
    CHECK(statistic(place.read("s.json"), "estimated_error") > .01);
    CHECK_THAT(outcome.err, Contains("the run ended before the whole error of 1 % was reached"));
}

TEST_CASE("a run that divides patches can be resumed to the same bytes", "[slow]") {
    const Workplace place;
    place.write_room();
    const std::string command = "solve room.obj --divide auto --error .1 --method hemisphere ";
    REQUIRE(place.hemilux(command + "--steps 6 -q -o whole.csv").code == 0);
    REQUIRE(place.hemilux(command + "--steps 3 -q -o half.csv --checkpoint saved").code == 0);
    REQUIRE(place.hemilux(command + "--steps 6 -q -o resumed.csv --resume saved").code == 0);
    CHECK(place.read("whole.csv") == place.read("resumed.csv"));
    // The default method divides by its own steps, so that all options must be the same.
    const std::string same = "solve room.obj --rays 20 --divide auto --error .03 -q ";
    REQUIRE(place.hemilux(same + "-o whole.csv --checkpoint saved --steps-log 1.csv").code == 0);
    REQUIRE(place.hemilux(same + "-o resumed.csv --resume saved --steps-log 2.csv").code == 0);
    CHECK(place.read("whole.csv") == place.read("resumed.csv"));
    CHECK(place.read("1.csv") == place.read("2.csv"));
}

TEST_CASE("a plain solve divides for meshes, but not in runs that are about patches or steps",
          "[slow]") {
    const Workplace place;
    place.write_room();
    const auto table = [&](const std::string& options) {
        REQUIRE(place.hemilux("solve room.obj -q -o a.csv " + options).code == 0);
        return place.read("a.csv");
    };
    CHECK(table("") == table("--divide none"));
    CHECK(table("-o a.ply") == table("--divide auto"));
    CHECK(table("-o a.ply") != table("--divide none"));
    REQUIRE(place.hemilux("solve room.obj -q --divide none -o fixed.csv").code == 0);
    for (const std::string options :
         {"--steps 2", "--method hemisphere --steps 2", "--reference fixed.csv",
          "--for camera --camera .5,.5,.5,0,.5,.5", "--checkpoint saved", "--plain --steps 2"})
        CHECK(table("-o a.ply " + options) == table(options + " --divide none"));
}

TEST_CASE("where all light is gathered the reported error is that of gathered light", "[slow]") {
    const Workplace place;
    place.write_room();
    place.write("points.txt", "1,0,1,0,1,0\n");
    const auto error_of = [&](const std::string& options) {
        REQUIRE(place.hemilux("solve room.obj -q --stats s.json " + options).code == 0);
        return place.read("s.json");
    };
    for (const std::string gathered :
         {"-o a.png --size 320x240", "--points points.txt --points-output p.csv",
          "-o a.hdr --size 320x240 --points points.txt --points-output p.csv"}) {
        const std::string json = error_of(gathered);
        CHECK_THAT(json, Contains("\"estimated_error_of\": \"gathered\""));
        CHECK(statistic(json, "estimated_error") <= statistic(json, "error_bound"));
        CHECK(statistic(json, "error_bound") <= .021);
        CHECK(statistic(json, "rays_learn") > 0);
        CHECK_THAT(json, Contains("\"error_division\": null"));
    }
    for (const std::string of_patches :
         {"-o a.png --size 32x24 --no-gather", "-o a.png --size 32x24 -o a.csv",
          "-o a.png --size 32x24 --error-map e.png"})
        CHECK_THAT(error_of(of_patches), Contains("\"estimated_error_of\": \"patches\""));
    CHECK_THAT(error_of("-o a.ply"), Contains("\"estimated_error_of\": \"surfaces\""));
}

TEST_CASE("gathered light is the same for any number of threads, and so is what it asks for",
          "[slow]") {
    const Workplace place;
    place.write_room();
    const std::string command = "solve room.obj --size 64x48 --seed 3 ";
    REQUIRE(place.hemilux(command + "-t 1 -o 1.png --stats 1.json").code == 0);
    REQUIRE(place.hemilux(command + "-t 2 -o 2.png --stats 2.json -q").code == 0);
    CHECK(place.read("1.png") == place.read("2.png"));
    CHECK(statistic(place.read("1.json"), "estimated_error") ==
          statistic(place.read("2.json"), "estimated_error"));
}

TEST_CASE("a time limit is of the division and the solution together") {
    const Workplace place;
    place.write_room();
    for (const char* time :
         {"1e-9", ".2"}) { // over before the division begins, or while it goes on
        const auto outcome = place.hemilux(
            "solve room.obj --divide auto --error 1e-4 -o a.csv --time " + std::string(time));
        REQUIRE(outcome.code == 0);
        CHECK_THAT(outcome.err, Contains("the run ended before the"));
        CHECK(place.read("a.csv").find("nan") == std::string::npos);
    }
}

TEST_CASE("Ctrl-C while patches are divided leaves the light by which they were divided") {
    const Workplace place;
    place.write_room();
    Running run(place, "solve room.obj --divide auto --error 1e-4 -v -o a.csv",
                place.path("log.txt").c_str());
    REQUIRE(wait_for(place, "log.txt", "division:"));
    run.interrupt();
    CHECK(run.wait() == 130);
    CHECK_THAT(place.read("log.txt"), Contains("interrupted; the outputs hold"));
    CHECK_THAT(place.read("log.txt"), Contains("estimated error unknown"));
    CHECK(place.has("a.csv"));
}

TEST_CASE("the steps log of a divided run has a row for each step on its last patches", "[slow]") {
    const Workplace place;
    place.write_room();
    for (const std::string error : {".1", ".3"}) { // some patches are divided, none
        REQUIRE(place
                    .hemilux("solve room.obj -q --rays 20 --divide auto --error " + error +
                             " --steps-log steps.csv --stats s.json")
                    .code == 0);
        std::istringstream lines(place.read("steps.csv"));
        std::string line;
        std::getline(lines, line);
        unsigned rows = 0;
        double last = 0;
        while (std::getline(lines, line)) {
            unsigned step = 0;
            double seconds = 0;
            REQUIRE(std::sscanf(line.c_str(), "stored-transport,0,%u,%*u,%lf", &step, &seconds) ==
                    2);
            CHECK(step == ++rows);
            CHECK(seconds >= last);
            last = seconds;
        }
        CHECK(rows > 1);
        CHECK(rows == statistic(place.read("s.json"), "steps"));
    }
}

TEST_CASE("--divide takes a length as --max-edge does, and not both") {
    const Workplace place;
    place.write_room();
    REQUIRE(place.hemilux("solve room.obj --divide .2 -q -o a.csv").code == 0);
    REQUIRE(place.hemilux("solve room.obj --max-edge .2 -q -o b.csv").code == 0);
    CHECK(place.read("a.csv") == place.read("b.csv"));
    const auto both = place.hemilux("solve room.obj --divide auto --max-edge .2 -o e.csv");
    CHECK(both.code == 1);
    for (const std::string wrong : {"0", "-1", "fine", "nan"}) {
        const auto outcome = place.hemilux("solve room.obj --divide=" + wrong + " -o e.csv");
        CHECK(outcome.code == 1);
        CHECK_THAT(outcome.err, Contains("--divide: expected auto, none or a length above 0"));
    }
}
