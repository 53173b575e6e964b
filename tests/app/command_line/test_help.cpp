// The three lengths of help: of the program, of a subcommand, of all that there is.
#include "app/check_fails.h"
#include "support/catch.h"

#include <algorithm>
#include <string>

using Catch::Contains;
using test::Workplace;

namespace {

std::ptrdiff_t lines(const std::string& text) { return std::ranges::count(text, '\n'); }

} // namespace

TEST_CASE("the program alone prints a short help") {
    const Workplace place;
    const auto alone = place.hemilux("");
    CHECK(alone.code == 0);
    CHECK(alone.err.empty());
    CHECK(lines(alone.out) <= 15);
    CHECK_THAT(alone.out, Contains("hemilux room.glb") && Contains("hemilux bake room.glb"));
    CHECK(place.hemilux("-h").out == alone.out);
    CHECK_THAT(place.hemilux("--help").out,
               Contains("hemilux MODEL") && Contains("Factors between surfaces:"));
}

TEST_CASE("-h of a subcommand has examples and what is often used, --help has all") {
    const Workplace place;
    for (const std::string command : {"solve", "bake", "compare", "density", "formfactors",
                                      "viewfactors", "exchange", "dim", "info"}) {
        CAPTURE(command);
        const std::string text = place.hemilux(command + " -h").out;
        CHECK(lines(text) <= 30);
        CHECK_THAT(text, Contains("  hemilux ") && Contains("--help lists all options"));
        const std::string whole = place.hemilux(command + " --help").out;
        CHECK(lines(whole) > lines(text));
        CHECK(place.hemilux("help " + command).out == whole);
    }
    CHECK(lines(place.hemilux("solve --help").out) <= 150);
}

TEST_CASE("options of single methods stand in --help METHOD") {
    const Workplace place;
    const std::string whole = place.hemilux("solve --help").out;
    CHECK_THAT(whole, Contains("--help METHOD") && Contains("--overshoot"));
    CHECK_THAT(whole, !Contains("will probably receive"));
    const std::string of_one = place.hemilux("solve --help progressive").out;
    CHECK_THAT(of_one, Contains("--overshoot") && Contains("will probably receive"));
    CHECK(place.hemilux("help solve progressive").out == of_one);
    CHECK_THAT(place.hemilux("solve --help stored-transport").out,
               Contains("no options of its own") || Contains("Its own options"));
    test::check_fails(place, 1, "solve --help progresive", "did you mean 'progressive'?");
    CHECK(place.hemilux("solve --help room.obj").out == whole);
}

TEST_CASE("words that say the same as others work, and no help has them") {
    const Workplace place;
    place.write_room();
    for (const char* const arguments : {"solve --help", "solve --help matrix", "--print man",
                                        "--print bash", "--print zsh", "--print fish"}) {
        CAPTURE(arguments);
        CHECK_THAT(place.hemilux(arguments).out,
                   !Contains("two-sided") && !Contains("two\\-sided"));
    }
    CHECK_THAT(place.hemilux("solve --help").out, !Contains("--exact"));
    CHECK(place.hemilux("solve room.obj --two-sided --steps 1 -q -o a.csv").code == 0);
    CHECK(place.hemilux("solve room.obj --method matrix --exact -q -o a.csv").code == 0);
}
