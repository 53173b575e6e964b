#include "io/drawings/density_picture.h"

#include "io/drawings/colour_bar.h"

#include <algorithm>

namespace hemilux {

namespace {

constexpr int bar_strip = 56; ///< height of what is below the picture

glm::vec3 linear(Colour colour) {
    const auto channel = [](std::uint8_t byte) {
        return linear_from_srgb(static_cast<float>(byte) / 255.0f);
    };
    return {channel(colour.r), channel(colour.g), channel(colour.b)};
}

Image bar_picture(int width, double most, const std::string& caption) {
    PixelCanvas canvas(width, bar_strip);
    const double half = std::min(0.45 * width, 200.0), middle = width / 2.0;
    draw_colour_bar({{middle - half, 6}, {middle + half, 18}, most, caption}, canvas);
    return canvas.image();
}

} // namespace

Image density_picture(const Mesh& mesh, const Tracer& tracer, std::span<const double> numbers,
                      const std::string& caption, const Camera& camera,
                      const RenderOptions& options) {
    const double most = numbers.empty() ? 0 : std::ranges::max(numbers);
    // Two pictures in one: the number, and how much of the pixel is covered at all.
    std::vector<Vec3> channels;
    for (const double number : numbers)
        channels.emplace_back(most > 0 ? number / most : 0.0, 1, 0);
    RenderOptions flat = options;
    flat.smooth = false;
    const Image seen = render(mesh, tracer, channels, camera, flat);
    Image image(options.width, options.height + bar_strip);
    for (std::size_t i = 0; i < seen.pixels.size(); ++i) {
        const float covered = seen.pixels[i].g;
        const double t = covered > 0 ? double(seen.pixels[i].r / covered) : 0;
        image.pixels[i] = glm::mix(glm::vec3(1), linear(heat_colour(t)), covered);
    }
    const Image bar = bar_picture(options.width, most, caption);
    std::ranges::copy(bar.pixels,
                      image.pixels.begin() + static_cast<std::ptrdiff_t>(seen.pixels.size()));
    return image;
}

} // namespace hemilux
