#include "io/drawings/canvas.h"
#include "io/drawings/log_axis.h"
#include "io/drawings/plot.h"
#include "support/catch.h"

#include <array>
#include <cmath>
#include <limits>

using namespace hemilux;
using Catch::Contains;

namespace {

constexpr Colour black{0, 0, 0};

/// How much ink is on white paper, in pixels of black.
double ink(const Image& image) {
    double sum = 0;
    for (const glm::vec3& pixel : image.pixels)
        sum += 1 - double(srgb_from_linear(pixel.r));
    return sum;
}

/// The first and last column with ink; {width, -1} if there is none.
std::pair<int, int> columns_with_ink(const Image& image) {
    int first = image.width, last = -1;
    for (int x = 0; x < image.width; ++x)
        for (int y = 0; y < image.height; ++y)
            if (image.at(x, y).r < 0.9f) {
                first = std::min(first, x);
                last = std::max(last, x);
            }
    return {first, last};
}

std::size_t count(const std::string& text, const std::string& part) {
    std::size_t found = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
        ++found;
    return found;
}

MeanCurve root_law(double factor, double first, double last, double spread = 1) {
    MeanCurve curve;
    for (int i = 0; i <= 10; ++i) {
        curve.x.push_back(first * std::pow(last / first, i / 10.0));
        curve.mean.push_back(factor / std::sqrt(curve.x.back()));
        curve.low.push_back(curve.mean.back() / spread);
        curve.high.push_back(curve.mean.back() * spread);
    }
    return curve;
}

Chart two_methods() {
    return {.title = "a room & a lamp",
            .y_label = "relative error, %",
            .names = {"one", "two"},
            .panels = {{"seconds", {root_law(3, 0.1, 10, 1.2), root_law(4, 0.1, 10, 1.2)}},
                       {"rays", {root_law(300, 1000, 1e5), root_law(400, 1000, 1e5)}}}};
}

bool has_colour(const Image& image, Colour colour) {
    const glm::vec3 wanted{linear_from_srgb(float(colour.r) / 255),
                           linear_from_srgb(float(colour.g) / 255),
                           linear_from_srgb(float(colour.b) / 255)};
    for (const glm::vec3& pixel : image.pixels)
        if (glm::length(pixel - wanted) < 1e-4f)
            return true;
    return false;
}

std::vector<double> values(const std::vector<LogTick>& ticks, bool labelled_only = false) {
    std::vector<double> result;
    for (const LogTick& tick : ticks)
        if (tick.labelled || !labelled_only)
            result.push_back(tick.value);
    return result;
}

} // namespace

TEST_CASE("an axis holds all its numbers and places them by their logarithms") {
    const LogAxis axis({0.3, 30, 3, std::numeric_limits<double>::quiet_NaN(), -1, 0});
    CHECK(axis.low() < 0.3);
    CHECK(axis.high() > 30);
    CHECK(axis.low() > 0.2);
    CHECK(axis.high() < 45);
    CHECK(axis.place(3) == Approx(0.5));
    CHECK(axis.place(axis.low()) == Approx(0).margin(1e-12));
    CHECK(axis.place(axis.high()) == Approx(1));
    CHECK(axis.at(axis.place(7)) == Approx(7));
}

TEST_CASE("an axis of one number, or of none, is still one") {
    const LogAxis one({5});
    CHECK(one.place(5) == Approx(0.5));
    CHECK(one.high() / one.low() >= 4);
    CHECK(values(one.ticks()).size() >= 2);
    const LogAxis none({});
    CHECK(none.low() < none.high());
}

TEST_CASE("ticks stand at 1, 2 and 5 times powers of ten") {
    const std::vector<double> expected{0.5, 1, 2, 5, 10, 20};
    const std::vector<double> found = values(LogAxis({0.5, 20}).ticks(), true);
    REQUIRE(found.size() == expected.size());
    for (std::size_t i = 0; i < found.size(); ++i)
        CHECK(found[i] == Approx(expected[i]));
    // Over many decades only powers of ten are labelled, and not even all of them.
    const std::vector<double> tens = values(LogAxis({1, 1e4}).ticks(), true);
    CHECK(tens.size() == 5);
    CHECK(values(LogAxis({1e-20, 1e20}).ticks(), true).size() <= 8);
    CHECK(tick_text(0.05) == "0.05");
    CHECK(tick_text(1) == "1");
    CHECK(tick_text(500) == "500");
    CHECK(tick_text(2000) == "2k");
    CHECK(tick_text(1e7) == "10M");
}

