#include "radiosity/answers/images/ssim.h"
#include "radiosity/paper/sampling/rng.h"
#include "support/catch.h"

#include <algorithm>
#include <functional>
#include <stdexcept>

using namespace hemilux;

namespace {

LumaPicture picture(int width, int height, const std::function<double(int, int)>& value) {
    LumaPicture result{width, height, {}};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            result.values.push_back(value(x, y));
    return result;
}

LumaPicture noise(std::uint64_t seed) {
    Rng rng(seed);
    return picture(64, 48, [&](int, int) { return 255 * rng.uniform(); });
}

constexpr double c1 = 6.5025, c2 = 58.5225; // (0.01 x 255)^2 and (0.03 x 255)^2

} // namespace

TEST_CASE("Equal pictures have an SSIM of 1, unequal ones less, either way round") {
    const LumaPicture a = noise(1), b = noise(2);
    CHECK(ssim(a, a) == Approx(1).epsilon(1e-12));
    CHECK(ssim(a, b) < .2);
    CHECK(ssim(a, b) == Approx(ssim(b, a)).epsilon(1e-12));
}

TEST_CASE("Of flat pictures the SSIM compares brightness alone") {
    const auto flat = [](double value) { return picture(20, 15, [&](int, int) { return value; }); };
    CHECK(ssim(flat(100), flat(120)) ==
          Approx((2 * 100 * 120 + c1) / (100 * 100 + 120 * 120 + c1)).epsilon(1e-9));
    CHECK(ssim(flat(0), flat(255)) == Approx(c1 / (255 * 255 + c1)).epsilon(1e-9));
}

TEST_CASE("A constant added keeps contrast and structure") {
    const LumaPicture a = noise(3);
    LumaPicture b = a;
    for (double& value : b.values)
        value += 20;
    // Of each window only the means differ: theirs is the first factor of the index.
    const std::vector<double> map = ssim_map(a, b);
    CHECK(*std::ranges::min_element(map) > .9);
    CHECK(*std::ranges::max_element(map) < 1);
    CHECK(ssim(a, b) == Approx(1 - 20.0 * 20 / (128 * 128 + 148 * 148)).epsilon(.003));
}

TEST_CASE("The inverse of a chequered picture has the negative structure") {
    const auto chequered = [](double amplitude) {
        return picture(40, 40, [=](int x, int y) {
            return 128 + ((x + y) % 2 == 0 ? amplitude : -amplitude);
        });
    };
    // The weighted mean of alternating signs is next to 0, the variance the square of the
    // amplitude.
    const double v = 50 * 50;
    CHECK(ssim(chequered(50), chequered(-50)) == Approx((c2 - 2 * v) / (c2 + 2 * v)).epsilon(1e-3));
    CHECK(ssim(chequered(50), chequered(10)) ==
          Approx((c2 + 2 * 50 * 10) / (c2 + 2500 + 100)).epsilon(1e-3));
}

TEST_CASE("The map has a value for each window, and finds what differs") {
    const LumaPicture a = noise(4);
    LumaPicture b = a;
    b.values[20 * 64 + 30] += 200; // pixel (30, 20)
    const std::vector<double> map = ssim_map(a, b);
    REQUIRE(map.size() == (64 - 10) * (48 - 10));
    const auto at = [&](int x, int y) {
        return map[static_cast<std::size_t>((y - ssim_margin) * 54 + x - ssim_margin)];
    };
    CHECK(at(30, 20) < .99);
    CHECK(at(35, 25) < 1 - 1e-9);
    CHECK(at(36, 20) == Approx(1).epsilon(1e-12));
    CHECK(at(30, 26) == Approx(1).epsilon(1e-12));
}

TEST_CASE("Pictures of different sizes, or smaller than a window, are refused") {
    const auto grey = [](int width, int height) {
        return picture(width, height, [](int, int) { return 100; });
    };
    CHECK_THROWS_AS(ssim(grey(20, 20), grey(20, 21)), std::invalid_argument);
    CHECK_THROWS_AS(ssim(grey(20, 10), grey(20, 10)), std::invalid_argument);
    CHECK(ssim(grey(11, 11), grey(11, 11)) == Approx(1));
}

TEST_CASE("The SSIM to a picture without its noise is found from as much noise once more") {
    const auto plain = [](int x, int y) { return 100 + 60 * double((x / 8 + y / 8) % 2); };
    const double amplitude = GENERATE(1, 5, 20, 40);
    Rng rng(7);
    const auto add_noise = [&](LumaPicture picture) {
        for (double& value : picture.values)
            value += amplitude * (rng.uniform() < .5 ? -1 : 1);
        return picture;
    };
    const LumaPicture truth = picture(200, 150, plain), noisy = add_noise(truth);
    CHECK(ssim_without_noise(noisy, add_noise(noisy)) == Approx(ssim(noisy, truth)).epsilon(.06));
    CHECK(ssim_without_noise(truth, truth) == Approx(1));
    // Of a flat picture noise is all that there is to see.
    const LumaPicture flat = add_noise(picture(200, 150, [](int, int) { return 120; }));
    CHECK(ssim_without_noise(flat, add_noise(flat)) ==
          Approx(ssim(flat, picture(200, 150, [](int, int) { return 120; }))).margin(.05));
}
