// The progress bar's arithmetic.
#include "app/terminal/progress.h"
#include "support/catch.h"

#include <cmath>

using namespace hemilux;

namespace {

StopRule after(std::optional<std::uint32_t> steps, std::optional<double> seconds,
               std::optional<double> error) {
    return {.steps = steps, .seconds = seconds, .error = error};
}

} // namespace

TEST_CASE("the part of the stop rule that is met first counts") {
    const ProgressState state{.phase = "",
                              .steps = 3,
                              .step_share = 0.5,
                              .seconds = 2,
                              .rays_of_steps = 3000,
                              .rays_of_step = 500,
                              .estimated_error = 0.04};
    CHECK(share_done(after(7, {}, {}), false, state) == Approx(0.5));
    CHECK(share_done(after({}, 8.0, {}), false, state) == Approx(0.25));
    // Half of the error takes four times the rays: 3.5 of 12; fewer if they are well distributed.
    CHECK(share_done(after({}, {}, 0.02), false, state) == Approx(3.5 / 12));
    CHECK(share_done(after({}, {}, 0.02), true, state) == Approx(3.5 / 3 / std::pow(2, 1 / .7)));
    CHECK(share_done(after(7, 8.0, 0.02), false, state) == Approx(0.5));
    CHECK(share_done(after(2, {}, {}), false, state) == 1);
    CHECK(share_done(after({}, {}, {}), false, state) == 0);
}

TEST_CASE("nothing is known before the first step") {
    const ProgressState state{.phase = "density"};
    CHECK(share_done(after(8, 1.0, 0.01), false, state) == 0);
    const std::string line =
        progress_line(share_done(after(8, 1.0, 0.01), false, state), state, 200);
    CHECK(line.find("  0 %  density") != std::string::npos);
    CHECK(line.find("left") == std::string::npos);
    CHECK(line.find("error") == std::string::npos);
}

TEST_CASE("the bar shows share, rate, times and error, and fits the terminal") {
    const ProgressState state{.phase = "shooting",
                              .steps = 4,
                              .step_share = 0,
                              .seconds = 10,
                              .rays = 12'300'000,
                              .estimated_error = 0.021};
    const std::string line = progress_line(share_done(after(16, {}, {}), false, state), state, 200);
    CHECK(line == "[######..................]  25 %  shooting  1.23 M rays/s  10.0 s, 30.0 s left"
                  "  error 2.1 %");
    CHECK(progress_line(share_done(after(16, {}, {}), false, state), state, 20).size() == 20);
}
