#include "io/drawings/plot.h"

#include "io/drawings/log_axis.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

namespace hemilux {

namespace {

constexpr double panel_width = 440, panel_height = 400;
constexpr double left = 64, top = 64, between_panels = 68, bottom = 62, legend_width = 250;
constexpr double small_text = 14, title_text = 17;
constexpr Colour grid{222, 222, 222}, faint_grid{240, 240, 240}, grey{130, 130, 130};
constexpr double band_opacity = 0.18;

/// The slope and the name of a dashed line below the curves of each panel.
constexpr double guide_slope = -0.5;
constexpr const char* guide_name = "slope -1/2";

/// Returns the colour of a curve by its place among the names.
Colour curve_colour(std::size_t index) {
    // These are distinguished with every kind of colour vision (Okabe and Ito 2008), without their
    // yellow.
    static constexpr std::array<Colour, 8> colours{{{0, 114, 178},
                                                    {213, 94, 0},
                                                    {0, 158, 115},
                                                    {204, 121, 167},
                                                    {230, 159, 0},
                                                    {86, 180, 233},
                                                    {0, 0, 0},
                                                    {140, 140, 140}}};
    return colours[index % colours.size()];
}

/// The places of numbers on one panel.
struct Frame2 {
    LogAxis x, y;
    Vec2 low, high; ///< corners of the panel: top left, bottom right

