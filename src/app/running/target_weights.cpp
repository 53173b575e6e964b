#include "app/running/target_weights.h"

#include "app/settings/exit_code.h"
#include "app/settings/method_options.h"
#include "app/settings/names.h"
#include "io/files/error.h"
#include "parallel/workers.h"
#include "radiosity/engine/target/target.h"

#include <algorithm>
#include <cmath>

namespace hemilux {
namespace {

/// The pixels of the picture that stand for all, along its longer side; and the rays from each.
constexpr double max_pixels = 128;
constexpr unsigned rays_of_pixel = 4;

std::vector<double> weights_of_camera(const SolveSettings& settings, const Mesh& mesh,
                                      const Tracer& tracer) {
    const auto [width, height] = settings.view.size;
    const double share = std::min(1.0, max_pixels / std::max(width, height));
    const auto columns = static_cast<int>(std::ceil(share * width));
    const auto rows = static_cast<int>(std::ceil(share * height));
    const CameraRays camera(*settings.view.camera, mesh, static_cast<double>(width) / height);
    std::vector<SurfacePoint> seen;
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < columns; ++x) {
            const Ray ray = camera.ray((x + .5) / columns, (y + .5) / rows);
            if (const std::optional<Visible> at = look(mesh, tracer, ray))
                seen.push_back({ray.origin + at->hit.t * ray.direction,
                                mesh.patches()[at->patch].normal, at->hit.facet, at->patch});
        }
    return weights_of_points(mesh, tracer, seen, rays_of_pixel, Workers(settings.options.threads));
}

std::vector<double> weights_of_groups(const SolveSettings& settings, const Mesh& mesh) {
    const std::vector<std::string>& known = mesh.scene().groups;
    std::vector<std::uint32_t> groups;
    for (const std::string& name : settings.target.groups) {
        const auto found = std::ranges::find(known, name);
        if (found == known.end())
            throw UsageError("--for: " + unknown_name("group", name, known));
        groups.push_back(static_cast<std::uint32_t>(found - known.begin()));
    }
    return weights_of_groups(mesh, groups);
}

/// Returns the weight 1 for each patch on which a point lies, else 0.
std::vector<double> weights_of_points(const TargetPoints& of_file, const Mesh& mesh,
                                      const Tracer& tracer) {
    const auto& [path, points] = of_file;
    std::vector<double> weights(mesh.patches().size());
    for (const NamedPoint& point : points) {
        const std::uint32_t patch =
            sensor_at(mesh, tracer, mesh.frame().to_local(point.position), point.normal).patch;
        if (patch == none)
            throw InputError(path, point.line,
                             "--for: expected a point on a face that looks along its normal");
        weights[patch] = 1;
    }
    return weights;
}

} // namespace

void check_target(const SolveSettings& settings) {
    const TargetSettings& target = settings.target;
    if (target.names().empty())
        return;
    if (!settings.method->takes_target())
        throw UsageError(
            "--for: --method " + std::string(settings.method->name) +
            " solves for all patches alike; these take a target: " +
            names_of_methods([](const Method& method) { return method.takes_target(); }));
    if (settings.plain)
        throw UsageError("--for: --plain solves for all patches alike; leave one of them out");
    if (settings.options.literal)
        throw UsageError("--for: with --literal each patch shoots as many rays as any other; "
                         "leave one of them out");
    if (target.camera && !settings.view.camera)
        throw UsageError("--for camera needs the view of --camera, as the program chooses one by "
                         "the light");
}

std::vector<TargetPoints> points_of_target(const TargetSettings& target) {
    std::vector<TargetPoints> points;
    for (const std::string& path : target.points)
        points.push_back({path, read_points(path)});
    return points;
}

std::vector<double> target_weights(const SolveSettings& settings,
                                   std::span<const TargetPoints> points, const Mesh& mesh,
                                   const Tracer& tracer) {
    const TargetSettings& target = settings.target;
    std::vector<double> weights;
    if (target.camera)
        add_weights(weights, weights_of_camera(settings, mesh, tracer));
    if (!target.groups.empty())
        add_weights(weights, weights_of_groups(settings, mesh));
    for (const TargetPoints& of_file : points)
        add_weights(weights, weights_of_points(of_file, mesh, tracer));
    bool any = weights.empty();
    for (std::uint32_t i = 0; i < weights.size() && !any; ++i)
        any = weights[i] > 0 && mesh.material(i).reflectance != Vec3(0.0);
    if (!any)
        throw InputError(settings.scene.path, "nothing that --for names reflects light, so there "
                                              "is no error to solve it to");
    return weights;
}

} // namespace hemilux
