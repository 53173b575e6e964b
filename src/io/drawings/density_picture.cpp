#include "io/drawings/density_picture.h"

#include "io/drawings/picture_bar.h"

#include <algorithm>

namespace hemilux {

Image density_picture(const Mesh& mesh, const Tracer& tracer, std::span<const double> numbers,
                      const std::string& caption, const Camera& camera,
                      const RenderOptions& options) {
    const double most = numbers.empty() ? 0 : std::ranges::max(numbers);
    // This renders two pictures in one: the number, and how much of the pixel is covered at all.
    std::vector<Vec3> channels;
    for (const double number : numbers)
        channels.emplace_back(most > 0 ? number / most : 0.0, 1, 0);
    RenderOptions flat = options;
    flat.smooth = false;
    const Image seen = render(mesh, tracer, channels, camera, flat);
    Image image(options.width, options.height);
    for (std::size_t i = 0; i < seen.pixels.size(); ++i) {
        const float covered = seen.pixels[i].g;
        const double t = covered > 0 ? double(seen.pixels[i].r / covered) : 0;
        image.pixels[i] = glm::mix(glm::vec3(1), linear(heat_colour(t)), covered);
    }
    return with_bar(image, heat_colour, round_marks(most), caption);
}

} // namespace hemilux
