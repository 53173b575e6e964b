// Drawings as SVG 1.1: text that stays text, and lines without pixels.

#include "io/drawings/canvas.h"
#include "io/files/printable.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>

namespace hemilux {

namespace {

/// Returns a number rounded to hundredths of a pixel; no exponent, no locale.
std::string number(double x) {
    if (!std::isfinite(x))
        return "0";
    char buffer[64];
    const double rounded = std::round(100 * x) / 100 + 0.0; // no -0
    return {buffer, std::to_chars(buffer, buffer + sizeof buffer, rounded).ptr};
}

std::string hexadecimal(Colour colour) {
    std::array<char, 8> text{};
    std::snprintf(text.data(), text.size(), "#%02x%02x%02x", unsigned{colour.r}, unsigned{colour.g},
                  unsigned{colour.b});
    return text.data();
}

std::string point_list(std::span<const Vec2> points) {
    std::string text;
    for (const Vec2& p : points)
        text += (text.empty() ? "" : " ") + number(p.x) + ',' + number(p.y);
    return text;
}

std::string as_xml(std::string_view text) {
    std::string result;
    for (const char c : printable(text)) {
        if (c == '&')
            result += "&amp;";
        else if (c == '<')
            result += "&lt;";
        else
            result += c;
    }
    return result;
}

std::string attribute(std::string_view name, std::string_view value) {
    return " " + std::string(name) + "=\"" + std::string(value) + '"';
}

} // namespace

SvgCanvas::SvgCanvas(int width, int height) {
    const std::string w = std::to_string(width), h = std::to_string(height);
    body_ = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + w + "\" height=\"" + h +
            "\" viewBox=\"0 0 " + w + " " + h +
            "\" font-family=\"Helvetica, Arial, sans-serif\">\n"
            "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n";
}

void SvgCanvas::polygon(std::span<const Vec2> corners, Colour fill, double opacity) {
    body_ += "<polygon" + class_ + attribute("points", point_list(corners)) +
             attribute("fill", hexadecimal(fill)) + attribute("fill-rule", "evenodd");
    if (opacity < 1)
        body_ += attribute("fill-opacity", number(opacity));
    body_ += "/>\n";
}

void SvgCanvas::line(std::span<const Vec2> points, const Stroke& stroke) {
    body_ += "<polyline" + class_ + attribute("points", point_list(points)) +
             attribute("fill", "none") + attribute("stroke", hexadecimal(stroke.colour)) +
             attribute("stroke-width", number(stroke.width)) +
             attribute("stroke-linejoin", "round");
    if (stroke.dash > 0)
        body_ += attribute("stroke-dasharray", number(stroke.dash));
    body_ += "/>\n";
}

void SvgCanvas::text(const Vec2& at, std::string_view text, const TextStyle& style) {
    const char* const anchor = style.anchor == Anchor::start    ? "start"
                               : style.anchor == Anchor::middle ? "middle"
                                                                : "end";
    body_ += "<text" + class_ + attribute("x", number(at.x)) + attribute("y", number(at.y)) +
             attribute("font-size", number(style.size)) + attribute("text-anchor", anchor) +
             attribute("fill", hexadecimal(style.colour)) + ">" + as_xml(text) + "</text>\n";
}

void SvgCanvas::dot(const Vec2& at, Colour colour, std::string_view text) {
    body_ += "<circle" + class_ + attribute("cx", number(at.x)) + attribute("cy", number(at.y)) +
             attribute("r", "3.5") + attribute("fill", "#ffffff") +
             attribute("stroke", hexadecimal(colour)) + attribute("stroke-width", "1.4") +
             "><title>" + as_xml(text) + "</title></circle>\n";
}

void SvgCanvas::begin_class(std::string_view name) {
    class_ = name.empty() ? "" : attribute("class", name);
}

void fill_box(Canvas& canvas, const Vec2& low, const Vec2& high, Colour fill, double opacity) {
    canvas.polygon(std::array{low, Vec2(high.x, low.y), high, Vec2(low.x, high.y)}, fill, opacity);
}

} // namespace hemilux
