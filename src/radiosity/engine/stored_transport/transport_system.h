#pragma once
// Solves the linear system of stored transport: what arrives at each patch in the end, from the
// rays that are kept. It is solved once for each of some independent batches of rays, whose spread
// is the error, and once for all together.

#include "parallel/workers.h"
#include "radiosity/engine/emitters/point_emitters.h"
#include "radiosity/engine/form_factors/exchange_matrix.h"
#include "radiosity/engine/linear/energy_ledger.h"
#include "radiosity/engine/linear/surfaces.h"
#include "radiosity/engine/stored_transport/batch_light.h"
#include "radiosity/paper/solving/stop_flag.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace hemilux {

class DirectLight;
class RayCounts;

/// Calls body(batch, workers) for each batch: by a thread of its own, or one after the other where
/// ranks solve each together.
template <class Body>
void for_batches(std::size_t batches, const Ranks& ranks, const Workers& workers,
                 const Body& body) {
    if (ranks.are_several())
        for (std::size_t batch = 0; batch < batches; ++batch)
            body(batch, workers);
    else
        workers.for_chunks(batches, 1,
                           [&](std::size_t batch, std::size_t) { body(batch, Workers(1)); });
}

class TransportSystem {
  public:
    /// Prepares the system. The light of `emitters` comes by shadow rays, not by random rays.
    /// `closed` says that no ray can leave the scene or meet the back of a face, as its geometry
    /// proves. `points` is the power of lights without extent.
    TransportSystem(const Mesh& mesh, std::span<const std::uint32_t> emitters, bool closed,
                    const PowerOfPoints& points = {});

    /// Returns, by patch, areas in local units, reflectances [-], emissions [W/m2].
    [[nodiscard]] std::span<const double> area() const { return surfaces_.area; }
    [[nodiscard]] std::span<const Vec3> reflectance() const { return surfaces_.reflectance; }
    [[nodiscard]] std::span<const Vec3> emission() const { return surfaces_.emission; }
    /// Returns the emission [W/m2] of the patches that random rays are to find, 0 elsewhere.
    [[nodiscard]] std::span<const Vec3> sampled_emission() const { return sampled_emission_; }
    /// Returns whether the geometry proves that no ray is lost.
    [[nodiscard]] bool closed() const { return closed_; }

    /// Returns the factors of each batch of rays. They refer to areas of this object.
    [[nodiscard]] std::vector<ExchangeMatrix> factors(std::span<const RayCounts> counts,
                                                      const Workers& workers) const;
    /// Solves for `light`, of each batch of factors and of the estimates of `shadow_rays`, from
    /// what `light` holds; the last light is then their mean. `error` is the relative one of what
    /// is known so far; nan where it is unknown. Where solving is interrupted `light` is of no use.
    struct SolvedBatches {
        double left = 0;    ///< relative residual where it is larger than it should be, else 0 [-]
        Vec3 variance{0.0}; ///< of the power that arrives straight from emitters, by channel
        double error = 0;   ///< relative standard error of what is reflected [-]
    };
    SolvedBatches solve_batches(std::span<const ExchangeMatrix> batches,
                                const DirectLight& shadow_rays, double error,
                                std::vector<BatchLight::Light>& light, const Workers& workers,
                                const StopFlag& interrupted) const;

    /// The factors of all batches, and how well the system was solved.
    struct Solved {
        ExchangeMatrix factors;
        /// A bound of the relative error of the light, of the batches or of all, where iterations
        /// ended at their limit [-], which may be infinite; else 0 (unsolved_light.h).
        double unsolved = 0;
    };
    /// Solves for `light` of each batch of `counts`, as above, and at last of all, as exactly as
    /// the noise of these rays allows.
    [[nodiscard]] Solved solve(std::span<const RayCounts> counts, const DirectLight& shadow_rays,
                               double error, std::vector<BatchLight::Light>& light,
                               const Workers& workers, const StopFlag& interrupted) const;

  private:
    /// Solves for one batch or for all. `direct` is the light that comes straight from emitting
    /// surfaces, and `variance` that of its power, by channel; `of_points` comes from lights
    /// without extent, if there are any. Returns the relative residual where it is larger than
    /// `residual`, else 0.
    [[nodiscard]] double solve(const ExchangeMatrix& factors, std::vector<Vec3> direct,
                               const Vec3& variance, std::span<const Vec3> of_points,
                               BatchLight::Light& light, const Workers& workers, double residual,
                               const StopFlag& interrupted) const;
    [[nodiscard]] Transport transport(const ExchangeMatrix& factors) const;
    double average(std::vector<BatchLight::Light>& light) const;
    std::vector<Vec3> straight_light(const ExchangeMatrix& factors, const DirectLight& shadow_rays,
                                     std::optional<std::size_t> batch,
                                     const Workers& workers) const;

    Surfaces surfaces_;
    std::vector<Vec3> sampled_emission_; ///< [W/m2]
    double lost_at_least_ = 1;           ///< share of what falls on a patch, in any channel
    bool closed_;
    PowerOfPoints points_;
};

} // namespace hemilux
