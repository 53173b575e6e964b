#include "radiosity/answers/images/tone.h"
#include "support/catch.h"

#include <cmath>
#include <limits>

using namespace hemilux;

namespace {

float peak(const glm::vec3& colour) { return std::max({colour.r, colour.g, colour.b}); }

/// The hue in degrees, from the angle around the grey axis.
double hue(const glm::vec3& c) {
    return std::atan2(std::sqrt(3.0) * static_cast<double>(c.g - c.b),
                      static_cast<double>(2 * c.r - c.g - c.b)) *
           180 / 3.14159265358979;
}

} // namespace

TEST_CASE("the neutral curve changes nothing up to 0.8") {
    const Display neutral(2, Tone::neutral);
    for (const glm::vec3& light : {glm::vec3(0.4f, 0.1f, 0), glm::vec3(0.1f), glm::vec3(0)})
        CHECK(neutral(light) == 2.0f * light);
}

TEST_CASE("the neutral curve keeps the hue of what is too bright, and order and slope") {
    const Display neutral(1, Tone::neutral), cut(1, Tone::srgb);
    const glm::vec3 warm(1.6f, 1.2f, 0.5f);
    CHECK(hue(neutral(warm)) == Approx(hue(warm)).margin(0.01));
    CHECK(std::abs(hue(cut(warm)) - hue(warm)) > 15);
    float last = 0;
    for (float x = 0.5f; x < 1e6f; x *= 1.01f) {
        const float shown = peak(neutral(x * warm));
        CHECK(shown >= last);
        CHECK(shown <= 1);
        last = shown;
    }
    CHECK(last > 0.999f);
    const auto grey = [&](float x) { return neutral(glm::vec3(x)).r; };
    CHECK((grey(0.801f) - grey(0.8f)) / 0.001f == Approx(1).margin(0.02));
    // q = 1 - 0.04 / (2 + 1 - 1.6)
    CHECK(grey(2) == Approx(1 - 0.04 / 1.4));
}

TEST_CASE("colours of lamps go to white, saturated or not") {
    const glm::vec3 shown = Display(1, Tone::neutral)({1000, 0, 0});
    CHECK(shown.g > 0.98f);
    CHECK(shown.g <= shown.r);
}

TEST_CASE("what is no number can be shown") {
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    constexpr float infinity = std::numeric_limits<float>::infinity();
    for (const Tone tone : {Tone::neutral, Tone::srgb}) {
        const Display display(1, tone);
        CHECK(display({nan, nan, nan}) == glm::vec3(0));
        CHECK(display({infinity, 0.5f, -1}) == glm::vec3(1, 0.5f, 0));
    }
}
