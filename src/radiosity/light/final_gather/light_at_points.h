#pragma once
// The light that arrives at points which a user names (sensors), and how large its error may be.

#include "radiosity/light/cached_light/surface_light.h"
#include "radiosity/light/final_gather/surface_points.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace hemilux {

class Mesh;
class Tracer;
class Workers;

/// A point of the local frame, moved onto the face that it lies on, with the patch there. `facet`
/// and `patch` are none if it lies on no face that looks along the normal. On a face means no
/// further from it than 1e-6 of the scene's size, and at most a degree from its normal.
struct Sensor {
    SurfacePoint at;
    std::uint32_t patch;
};
[[nodiscard]] Sensor sensor_at(const Mesh& mesh, const Tracer& tracer, const Vec3& position,
                               const Vec3& normal);

struct PointLight {
    Vec3 irradiance{0.0}; ///< [W/m2]
    /// The error of the irradiance [W/m2], by the spread of the gathers and by the error of the
    /// light that they read.
    Vec3 standard_error{0.0};
    bool is_known = true;
};

struct PointLightOptions {
    /// Rays are added until their noise, over all points and relative to their irradiance, is below
    /// this [-].
    double noise = .01;
    /// The number of cosine-distributed rays from each point, rounded up to 128, in place of that;
    /// 0: by `noise`. Shadow rays are a quarter of them. Four times as many halve the noise.
    unsigned rays = 0;
    unsigned max_rays = 1 << 20; ///< from a point
    /// From all points together: once there are as many, no more blocks of points are begun.
    std::uint64_t max_all_rays = std::numeric_limits<std::uint64_t>::max();
    double read_error = 0; ///< error by the light that is read [W/m2]
    std::uint64_t seed = 1;
    /// Is asked before each block of points but the first; true ends the work.
    std::function<bool()> give_up = {};
    /// The time [s] after which no more blocks of points but the first are begun, if there is an
    /// end.
    std::optional<double> seconds = {};
    /// Is set to the share of the rays that is done, as far as the noise so far tells their number.
    std::atomic<double>* share = nullptr;
};

/// The number of rays from a point at first: they say how many more are needed.
inline constexpr unsigned first_rays_of_point = 160;

/// The reason for which rays ended.
enum class PointsEnd { right, gave_up, rays, time };

struct LightAtPoints {
    /// By sensor; fewer than sensors where the work ended before the first rays of all were traced.
    /// A signal or a limit of time leaves those of the first block, some thousand points, too.
    std::vector<PointLight> lights;
    PointsEnd end = PointsEnd::right;
    double noise = 0;             ///< of rays, as PointLightOptions::noise [-]
    double noise_uncertainty = 0; ///< one sigma of it
    double noise_local = 0;       ///< what 95 of 100 points are within [-]
    std::uint64_t rays = 0;
};

/// Finds the light at each sensor.
[[nodiscard]] LightAtPoints light_at(std::span<const Sensor> sensors, const Mesh& mesh,
                                     const Tracer& tracer, const SurfaceLight& light,
                                     const PointLightOptions& options, const Workers& workers);

} // namespace hemilux
