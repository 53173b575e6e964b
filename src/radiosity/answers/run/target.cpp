#include "radiosity/answers/run/target.h"

#include "parallel/workers.h"
#include "radiosity/answers/views/camera_rays.h"
#include "radiosity/engine/target/target.h"
#include "radiosity/light/final_gather/light_at_points.h"
#include "radiosity/paper/scene/mesh.h"

#include <algorithm>
#include <cmath>

namespace hemilux {
namespace {

/// The pixels of the picture that stand for all, along its longer side; and the rays from each.
constexpr double max_pixels = 128;
constexpr unsigned rays_of_pixel = 4;

std::vector<double> weights_of_picture(const TargetPicture& picture, const Mesh& mesh,
                                       const Tracer& tracer, unsigned threads) {
    const auto [width, height] = picture.size;
    const double share = std::min(1.0, max_pixels / std::max(width, height));
    const auto columns = static_cast<int>(std::ceil(share * width));
    const auto rows = static_cast<int>(std::ceil(share * height));
    const CameraRays camera(picture.camera, mesh, static_cast<double>(width) / height);
    std::vector<SurfacePoint> seen;
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < columns; ++x) {
            const Ray ray = camera.ray((x + .5) / columns, (y + .5) / rows);
            if (const std::optional<Visible> at = look(mesh, tracer, ray))
                seen.push_back({ray.origin + at->hit.t * ray.direction,
                                mesh.patches()[at->patch].normal, at->hit.facet, at->patch});
        }
    return weights_of_points(mesh, tracer, seen, rays_of_pixel, Workers(threads));
}

std::uint32_t patch_at(const TargetPoint& point, const Mesh& mesh, const Tracer& tracer) {
    return sensor_at(mesh, tracer, mesh.frame().to_local(point.position), point.normal).patch;
}

} // namespace

std::optional<std::size_t> point_off_faces(const RunTarget& target, const Mesh& mesh,
                                           const Tracer& tracer) {
    const auto found = std::ranges::find_if(target.points, [&](const TargetPoint& point) {
        return patch_at(point, mesh, tracer) == none;
    });
    if (found == target.points.end())
        return {};
    return static_cast<std::size_t>(found - target.points.begin());
}

std::vector<double> target_weights(const RunTarget& target, const Mesh& mesh, const Tracer& tracer,
                                   unsigned threads) {
    std::vector<double> weights;
    if (target.picture)
        add_weights(weights, weights_of_picture(*target.picture, mesh, tracer, threads));
    if (!target.groups.empty())
        add_weights(weights, weights_of_groups(mesh, target.groups));
    if (!target.points.empty()) {
        std::vector<double> of_points(mesh.patches().size());
        for (const TargetPoint& point : target.points)
            if (const std::uint32_t patch = patch_at(point, mesh, tracer); patch != none)
                of_points[patch] = 1;
        add_weights(weights, of_points);
    }
    return weights;
}

bool reflects(const Mesh& mesh, const std::vector<double>& weights) {
    bool any = weights.empty();
    for (std::uint32_t i = 0; i < weights.size() && !any; ++i)
        any = weights[i] > 0 && mesh.material(i).reflectance != Vec3(0.0);
    return any;
}

} // namespace hemilux
