// --time and --memory hold whatever else is asked for.
#include "app/program.h"
#include "radiosity/engine/solving/method.h"
#include "support/catch.h"

#include <cmath>
#include <string>

using Catch::Contains;
using test::Workplace;

namespace {

std::string repeated(const std::string& text, int times) {
    std::string all;
    for (int i = 0; i < times; ++i)
        all += text;
    return all;
}

} // namespace

TEST_CASE("a run to a time ends, whatever --rays asks for") {
    const Workplace place;
    place.write_room();
    for (const hemilux::Method* const method : hemilux::methods()) {
        CAPTURE(method->name);
        const auto outcome = place.hemilux("solve room.obj -o a.csv --time .02 --rays 1e9 "
                                           "--method " +
                                           std::string(method->name));
        CHECK(outcome.code == 0);
        CHECK_THAT(outcome.err, Contains("rays per patch instead of 1e+09"));
        CHECK(place.has("a.csv"));
    }
}

TEST_CASE("a comparison by time ends, whatever --rays asks for") {
    const Workplace place;
    place.write_room();
    CHECK(place.hemilux("solve room.obj -o ref.csv --method stored-transport --steps 3").code == 0);
    const auto outcome =
        place.hemilux("compare room.obj --budget-time .05 --rays 1e9 --runs 1 --size 40x30 "
                      "--methods monte-carlo,hemisphere --reference ref.csv -o folder");
    CAPTURE(outcome.err);
    CHECK(outcome.code == 0);
}

TEST_CASE("triangles that a ray has to test by the thousand are reported, with their place",
          "[slow]") {
    const Workplace place;
    std::string many = "v 0 0 9\nv 0 1 9\nv 1 0 9\nusemtl lamp\nf 1 2 3\nusemtl grey\ng star\n";
    for (int k = 0; k < 1500; ++k) { // all through the origin, each turned
        const double a = .004 * k;
        for (int corner = 0; corner < 3; ++corner) {
            const double b = a + 2.0944 * corner;
            many += "v " + std::to_string(std::cos(b)) + ' ' + std::to_string(std::sin(b)) + ' ' +
                    std::to_string(.3 * std::sin(5 * b + a)) + '\n';
        }
        many += "f -3 -2 -1\n";
    }
    place.write("star.mtl", "newmtl lamp\nKe 9 9 9\nnewmtl grey\nKd .5 .5 .5\n");
    place.write("star.obj", "mtllib star.mtl\n" + many);
    const std::string said = "triangles, as so many lie in one place (group star, around ";
    CHECK_THAT(place.hemilux("info star.obj").err, Contains(said));
    const auto solved = place.hemilux("solve star.obj --rays 1 --steps 1 --method monte-carlo "
                                      "--sides both -o a.csv");
    CAPTURE(solved.err);
    CHECK(solved.code == 0);
    CHECK_THAT(solved.err, Contains(said));
    place.write_room();
    CHECK_THAT(place.hemilux("info room.obj").err, !Contains("has to test"));
}

TEST_CASE("--memory counts pictures") {
    const Workplace place;
    place.write_room();
    const std::string run = "solve room.obj --steps 1 --memory 100M " + test::camera_in_room;
    for (const auto& [options, need] :
         {std::pair("--no-gather", "results 604 MB"), {"--gather 4 -t 1", "results 1.56 GB"}}) {
        const auto outcome = place.hemilux(run + "--size 4096x4096 -o a.png " + options);
        CHECK(outcome.code == 3);
        CHECK_THAT(outcome.err, Contains(need) && Contains("a smaller --size"));
    }
    CHECK(place.hemilux(run + "--size 4096x4096 -o a.csv").code == 0);
    CHECK(place.hemilux(run + "--size 400x300 -o a.png").code == 0);
    CHECK(place.hemilux("compare room.obj --memory 100M --size 4096x4096 -o b").code == 3);
}

TEST_CASE("--memory counts all methods of a comparison, which are kept at once") {
    const Workplace place;
    place.write_room();
    const std::string run = "compare room.obj --max-edge .005 --memory 60M --reference room.mtl "
                            "-o c --methods stratified";
    for (const auto& [others, need] :
         {std::pair("", "method 89.8 MB"), {",monte-carlo", "method 148 MB"}}) {
        const auto outcome = place.hemilux(run + others);
        CHECK(outcome.code == 3);
        CHECK_THAT(outcome.err, Contains(need));
    }
}

TEST_CASE("--memory counts what reading takes, libraries included") {
    const Workplace place;
    place.write_room();
    place.write("many.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n" + repeated("f 1 2 3\n", 300'000));
    place.write("library.obj", "mtllib big.mtl\n" + place.read("room.obj"));
    place.write("big.mtl", repeated("newmtl a\n", 100'000));
    for (const char* scene : {"many.obj", "library.obj"}) {
        const auto outcome =
            place.hemilux("solve " + std::string(scene) + " --memory 20M -o a.csv");
        CHECK(outcome.code == 3);
        CHECK_THAT(outcome.err, Contains("to be read alone, and --memory is 21.0 MB"));
    }
}
