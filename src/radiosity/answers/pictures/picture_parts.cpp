#include "radiosity/answers/pictures/picture_parts.h"

#include "parallel/workers.h"
#include "radiosity/engine/rays/surface_point.h"
#include "radiosity/paper/sampling/rng.h"
#include "radiosity/paper/scene/mesh.h"

#include <cmath>
#include <optional>

namespace hemilux {
namespace {

/// About so many parts are spread over a picture.
constexpr double parts = 512;

/// The number of places of a part, and the distance within which they lie [pixels].
constexpr int places = 16;
constexpr double reach = 4;

struct Shown {
    SurfacePoint at;
    Vec3 reflectance;
};

std::optional<Shown> shown_at(const Mesh& mesh, const Tracer& tracer, const CameraRays& camera,
                              double x, double y) {
    const Ray ray = camera.ray(x, y);
    const std::optional<Visible> visible = look(mesh, tracer, ray);
    if (!visible)
        return std::nullopt;
    const Patch& patch = mesh.patches()[visible->patch];
    const Vec3 point = ray.origin + visible->hit.t * ray.direction;
    return Shown{{point, patch.normal, patch.facet, visible->patch},
                 colours_at(mesh, patch, point).reflectance};
}

TargetPart part_around(const Mesh& mesh, const Tracer& tracer, const CameraRays& camera,
                       const Vec2& middle, const Vec2& pixel, Rng& rng) {
    TargetPart part;
    const auto first = shown_at(mesh, tracer, camera, middle.x, middle.y);
    if (!first || mesh.material(first->at.patch).reflectance == Vec3(0.0))
        return part;
    for (int k = 0; k < places; ++k) {
        const double dx = rng.uniform() - .5, dy = rng.uniform() - .5;
        const auto shown = k == 0
                               ? first
                               : shown_at(mesh, tracer, camera, middle.x + 2 * reach * dx * pixel.x,
                                          middle.y + 2 * reach * dy * pixel.y);
        if (!shown || shown->at.facet != first->at.facet || shown->at.normal != first->at.normal)
            continue;
        part.points.push_back(shown->at);
        part.reflectance.push_back(shown->reflectance);
    }
    return part;
}

} // namespace

std::vector<TargetPart> picture_parts(const Mesh& mesh, const Tracer& tracer,
                                      const CameraRays& camera, int width, int height,
                                      std::uint64_t seed, const Workers& workers) {
    const double side = std::sqrt(double(width) * double(height) / parts);
    const auto columns = static_cast<std::size_t>(std::max(1.0, std::round(width / side))),
               rows = static_cast<std::size_t>(std::max(1.0, std::round(height / side)));
    std::vector<TargetPart> all(columns * rows);
    workers.for_chunks(all.size(), 8, [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k) {
            Rng rng(hash_words({seed, k}));
            const double x = rng.uniform(), y = rng.uniform();
            all[k] = part_around(mesh, tracer, camera,
                                 {(double(k % columns) + x) / double(columns),
                                  (double(k / columns) + y) / double(rows)},
                                 {1.0 / width, 1.0 / height}, rng);
        }
    });
    std::erase_if(all, [](const TargetPart& part) { return part.points.empty(); });
    return all;
}

} // namespace hemilux
