#pragma once
// Estimates how far off the light may be: what its independent batches of rays show, and what none
// of their rays has shown.
//
// The batches differ by the noise of what they found. Nothing differs where none of them found
// anything: a window that no ray has left through, a lit room that no ray has reached through a
// hole. There the rule of three holds. If none of N rays met something, the share that would meet
// it is below 3 / N in 95 of 100 cases (missed_light.h). The errors below follow from that share by
// the balance of energy of each part of the scene. docs/making/numerics.md has the whole account
// and its assumptions.

#include "geometry/vector.h"

#include <cstdint>
#include <span>
#include <vector>

namespace hemilux {

class DirectLight;
class ExchangeMatrix;
class BatchLight;
class TransportSystem;
class Mesh;
class RayCounts;
class Workers;
struct RowSpread;

struct TransportErrors {
    std::vector<Vec3> standard_error; ///< error of the radiosity by patch [W/m2]
    double variance = 0;  ///< sum over patches of weight, local area and variance by batches
    double of_losses = 0; ///< the part of it that comes from how many rays were lost, by counting
    /// The same, of light that no random ray may have found, and of light that no shadow ray may
    /// have found.
    double missed = 0, missed_by_shadow_rays = 0;
    double missed_in_dark = 0; ///< the part of `missed` that more rays of `needs_rays` take away
    std::vector<std::uint32_t> part; ///< linked part of each patch, see linked_parts.h
    std::vector<bool> lit; ///< patches that light reaches on any stored path, or that emit
    /// The patches that are lit, and those of dark parts whose few rays leave so much uncertain
    /// that it counts beside `variance`.
    std::vector<bool> needs_rays;
};

/// The known parts of a solution; all of them outlive the call.
struct TransportResult {
    const Mesh& mesh;
    const TransportSystem& system;
    const BatchLight& light;
    std::span<const RayCounts> counts; ///< random rays, by batch
    const ExchangeMatrix& factors;     ///< factors of all batches
    const RowSpread& rows;
    const DirectLight& direct;
    std::span<const double> weight = {}; ///< weights by patch, in the sums of errors; empty: 1
};

/// Returns the weight of the squared error of a patch [local area].
[[nodiscard]] double weighted_area(const TransportResult& result, std::size_t patch);

[[nodiscard]] TransportErrors errors_of(const TransportResult& result, const Workers& workers);

} // namespace hemilux
