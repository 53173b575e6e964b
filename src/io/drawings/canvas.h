#pragma once
// Drawings are made of filled polygons, lines and text. Coordinates are pixels from the top left.

#include "geometry/vector.h"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hemilux {

/// A colour as on a screen: sRGB, 8 bits per channel.
struct Colour {
    std::uint8_t r = 0, g = 0, b = 0;
};

/// The colours of the writing in all drawings, and of the rays in them.
inline constexpr Colour ink{40, 40, 40}, ray_blue{0, 90, 200};

struct Stroke {
    Colour colour{};
    double width = 1; ///< [pixels]
    double dash = 0;  ///< length of dashes and of gaps between them [pixels]; 0: drawn through
};

/// The part of a text that stands at its place.
enum class Anchor { start, middle, end };

struct TextStyle {
    Anchor anchor = Anchor::start;
    double size = 13; ///< height of the line [pixels]
    Colour colour{};
};

class Canvas {
  public:
    virtual ~Canvas() = default;
    /// Fills a polygon by the even-odd rule.
    virtual void polygon(std::span<const Vec2> corners, Colour fill, double opacity) = 0;
    virtual void line(std::span<const Vec2> points, const Stroke& stroke) = 0;
    /// Draws one line of text; `at` is on its base line.
    virtual void text(const Vec2& at, std::string_view text, const TextStyle& style) = 0;
    /// Draws a small circle that shows a text under the pointer.
    virtual void dot(const Vec2& /*at*/, Colour /*colour*/, std::string_view /*text*/) {}
    /// Gives what is drawn from now on a class, by which a page finds it; empty: none.
    virtual void begin_class(std::string_view /*name*/) {}
};

class SvgCanvas final : public Canvas {
  public:
    SvgCanvas(int width, int height);
    void polygon(std::span<const Vec2> corners, Colour fill, double opacity) override;
    void line(std::span<const Vec2> points, const Stroke& stroke) override;
    void text(const Vec2& at, std::string_view text, const TextStyle& style) override;
    void dot(const Vec2& at, Colour colour, std::string_view text) override;
    void begin_class(std::string_view name) override;
    /// Returns the text of the whole file.
    [[nodiscard]] std::string document() const { return body_ + "</svg>\n"; }

  private:
    std::string body_, class_; ///< class_: the attribute of each element
};

/// Fills a rectangle whose sides lie along the axes.
void fill_box(Canvas& canvas, const Vec2& low, const Vec2& high, Colour fill, double opacity = 1);

} // namespace hemilux