TEST_CASE("a polygon covers its area, whatever its place within pixels") {
    PixelCanvas canvas(40, 30);
    fill_box(canvas, {3.5, 4.25}, {13.5, 14.25}, black);
    CHECK(ink(canvas.image()) == Approx(100).epsilon(1e-3));
    PixelCanvas half(40, 30);
    fill_box(half, {3.5, 4.25}, {13.5, 14.25}, black, 0.5);
    CHECK(ink(half.image()) == Approx(50).epsilon(0.01));
    PixelCanvas triangle(40, 30);
    triangle.polygon(std::array{Vec2(2, 3), Vec2(33, 8), Vec2(11, 27)}, black, 1);
    CHECK(ink(triangle.image()) == Approx(0.5 * (31 * 24 - 9 * 5)).epsilon(0.01));
}

TEST_CASE("what lies outside of the picture is left out") {
    PixelCanvas canvas(10, 10);
    fill_box(canvas, {-100, -100}, {100, 5}, black);
    CHECK(ink(canvas.image()) == Approx(50));
    const double unknown = std::numeric_limits<double>::quiet_NaN();
    canvas.polygon(std::array{Vec2(unknown, 1), Vec2(3, unknown), Vec2(unknown, 7)}, black, 1);
    canvas.line(std::array{Vec2(-1e9, 7), Vec2(1e9, 7)}, {.colour = black, .width = 2});
    CHECK(ink(canvas.image()) == Approx(70));
}

TEST_CASE("lines have their width, and dashes leave out half of them") {
    PixelCanvas canvas(120, 20);
    canvas.line(std::array{Vec2(10, 5), Vec2(110, 5)}, {.colour = black, .width = 2});
    CHECK(ink(canvas.image()) == Approx(200).epsilon(0.01));
    PixelCanvas dashed(120, 20);
    dashed.line(std::array{Vec2(10, 5), Vec2(60, 5), Vec2(110, 5)},
                {.colour = black, .width = 2, .dash = 5});
    CHECK(ink(dashed.image()) == Approx(100).epsilon(0.01));
}

TEST_CASE("text stands where its anchor says, in any letters") {
    const auto drawn = [](std::string_view text, Anchor anchor) {
        PixelCanvas canvas(200, 30);
        canvas.text({100, 20}, text, {.anchor = anchor, .size = 12, .colour = black});
        return canvas.image();
    };
    const auto [start_first, start_last] = columns_with_ink(drawn("hemisphere", Anchor::start));
    CHECK(start_first >= 99);
    CHECK(start_last > 140);
    const auto [end_first, end_last] = columns_with_ink(drawn("hemisphere", Anchor::end));
    CHECK(end_last <= 101);
    CHECK(end_first < 60);
    const auto [first, last] = columns_with_ink(drawn("hemisphere", Anchor::middle));
    CHECK(std::abs(first + last - 200) < 6);
    CHECK(ink(drawn("", Anchor::middle)) == Approx(0).margin(1e-9));
    CHECK(ink(drawn("\xC3\xA9\x7F\n\x01", Anchor::start)) > 0);
}

TEST_CASE("SVG text is escaped and numbers have no exponents") {
    SvgCanvas canvas(100, 50);
    canvas.text({1e-9, 2.0 / 3}, "a<b & c", {});
    canvas.polygon(std::array{Vec2(0, 0), Vec2(1, 0), Vec2(1, 1)}, {255, 0, 10}, 0.25);
    const std::string text = canvas.document();
    CHECK_THAT(text, Contains("a&lt;b &amp; c") && Contains("x=\"0\"") && Contains("y=\"0.67\"") &&
                         Contains("#ff000a") && Contains("fill-opacity=\"0.25\""));
    CHECK(text.rfind("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"100\" height=\"50\"", 0) ==
          0);
    CHECK(text.ends_with("</svg>\n"));
}

TEST_CASE("a chart has curves, bands, a guide, a legend and labels on both canvases") {
    const Chart chart = two_methods();
    const std::string svg = chart_svg(chart);
    for (const char* text : {"a room &amp; a lamp", "relative error, %", ">seconds<", ">rays<",
                             ">one<", ">two<", "slope -1/2", ">0.1<", ">10k<"})
        CHECK_THAT(svg, Contains(text));
    CHECK(count(svg, "stroke-dasharray") == 2);   // a guide in each panel
    CHECK(count(svg, "fill-opacity") == 2);       // bands where runs differ
    CHECK(count(svg, "stroke=\"#0072b2\"") == 3); // two panels and the legend
    CHECK_THAT(svg, !Contains("nan") && !Contains("inf"));

    const Image image = chart_image(chart);
    CHECK(image.width == chart_size(chart).width);
    CHECK(has_colour(image, curve_colour(0)));
    CHECK(has_colour(image, curve_colour(1)));
    CHECK_FALSE(has_colour(image, curve_colour(2)));
}

TEST_CASE("a chart without curves can be drawn") {
    Chart chart = two_methods();
    for (Panel& panel : chart.panels)
        panel.curves.assign(2, {});
    CHECK_THAT(chart_svg(chart), !Contains("nan") && !Contains("slope") && Contains(">two<"));
    CHECK(chart_image(chart).width > 0);
    CHECK_NOTHROW(chart_svg(Chart{}));
}
