#pragma once
// The light at points that are asked for, learned until it is right there.
//
// Gathers at the points of a target read the light of surfaces. Walks from these points find what
// they lack (walks.h). Round by round, they first say how far off gathers are that read what was
// known before the round: each part of the target has two groups of walks, and the mean product of
// what both find to be missing is the squared error, without their noise. Then they join what is
// known. So cells are refined where the target looks, until the question is answered.

#include "radiosity/light/cached_light/irradiance_cells.h"
#include "radiosity/light/cached_light/surface_light.h"

#include <atomic>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace hemilux {

class StopFlag;
class Tracer;
class Workers;
struct SurfacePoint;

/// A part of a target, whose points lie near each other.
struct TargetPart {
    std::vector<SurfacePoint> points;
    std::vector<Vec3> reflectance; ///< by point: factor of the irradiance that counts
    double weight = 1;             ///< of its squared error and its light
};

struct LearnOptions {
    std::uint64_t seed = 1;
    /// Walks end once the error is surely below this [-].
    double error = .01;
    /// Walks also go on until the error is known to this share of itself, if that is above 0, or
    /// matters little beside `error`.
    double accuracy = 0;
    std::uint64_t max_rays = 30'000'000;
    /// No round of walks is begun that would end later than this time [s], if there is an end.
    std::optional<double> seconds = {};
    /// Is set to the share of the walks that is done, as far as the error so far tells their
    /// number.
    std::atomic<double>* share = nullptr;
};

/// The error of gathers over a target by what they read: RMS over its parts and channels, relative
/// to their light. Not a number where it is unknown.
struct ReadError {
    double error = std::numeric_limits<double>::quiet_NaN();
    /// The error is below it in 19 of 20 runs.
    double bound = std::numeric_limits<double>::quiet_NaN();
    /// One sigma of `error`.
    double uncertainty = std::numeric_limits<double>::quiet_NaN();
    /// What 95 of 100 places of the target are within, relative to the light there [-].
    double local = std::numeric_limits<double>::quiet_NaN();
    double level = 0; ///< RMS of the light of a channel over the target [W/m2]
    std::uint64_t walks = 0, rays = 0;
};

class LightCache {
  public:
    /// `light` is what patches send.
    LightCache(const Mesh& mesh, const Tracer& tracer, PatchLight light)
        : mesh_(mesh), tracer_(tracer), cells_(mesh, light), light_(mesh, light, &cells_) {}
    LightCache(const LightCache&) = delete;
    LightCache& operator=(const LightCache&) = delete;

    /// Learns the light that the target sees. If it was interrupted, the error is that of the
    /// rounds before, of which a few are needed to know it.
    ReadError learn(std::span<const TargetPart> target, const LearnOptions& options,
                    const Workers& workers, const StopFlag& interrupted);

    [[nodiscard]] const SurfaceLight& light() const { return light_; }
    [[nodiscard]] const IrradianceCells& cells() const { return cells_; }

  private:
    struct Round;
    template <class Done>
    Round take_walks(std::span<const TargetPart> target, std::size_t of_group, std::uint64_t seed,
                     const Workers& workers, const StopFlag& interrupted, const Done& done);

    const Mesh& mesh_;
    const Tracer& tracer_;
    IrradianceCells cells_;
    SurfaceLight light_;
};

} // namespace hemilux
