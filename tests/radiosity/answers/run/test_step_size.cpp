// The rays of a step where there is a limit of time.
#include "radiosity/answers/run/step_size.h"
#include "support/catch.h"

#include <optional>

TEST_CASE("a step takes no more rays than its time allows") {
    const auto rays_of_step = [](double rays, std::optional<double> seconds, std::size_t patches,
                                 const char* method = "stored-transport") {
        return hemilux::rays_of_step(rays, seconds, *hemilux::find_method(method), patches);
    };
    CHECK(rays_of_step(1e9, std::nullopt, 24) == 1e9);
    CHECK(rays_of_step(1e9, 5.0, 100) == 12'500);
    CHECK(rays_of_step(1e9, 16.0, 100, "matrix") == 2500);
    CHECK(rays_of_step(64, 5.0, 100'000) == 64);
    CHECK(rays_of_step(1000, 5.0, 100'000) == 64);
    CHECK(rays_of_step(64, 1.0, 1'000'000) == 2);
    CHECK(rays_of_step(.5, 1e-9, 1'000'000) == .5);
}

TEST_CASE("a step that takes fewer rays than were asked for is told of") {
    CHECK_FALSE(hemilux::smaller_step_finding(64, 64));
    CHECK_THAT(hemilux::smaller_step_finding(64, 2).value().text,
               Catch::Contains("2 rays per patch instead of 64"));
}
