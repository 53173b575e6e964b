#pragma once
// The light that arrives at points which a user names (sensors), and how large its error may be.

#include "radiosity/light/final_gather/surface_points.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace hemilux {

class Mesh;
class Tracer;
class Workers;
struct Solution;

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
    /// The error of the irradiance [W/m2]: by the spread of the gathers, and by the standard errors
    /// of the patches that their rays meet. It does not hold the error of the division. It is NaN
    /// where a patch's is.
    Vec3 standard_error{0.0};
};

struct PointLightOptions {
    /// The number of cosine-distributed rays from each point, rounded up to 128; shadow rays are a
    /// quarter of them. Four times as many halve the error of the gathers.
    unsigned rays = 4096;
    std::uint64_t seed = 1;
    /// Is asked before each block of points; true ends the work.
    std::function<bool()> give_up = {};
};

/// Finds the light at each sensor. The result is empty if it was given up.
[[nodiscard]] std::vector<PointLight> light_at(std::span<const Sensor> sensors, const Mesh& mesh,
                                               const Tracer& tracer, const Solution& solution,
                                               const PointLightOptions& options,
                                               const Workers& workers);

} // namespace hemilux
