#include "io/drawings/false_colour.h"
#include "support/catch.h"

#include <limits>
#include <stdexcept>

using namespace hemilux;

namespace {

using Many = std::vector<std::vector<float>>;

int lightness(Colour c) { return c.r + c.g + c.b; }

Image plain(int width, int height, float grey) {
    Image image(width, height);
    for (glm::vec3& pixel : image.pixels)
        pixel = glm::vec3(grey);
    return image;
}

glm::ivec3 shown(const glm::vec3& linear) {
    return {std::lround(255 * srgb_from_linear(linear.r)),
            std::lround(255 * srgb_from_linear(linear.g)),
            std::lround(255 * srgb_from_linear(linear.b))};
}

} // namespace

TEST_CASE("blue is too dark, red is too bright, and more of it is darker") {
    CHECK(lightness(diverging_colour(0)) == 3 * 255);
    for (double t = 0.05; t <= 1; t += 0.05) {
        const Colour dark = diverging_colour(-t), bright = diverging_colour(t);
        CHECK(dark.b > dark.r);
        CHECK(bright.r > bright.b);
        CHECK(lightness(dark) < lightness(diverging_colour(-t + 0.05)));
        CHECK(lightness(bright) < lightness(diverging_colour(t - 0.05)));
        CHECK(std::abs(lightness(dark) - lightness(bright)) < 60);
    }
    CHECK(lightness(diverging_colour(7)) == lightness(diverging_colour(1)));
    CHECK(lightness(diverging_colour(-7)) == lightness(diverging_colour(-1)));
    const Colour unknown = diverging_colour(std::numeric_limits<double>::quiet_NaN());
    CHECK(unknown.r == unknown.g);
    CHECK(unknown.g == unknown.b);
    CHECK(lightness(unknown) < 3 * 255);
}

TEST_CASE("the difference is in units of the exposure's white") {
    const auto difference = luminance_difference(plain(4, 3, 0.5f), plain(4, 3, 0.3f), 2);
    REQUIRE(difference.size() == 12);
    CHECK(difference[5] == Approx(0.4));
    CHECK_THROWS_AS(luminance_difference(plain(4, 3, 0), plain(3, 4, 0), 1), std::invalid_argument);
}

TEST_CASE("the scale holds almost all, is a round number, and ignores single pixels") {
    std::vector<float> ramp; // 0 to 1
    for (int i = 0; i <= 1000; ++i)
        ramp.push_back(0.001f * static_cast<float>(i));
    std::vector<float> outlier(1000, 0.03f);
    outlier[3] = 100;
    CHECK(common_scale(Many{ramp}).most == Approx(1));
    CHECK(common_scale(Many{outlier}).most == Approx(0.05));
    const DifferenceScale both = common_scale(Many{ramp, outlier, outlier});
    CHECK(both.typical == Approx(0.05));
    CHECK(both.most == Approx(1));
    CHECK(common_scale({}).most > 0);
    CHECK(common_scale(Many{std::vector<float>(10, 0.0f)}).typical > 0);
    for (const float exact : {0.1f, 0.2f, 0.5f})
        CHECK(common_scale(Many{std::vector<float>(10, exact)}).most == Approx(exact));
}

TEST_CASE("places are odd, ascending, almost even where all is typical, and end at 1") {
    const DifferenceScale alike{0.02, 0.02}, wide{0.02, 2};
    for (const DifferenceScale& scale : {alike, wide}) {
        CHECK(scale.place(0) == 0);
        CHECK(scale.place(scale.most) == Approx(1));
        CHECK(scale.place(-0.01) == Approx(-scale.place(0.01)));
        CHECK(scale.place(0.01) < scale.place(0.011));
    }
    CHECK(alike.place(0.01) == Approx(0.5).margin(0.06));
    CHECK(wide.place(0.02) > 0.15); // far from white
    CHECK(wide.place(0.02) < 0.3);
}

TEST_CASE("the picture has each difference's colour, and a bar below it") {
    std::vector<float> difference(60 * 20, 0.0f);
    difference[0] = -0.1f;
    difference[61] = 0.05f;
    const Image image = false_colour(difference, 60, 20, {0.1, 0.1});
    CHECK(image.width == 60);
    CHECK(image.height > 40);
    const auto check = [](const glm::vec3& pixel, Colour colour) {
        CHECK(shown(pixel) == glm::ivec3(colour.r, colour.g, colour.b));
    };
    check(image.at(0, 0), diverging_colour(-1));
    check(image.at(1, 1), diverging_colour(DifferenceScale{0.1, 0.1}.place(0.05)));
    check(image.at(30, 10), {255, 255, 255});
    int letters = 0; // black pixels where the numbers stand
    for (int y = 44; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            letters += shown(image.at(x, y)) == glm::ivec3(0);
    CHECK(letters > 20);
    CHECK(letters < 800);
    const glm::ivec3 left = shown(image.at(5, 30)), right = shown(image.at(54, 30));
    CHECK(left.b > left.r);
    CHECK(right.r > right.b);
}
