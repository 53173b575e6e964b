#include "io/drawings/colour_bar.h"

#include "io/drawings/log_axis.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace hemilux {

namespace {

constexpr double text_size = 12;

} // namespace

std::vector<BarMark> round_marks(double most) {
    if (!(most > 0))
        return {{0, tick_text(0)}};
    std::vector<BarMark> marks;
    constexpr double max_steps = 8;
    const double step = round_up(most / max_steps);
    constexpr double rounding = 1 + 1e-9;
    for (int i = 0; i * step <= most * rounding; ++i)
        marks.push_back({i * step / most, tick_text(i * step)});
    return marks;
}

Colour heat_colour(double t) {
    static constexpr std::array<Vec3, 5> stops{
        {{252, 248, 226}, {246, 208, 124}, {228, 132, 72}, {166, 52, 84}, {62, 14, 82}}};
    if (std::isnan(t))
        return {128, 128, 128};
    const double place = std::clamp(t, 0.0, 1.0) * double(stops.size() - 1);
    const auto first = std::min(static_cast<std::size_t>(place), stops.size() - 2);
    const Vec3 rgb = glm::mix(stops[first], stops[first + 1], place - double(first));
    const auto byte = [](double x) { return static_cast<std::uint8_t>(std::lround(x)); };
    return {byte(rgb.r), byte(rgb.g), byte(rgb.b)};
}

void draw_colour_bar(const Vec2& low, const Vec2& high, double most, const std::string& caption,
                     Canvas& canvas) {
    const double width = high.x - low.x;
    constexpr int cells = 128;
    for (int i = 0; i < cells; ++i) {
        // Each cell reaches to the end, under those that follow, so that no seams are seen.
        fill_box(canvas, {low.x + width * i / cells, low.y}, high, heat_colour((i + 0.5) / cells));
    }
    for (const BarMark& mark : round_marks(most)) {
        const double x = low.x + width * mark.place;
        canvas.line(std::array{Vec2(x, high.y), Vec2(x, high.y + 4)}, {});
        canvas.text({x, high.y + 16}, mark.text, {.anchor = Anchor::middle, .size = text_size});
    }
    canvas.text({(low.x + high.x) / 2, high.y + 33}, caption,
                {.anchor = Anchor::middle, .size = text_size});
}

} // namespace hemilux
