#include "io/drawings/false_colour.h"

#include "io/drawings/log_axis.h"
#include "io/drawings/picture_bar.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace hemilux {

namespace {

constexpr double within_scale = 0.99;
constexpr double min_scale = 1e-6;    ///< scale where pictures do not differ
constexpr double rounding = 1 + 1e-6; ///< rounding of floats

/// One side of the scale, from white outwards.
using Stops = std::array<glm::vec3, 4>;
constexpr Stops blues{{{255, 255, 255}, {146, 197, 222}, {33, 113, 181}, {5, 30, 80}}};
constexpr Stops reds{{{255, 255, 255}, {244, 165, 130}, {203, 40, 40}, {85, 0, 20}}};

glm::vec3 along(const Stops& stops, double t) {
    const double place = t * double(stops.size() - 1);
    const auto first = std::min(static_cast<std::size_t>(place), stops.size() - 2);
    return glm::mix(stops[first], stops[first + 1], static_cast<float>(place - double(first)));
}

/// Returns a scale that almost all of what differs is within.
double scale_of(const std::vector<float>& difference) {
    std::vector<float> sizes;
    for (const float d : difference)
        if (std::isfinite(d) && d != 0) // not the background
            sizes.push_back(std::abs(d));
    if (sizes.empty())
        return min_scale;
    const auto rank = static_cast<std::ptrdiff_t>(within_scale * double(sizes.size() - 1));
    std::ranges::nth_element(sizes, sizes.begin() + rank);
    return std::max(min_scale, double(sizes[static_cast<std::size_t>(rank)]));
}

/// Returns positive differences to mark on the bar: both ends of the logarithmic part and its
/// middle.
std::vector<double> marks(const DifferenceScale& scale) {
    if (scale.most < 4 * scale.typical)
        return {scale.most / 2, scale.most};
    std::vector<double> values{scale.most};
    if (scale.most > 15 * scale.typical)
        values.push_back(round_up(std::sqrt(scale.most * scale.typical) / 2, rounding));
    constexpr double too_near_to_0 = 0.2;
    if (scale.place(scale.typical) > too_near_to_0)
        values.push_back(scale.typical);
    return values;
}

} // namespace

Colour diverging_colour(double t) {
    if (std::isnan(t))
        return {128, 128, 128};
    const glm::vec3 rgb = along(t < 0 ? blues : reds, std::min(std::abs(t), 1.0));
    const auto byte = [](float x) { return static_cast<std::uint8_t>(std::lround(x)); };
    return {byte(rgb.r), byte(rgb.g), byte(rgb.b)};
}

std::vector<float> luminance_difference(const Image& picture, const Image& reference,
                                        double exposure) {
    if (picture.width != reference.width || picture.height != reference.height)
        throw std::invalid_argument("pictures of different sizes have no difference");
    std::vector<float> difference;
    difference.reserve(picture.pixels.size());
    for (std::size_t i = 0; i < picture.pixels.size(); ++i)
        difference.push_back(static_cast<float>(exposure) *
                             (luminance(picture.pixels[i]) - luminance(reference.pixels[i])));
    return difference;
}

double DifferenceScale::place(double difference) const {
    return std::asinh(difference / typical) / std::asinh(most / typical);
}

DifferenceScale common_scale(std::span<const std::vector<float>> differences) {
    std::vector<double> scales;
    for (const std::vector<float>& difference : differences)
        scales.push_back(scale_of(difference));
    if (scales.empty())
        return {};
    std::ranges::sort(scales);
    return {round_up(scales[(scales.size() - 1) / 2], rounding), round_up(scales.back(), rounding)};
}

Image false_colour(const std::vector<float>& difference, int width, int height,
                   const DifferenceScale& scale) {
    Image image(width, height);
    for (std::size_t i = 0; i < difference.size(); ++i)
        image.pixels[i] = linear(diverging_colour(scale.place(double(difference[i]))));
    std::vector<BarMark> bar{{0.5, "0 %"}};
    for (const double d : marks(scale)) {
        const double offset = scale.place(d) / 2;
        const std::string number = tick_text(100 * d) + " %";
        bar.push_back({0.5 + offset, "+" + number});
        bar.push_back({0.5 - offset, "-" + number});
    }
    return with_bar(
        image, [](double place) { return diverging_colour(2 * place - 1); }, bar,
        "luminance minus that of the reference, in per cent of white");
}

} // namespace hemilux
