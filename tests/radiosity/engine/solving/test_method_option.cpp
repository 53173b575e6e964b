// Options of single methods: what sets them, and what does not.
#include "radiosity/engine/solving/method_option.h"
#include "support/catch.h"

using namespace hemilux;

namespace {

struct RimOptions {
    bool dark = false;
};

} // namespace

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
