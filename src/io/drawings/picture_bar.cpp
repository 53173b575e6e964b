#include "io/drawings/picture_bar.h"

#include <algorithm>

#include <stb_easy_font.h>

namespace hemilux {

namespace {

/// Rows of the strip [pixels].
constexpr int strip = 56, bar_top = 6, bar_bottom = 18, tick_bottom = 22, mark_top = 26,
              caption_top = 41;

/// Fills a rectangle. What lies outside of the picture is left out.
void fill(Image& image, int left, int top, int right, int bottom, Colour colour) {
    for (int y = std::max(top, 0); y < std::min(bottom, image.height); ++y)
        for (int x = std::max(left, 0); x < std::min(right, image.width); ++x)
            image.at(x, y) = linear(colour);
}

/// Writes black letters, in ASCII, with the middle of the line at x.
void write(Image& image, int x, int top, std::string text) {
    struct Corner { // as the font gives it
        float x, y, z;
        unsigned char colour[4];
    };
    std::vector<Corner> corners(text.size() * 40);
    const auto bytes = static_cast<int>(corners.size() * sizeof(Corner));
    const int quads = stb_easy_font_print(0, 0, text.data(), nullptr, corners.data(), bytes);
    const int left = x - stb_easy_font_width(text.data()) / 2;
    for (std::size_t q = 0; q < static_cast<std::size_t>(quads); ++q) {
        const Corner &low = corners[4 * q], &high = corners[4 * q + 2];
        fill(image, left + static_cast<int>(low.x), top + static_cast<int>(low.y),
             left + static_cast<int>(high.x), top + static_cast<int>(high.y), {});
    }
}

} // namespace

glm::vec3 linear(Colour colour) {
    const auto channel = [](std::uint8_t byte) {
        return linear_from_srgb(static_cast<float>(byte) / 255.0f);
    };
    return {channel(colour.r), channel(colour.g), channel(colour.b)};
}

Image with_bar(const Image& picture, const std::function<Colour(double)>& colour,
               std::span<const BarMark> marks, std::string caption) {
    Image image(picture.width, picture.height + strip);
    std::ranges::copy(picture.pixels, image.pixels.begin());
    const int top = picture.height, middle = picture.width / 2;
    const int length = std::min(9 * picture.width / 10, 400), left = middle - length / 2;
    fill(image, 0, top, image.width, image.height, {255, 255, 255});
    for (int x = 0; x < length; ++x)
        fill(image, left + x, top + bar_top, left + x + 1, top + bar_bottom,
             colour((x + 0.5) / length));
    for (const BarMark& mark : marks) {
        const int x = left + static_cast<int>(mark.place * length);
        fill(image, x, top + bar_bottom, x + 1, top + tick_bottom, {});
        write(image, x, top + mark_top, mark.text);
    }
    write(image, middle, top + caption_top, std::move(caption));
    return image;
}

} // namespace hemilux
