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

TEST_CASE("a chart has curves, bands, a guide, a legend and labels") {
    const Chart chart = two_methods();
    const std::string svg = chart_svg(chart);
    for (const char* text : {"a room &amp; a lamp", "relative error, %", ">seconds<", ">rays<",
                             ">one<", ">two<", "slope -1/2", ">0.1<", ">10k<"})
        CHECK_THAT(svg, Contains(text));
    CHECK(count(svg, "stroke-dasharray") == 2);   // a guide in each panel
    CHECK(count(svg, "fill-opacity") == 2);       // bands where runs differ
    CHECK(count(svg, "stroke=\"#0072b2\"") == 3); // two panels and the legend
    CHECK_THAT(svg, !Contains("nan") && !Contains("inf"));
}

TEST_CASE("dots of a chart lie on their curves, and have their texts and classes") {
    Chart chart = two_methods();
    CHECK_THAT(chart_svg(chart), !Contains("<circle") && Contains("class=\"curve1\""));
    const MeanCurve& curve = chart.panels[0].curves[1];
    chart.panels[0].dots = {{}, {{curve.x.back(), curve.mean.back(), "1 < 2", "step7"}}};
    const std::string svg = chart_svg(chart);
    CHECK(count(svg, "<circle") == 1);
    CHECK_THAT(svg, Contains("<circle class=\"curve1 step7\"") &&
                        Contains("<title>1 &lt; 2</title></circle>"));
}

TEST_CASE("a chart without curves can be drawn") {
    Chart chart = two_methods();
    for (Panel& panel : chart.panels)
        panel.curves.assign(2, {});
    CHECK_THAT(chart_svg(chart), !Contains("nan") && !Contains("slope") && Contains(">two<"));
    CHECK_NOTHROW(chart_svg(Chart{}));
}
