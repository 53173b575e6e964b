// Options of single methods: what sets them, and what does not.
#include "radiosity/engine/solving/method_option.h"
#include "support/catch.h"

using namespace hemilux;

namespace {

enum class Rim { open = 7, closed = 2 };
struct RimOptions {
    bool dark = false;
};

} // namespace

TEST_CASE("A choice is set by its name, whatever number stands for it and wherever it is listed") {
    const MethodOption rim =
        choice_option<Rim>("--rim", "rim", {{Rim::closed, "closed"}, {Rim::open, "open"}});
    CHECK(rim.values == std::vector<std::string>{"closed", "open"});
    SolveOptions options;
    options.own.of<Rim>() = Rim::closed;
    REQUIRE(rim.set(options, "open"));
    CHECK(options.own.of<Rim>() == Rim::open);
    CHECK(rim.get(options) == "open");
    CHECK_FALSE(rim.set(options, "ajar"));
    CHECK(rim.get(options) == "open");
    options.own.of<Rim>() = Rim{3};
    CHECK_THROWS_AS(rim.get(options), std::logic_error);
}

TEST_CASE("A flag takes yes and no, and keeps its value where it refuses a text") {
    const MethodOption dark = flag_option("--dark", "dark", &RimOptions::dark);
    SolveOptions options;
    REQUIRE(dark.set(options, "yes"));
    CHECK(dark.is_set(options));
    for (const char* const wrong : {"", "maybe", "Yes", "1"})
        CHECK_FALSE(dark.set(options, wrong));
    CHECK(dark.get(options) == "yes");
    REQUIRE(dark.set(options, "no"));
    CHECK(dark.get(options) == "no");
    CHECK_FALSE(dark.is_set(options));
    CHECK(dark.set(options, "no"));
}
