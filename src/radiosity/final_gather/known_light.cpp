#include "radiosity/final_gather/known_light.h"

#include "radiosity/final_gather/final_gather.h"
#include "radiosity/final_gather/surface_points.h"
#include "radiosity/sampling/rng.h"
#include "radiosity/scene/mesh.h"
#include "radiosity/solving/solution.h"
#include "radiosity/solving/stop_flag.h"

#include <cmath>
#include <limits>

namespace hemilux {

KnownLight::KnownLight(const Mesh& mesh, const Tracer& tracer, std::span<const Vec3> accurate,
                       std::size_t points, std::uint64_t seed, const Workers& workers,
                       const StopFlag& interrupted)
    : mesh_(mesh) {
    std::vector<SurfacePoint> at;
    std::vector<std::uint64_t> streams;
    for (const PatchPoint& point : points_over_surface(mesh, points, hash_words({seed, 0}))) {
        points_.push_back({point.patch, {}, {}});
        at.push_back(point.at);
        streams.push_back(hash_words({seed, at.size()}));
    }
    FinalGather gather(mesh, tracer, accurate);
    const std::vector<Vec3> irradiance = gather.irradiance(at, streams, 2, workers, interrupted);
    if (interrupted) {
        points_.clear();
        return;
    }
    for (std::size_t k = 0; k < points_.size(); ++k) {
        const Vec3& reflectance = mesh.material(points_[k].patch).reflectance;
        points_[k].reflected1 = reflectance * irradiance[2 * k];
        points_[k].reflected2 = reflectance * irradiance[2 * k + 1];
    }
}

double KnownLight::error(std::span<const Vec3> radiosity) const {
    double squares = 0, size = 0;
    for (const Point& point : points_) {
        const Vec3 value = radiosity[point.patch] - mesh_.material(point.patch).emission;
        squares += glm::dot(point.reflected1 - value, point.reflected2 - value);
        size += glm::dot(point.reflected1, point.reflected2);
    }
    return squares > 0 && size > 0 ? std::sqrt(squares / size)
                                   : std::numeric_limits<double>::quiet_NaN();
}

} // namespace hemilux
