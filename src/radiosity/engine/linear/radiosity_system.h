#pragma once
// Solves the radiosity equation with known form factors (Goral et al. 1984).

#include "geometry/vector.h"

#include <functional>
#include <span>
#include <vector>

namespace hemilux {

class Mesh;
struct Needs;

/// Computes y = F x, by patch.
using FormFactorProduct = std::function<void(std::span<const double> x, std::span<double> y)>;

struct ArrivingLight {
    std::vector<Vec3> incident; ///< sum_j F_ij B_j, by patch [W/m2]
    /// A bound of the relative error of the reflected light, in the worst channel, where the
    /// iterations ended before the residual was small [-], which may be infinite; else 0
    /// (unsolved_light.h).
    double unsolved = 0;
};

/// Returns what arrives at each patch where B = E + rho F B. It is found as B = E + R, R = rho F (E
/// + R), channel by channel, by GMRES from `radiosity` on. The residual is relative to the
/// reflected light R: beside a tiny emitter's light all of it could be too small to count.
/// Only the channels that the needs tell to solve are solved.
[[nodiscard]] ArrivingLight arriving_light(const FormFactorProduct& multiply, const Mesh& mesh,
                                           std::span<const Vec3> radiosity, const Needs& needs);

} // namespace hemilux
