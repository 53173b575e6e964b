// Drawings as pixels: everything is filled polygons on a grid that is finer than the picture, whose
// samples are averaged in the end.

#include "io/drawings/canvas.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <stb_easy_font.h>

namespace hemilux {

namespace {

/// Samples along each side of a pixel.
constexpr int fineness = 4;
/// Of stb_easy_font, in its own units: a line of text, and from its top to its base line.
constexpr double font_line = 12, font_base = 8;
/// What is added to letters on each side; they would be thin.
constexpr double bolder = 0.1;

/// Where the horizontal line through y crosses the polygon, ascending.
void crossings(std::span<const Vec2> corners, double y, std::vector<double>& found) {
    found.clear();
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Vec2 &a = corners[i], &b = corners[(i + 1) % corners.size()];
        if ((a.y <= y) != (b.y <= y))
            found.push_back(a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x));
    }
    std::ranges::sort(found);
}

/// The first sample whose middle is at or after the coordinate, within [0, count].
int first_sample(double coordinate, int count) {
    const double sample = std::ceil(coordinate * fineness - 0.5);
    return sample > 0 ? static_cast<int>(std::min(sample, double(count))) : 0; // NaN: the first
}

void blend(std::uint8_t& below, std::uint8_t above, double opacity) {
    below = static_cast<std::uint8_t>(std::lround(below + opacity * (above - below)));
}

/// What the font has letters for.
std::string plain_letters(std::string_view text) {
    std::string result(text);
    for (char& c : result)
        if (!(c >= ' ' && c <= '~'))
            c = '?';
    return result;
}

} // namespace

PixelCanvas::PixelCanvas(int width, int height)
    : width_(width), height_(height),
      samples_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * fineness *
                   fineness,
               Colour{255, 255, 255}) {}

void PixelCanvas::polygon(std::span<const Vec2> corners, Colour fill, double opacity) {
    if (corners.size() < 3)
        return;
    const auto [top, bottom] = std::ranges::minmax(corners, {}, [](const Vec2& p) { return p.y; });
    const int columns = width_ * fineness, rows = height_ * fineness;
    std::vector<double> edges;
    for (int row = first_sample(top.y, rows); row < first_sample(bottom.y, rows); ++row) {
        crossings(corners, (row + 0.5) / fineness, edges);
        Colour* const samples =
            samples_.data() + static_cast<std::size_t>(row) * static_cast<std::size_t>(columns);
        for (std::size_t i = 0; i + 1 < edges.size(); i += 2) {
            const int end = first_sample(edges[i + 1], columns);
            for (int column = first_sample(edges[i], columns); column < end; ++column) {
                Colour& sample = samples[column];
                blend(sample.r, fill.r, opacity);
                blend(sample.g, fill.g, opacity);
                blend(sample.b, fill.b, opacity);
            }
        }
    }
}

void PixelCanvas::disc(const Vec2& centre, double radius, Colour fill) {
    std::array<Vec2, 12> corners{};
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const double angle = 2 * std::numbers::pi * double(i) / double(corners.size());
        corners[i] = centre + radius * Vec2(std::cos(angle), std::sin(angle));
    }
    polygon(corners, fill, 1);
}

void PixelCanvas::segment(const Vec2& a, const Vec2& b, const Stroke& stroke) {
    const Vec2 along = b - a;
    const double length = glm::length(along);
    if (!(length > 0))
        return;
    const Vec2 across = stroke.width / 2 / length * Vec2(-along.y, along.x);
    polygon(std::array{a + across, b + across, b - across, a - across}, stroke.colour, 1);
}

void PixelCanvas::line(std::span<const Vec2> points, const Stroke& stroke) {
    double drawn = 0; // length so far, dashes and gaps
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        const Vec2 a = points[i], b = points[i + 1];
        const double length = glm::length(b - a);
        if (stroke.dash > 0) {
            const double end = drawn + length;
            for (double s = std::floor(drawn / (2 * stroke.dash)) * 2 * stroke.dash; s < end;
                 s += 2 * stroke.dash) {
                const double from = std::max(s, drawn), to = std::min(s + stroke.dash, end);
                if (from < to)
                    segment(a + (from - drawn) / length * (b - a),
                            a + (to - drawn) / length * (b - a), stroke);
            }
            drawn = end;
        } else {
            segment(a, b, stroke);
            if (i > 0)
                disc(a, stroke.width / 2, stroke.colour);
        }
    }
}

void PixelCanvas::text(const Vec2& at, std::string_view text, const TextStyle& style) {
    std::string letters = plain_letters(text);
    /// Four corners of x, y, z, colour each (stb_easy_font.h).
    constexpr std::size_t corner_bytes = 16, bytes_per_letter = 600;
    std::vector<float> vertices(letters.size() * bytes_per_letter / sizeof(float));
    const int quads = stb_easy_font_print(0, 0, letters.data(), nullptr, vertices.data(),
                                          static_cast<int>(vertices.size() * sizeof(float)));
    const double scale = style.size / font_line;
    const double width = scale * stb_easy_font_width(letters.data());
    const double share = style.anchor == Anchor::start    ? 0
                         : style.anchor == Anchor::middle ? 0.5
                                                          : 1;
    const Vec2 origin = at - Vec2(share * width, scale * font_base);
    for (std::size_t q = 0; q < static_cast<std::size_t>(quads); ++q) {
        std::array<Vec2, 4> corners{};
        for (std::size_t c = 0; c < 4; ++c) { // from the top left, clockwise
            const std::size_t first = (4 * q + c) * corner_bytes / sizeof(float);
            const Vec2 outwards(c == 1 || c == 2 ? 1 : -1, c >= 2 ? 1 : -1);
            corners[c] =
                origin + scale * (Vec2(vertices[first], vertices[first + 1]) + bolder * outwards);
        }
        polygon(corners, style.colour, 1);
    }
}

Image PixelCanvas::image() const {
    Image image(width_, height_);
    const auto columns = static_cast<std::size_t>(width_) * fineness;
    for (int y = 0; y < height_; ++y)
        for (int x = 0; x < width_; ++x) {
            glm::vec3 sum(0.0f); // of encoded values, as viewers of SVG do it
            for (std::size_t s = 0; s < fineness * fineness; ++s) {
                const std::size_t row = static_cast<std::size_t>(y) * fineness + s / fineness;
                const Colour& sample =
                    samples_[row * columns + static_cast<std::size_t>(x) * fineness + s % fineness];
                sum += glm::vec3(sample.r, sample.g, sample.b);
            }
            for (int c = 0; c < 3; ++c)
                image.at(x, y)[c] = linear_from_srgb(sum[c] / (255.0f * fineness * fineness));
        }
    return image;
}

void fill_box(Canvas& canvas, const Vec2& low, const Vec2& high, Colour fill, double opacity) {
    canvas.polygon(std::array{low, Vec2(high.x, low.y), high, Vec2(low.x, high.y)}, fill, opacity);
}

} // namespace hemilux
