#include "io/pictures/render.h"

#include "io/files/error.h"
#include "io/results/smooth.h"
#include "radiosity/sampling/workers.h"
#include "radiosity/scene/mesh.h"

#include <atomic>
#include <optional>
#include <stdexcept>
#include <vector>

namespace hemilux {
namespace {

/// Places in a pixel, both coordinates well spread: the set of Hammersley 1960, moved so that none
/// lies on the border.
std::vector<Vec2> pixel_samples(int count) {
    std::vector<Vec2> places;
    for (int i = 0; i < count; ++i) {
        double reversed = 0.5 / count, digit = 0.5;
        for (int bits = i; bits > 0; bits >>= 1, digit *= 0.5)
            reversed += digit * (bits & 1);
        places.emplace_back((i + 0.5) / count, reversed);
    }
    return places;
}

/// Radiosity at a point of a patch.
class Shading {
  public:
    Shading(const Mesh& mesh, std::span<const Vec3> radiosity, const RenderOptions& options)
        : mesh_(mesh), radiosity_(radiosity), classes_(options.classes) {
        if (!options.smooth)
            return;
        if (!classes_)
            classes_ = &own_classes_.emplace(find_corner_classes(mesh));
        corner_radiosity_ = smooth(mesh, *classes_, radiosity, options.slope);
    }
    Shading(const Shading&) = delete;
    Shading& operator=(const Shading&) = delete;

    Vec3 at(std::uint32_t patch, const Vec3& point) const {
        if (corner_radiosity_.empty())
            return radiosity_[patch];
        const auto weights = corner_weights(mesh_.patches()[patch].shape, point);
        Vec3 sum(0.0);
        for (std::size_t c = 0; c < weights.size(); ++c)
            sum += weights[c] * corner_radiosity_[classes_->of_patch[patch][c]];
        return sum;
    }

  private:
    const Mesh& mesh_;
    std::span<const Vec3> radiosity_;
    const CornerClasses* classes_;
    std::optional<CornerClasses> own_classes_;
    std::vector<Vec3> corner_radiosity_;
};

} // namespace

Image render(const Mesh& mesh, const Tracer& tracer, std::span<const Vec3> radiosity,
             const Camera& camera, const RenderOptions& options) {
    if (options.width < 1 || options.height < 1 || options.samples < 1)
        throw std::invalid_argument("a picture needs at least one pixel and one sample");
    const double width = options.width, height = options.height;
    const CameraRays rays(camera, mesh, width / height);
    const Shading shading(mesh, radiosity, options);
    const std::vector<Vec2> samples = pixel_samples(options.samples);
    Image image(options.width, options.height);
    const auto pixel = [&](int x, int y) {
        Vec3 sum(0.0);
        for (const Vec2& place : samples) {
            const Ray ray = rays.ray((x + place.x) / width, (y + place.y) / height);
            if (const std::optional<Seen> seen = look(mesh, tracer, ray))
                sum += shading.at(seen->patch, ray.origin + seen->hit.t * ray.direction);
        }
        return glm::vec3(sum / static_cast<double>(samples.size()));
    };
    std::atomic<bool> given_up{false};
    const auto rows = static_cast<std::size_t>(options.height);
    Workers(options.threads).for_chunks(rows, 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t y = begin; y < end; ++y) {
            if (given_up || (options.give_up && options.give_up())) {
                given_up = true;
                return;
            }
            for (int x = 0; x < options.width; ++x)
                image.at(x, static_cast<int>(y)) = pixel(x, static_cast<int>(y));
        }
    });
    if (given_up)
        throw Interrupted();
    return image;
}

} // namespace hemilux