    [[nodiscard]] Vec2 place(double x_value, double y_value) const {
        return {low.x + x.place(x_value) * (high.x - low.x),
                high.y - y.place(y_value) * (high.y - low.y)};
    }
};

/// Returns the error at x = 1 of a straight line that has the guide's slope and lies a little below
/// all points. It is infinity where there is no point.
double guide_height(const Panel& panel) {
    double height = std::numeric_limits<double>::infinity();
    for (const MeanCurve& curve : panel.curves)
        for (std::size_t i = 0; i < curve.x.size(); ++i)
            height = std::min(height, curve.low[i] / std::pow(curve.x[i], guide_slope));
    constexpr double below = 1.3;
    return height / below;
}

LogAxis x_axis(const Panel& panel) {
    std::vector<double> numbers;
    for (const MeanCurve& curve : panel.curves)
        numbers.insert(numbers.end(), curve.x.begin(), curve.x.end());
    for (const std::vector<Dot>& dots : panel.dots)
        for (const Dot& dot : dots)
            numbers.push_back(dot.x);
    return LogAxis(numbers);
}

/// Returns the axis of errors, the same for all panels, so that they can be read across.
LogAxis y_axis(const Chart& chart) {
    std::vector<double> numbers;
    for (const Panel& panel : chart.panels)
        for (const MeanCurve& curve : panel.curves) {
            numbers.insert(numbers.end(), curve.low.begin(), curve.low.end());
            numbers.insert(numbers.end(), curve.high.begin(), curve.high.end());
        }
    for (const Panel& panel : chart.panels)
        for (const std::vector<Dot>& dots : panel.dots)
            for (const Dot& dot : dots)
                numbers.push_back(dot.y);
    if (!numbers.empty())
        numbers.push_back(std::ranges::min(numbers) / 1.5); // for the guide
    return LogAxis(numbers);
}

void draw_grid(const Frame2& frame, Canvas& canvas) {
    for (const LogTick& tick : frame.x.ticks()) {
        const double x = frame.place(tick.value, frame.y.low()).x;
        canvas.line(std::array{Vec2(x, frame.low.y), Vec2(x, frame.high.y)},
                    {.colour = tick.labelled ? grid : faint_grid});
        if (tick.labelled)
            canvas.text({x, frame.high.y + 19}, tick_text(tick.value),
                        {.anchor = Anchor::middle, .size = small_text, .colour = ink});
    }
    for (const LogTick& tick : frame.y.ticks()) {
        const double y = frame.place(frame.x.low(), tick.value).y;
        canvas.line(std::array{Vec2(frame.low.x, y), Vec2(frame.high.x, y)},
                    {.colour = tick.labelled ? grid : faint_grid});
        if (tick.labelled)
            canvas.text({frame.low.x - 8, y + 4}, tick_text(tick.value),
                        {.anchor = Anchor::end, .size = small_text, .colour = ink});
    }
}

/// Draws the part within the panel of the line error = height x^slope.
void draw_guide(const Panel& panel, const Frame2& frame, Canvas& canvas) {
    const double height = guide_height(panel);
    if (!std::isfinite(height))
        return;
    const auto x_at = [&](double error) { return std::pow(error / height, 1 / guide_slope); };
    const auto error_at_x = [&](double x) { return height * std::pow(x, guide_slope); };
    const auto [x0, x1] = std::minmax({x_at(frame.y.low()), x_at(frame.y.high())});
    const double from = std::max(x0, frame.x.low()), to = std::min(x1, frame.x.high());
    if (!(from < to))
        return;
    canvas.line(std::array{frame.place(from, error_at_x(from)), frame.place(to, error_at_x(to))},
                {.colour = grey, .width = 1.2, .dash = 6});
    const double x = from * std::pow(to / from, 0.3);
    canvas.text(frame.place(x, error_at_x(x)) + Vec2(-8, 18), guide_name,
                {.anchor = Anchor::end, .size = small_text, .colour = grey});
}

void draw_band(const MeanCurve& curve, const Frame2& frame, Colour colour, Canvas& canvas) {
    if (curve.low == curve.high)
        return;
    std::vector<Vec2> outline;
    for (std::size_t i = 0; i < curve.x.size(); ++i)
        outline.push_back(frame.place(curve.x[i], curve.high[i]));
    for (std::size_t i = curve.x.size(); i-- > 0;)
        outline.push_back(frame.place(curve.x[i], curve.low[i]));
    canvas.polygon(outline, colour, band_opacity);
}

void draw_curve(const MeanCurve& curve, const Frame2& frame, Colour colour, Canvas& canvas) {
    std::vector<Vec2> points;
    for (std::size_t i = 0; i < curve.x.size(); ++i)
        points.push_back(frame.place(curve.x[i], curve.mean[i]));
    if (points.empty())
        return;
    canvas.line(points, {.colour = colour, .width = 2});
    const Vec2 dot(2.5, 2.5);
    fill_box(canvas, points.back() - dot, points.back() + dot, colour);
}

std::string class_of_curve(std::size_t index) { return "curve" + std::to_string(index); }

void draw_dots(std::span<const Dot> dots, std::size_t curve, const Frame2& frame, Canvas& canvas) {
    for (const Dot& dot : dots) {
        canvas.begin_class(class_of_curve(curve) + (dot.name.empty() ? "" : " " + dot.name));
        canvas.dot(frame.place(dot.x, dot.y), curve_colour(curve), dot.text);
    }
}

void draw_panel(const Chart& chart, const Panel& panel, const Frame2& frame, Canvas& canvas) {
    draw_grid(frame, canvas);
    draw_guide(panel, frame, canvas);
    for (std::size_t i = 0; i < panel.curves.size(); ++i) {
        canvas.begin_class(class_of_curve(i));
        draw_band(panel.curves[i], frame, curve_colour(i), canvas);
    }
    for (std::size_t i = 0; i < panel.curves.size(); ++i) {
        canvas.begin_class(class_of_curve(i));
        draw_curve(panel.curves[i], frame, curve_colour(i), canvas);
        if (i < panel.dots.size())
            draw_dots(panel.dots[i], i, frame, canvas);
    }
    canvas.begin_class("");
    const Vec2 low = frame.low, high = frame.high;
    canvas.line(std::array{low, Vec2(low.x, high.y), high}, {.colour = ink});
    canvas.text({(low.x + high.x) / 2, high.y + 44}, panel.x_label,
                {.anchor = Anchor::middle, .size = small_text, .colour = ink});
    canvas.text({low.x, low.y - 12}, chart.y_label, {.size = small_text, .colour = ink});
}

void draw_legend(const Chart& chart, const Vec2& corner, Canvas& canvas) {
    for (std::size_t i = 0; i < chart.names.size(); ++i) {
        const Vec2 at = corner + Vec2(0, 24.0 * double(i) + 10);
        canvas.begin_class(class_of_curve(i));
        canvas.line(std::array{at, at + Vec2(24, 0)}, {.colour = curve_colour(i), .width = 3});
        canvas.text(at + Vec2(32, 4), chart.names[i], {.size = small_text, .colour = ink});
    }
    canvas.begin_class("");
}

double panel_left(std::size_t index) {
    return left + double(index) * (panel_width + between_panels);
}

} // namespace

std::string chart_svg(const Chart& chart) {
    const double panels_end = panel_left(chart.panels.size()) - between_panels;
    SvgCanvas canvas(static_cast<int>(panels_end + legend_width),
                     static_cast<int>(top + panel_height + bottom));
    canvas.text({left, 26}, chart.title, {.size = title_text, .colour = ink});
    const LogAxis errors = y_axis(chart);
    for (std::size_t i = 0; i < chart.panels.size(); ++i) {
        const Vec2 low(panel_left(i), top);
        draw_panel(chart, chart.panels[i],
                   {x_axis(chart.panels[i]), errors, low, low + Vec2(panel_width, panel_height)},
                   canvas);
    }
    draw_legend(chart, {panels_end + 24, top}, canvas);
    return canvas.document();
}

} // namespace hemilux
