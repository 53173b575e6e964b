#pragma once
// Keeps the rays of stored transport. There are independent batches of random rays, counted by what
// they hit, and shadow rays to the small emitters, with an estimate for each batch.

#include "radiosity/engine/emitters/direct_light.h"
#include "radiosity/engine/form_factors/exchange_matrix.h"
#include "radiosity/engine/form_factors/ray_counts.h"
#include "radiosity/engine/stored_transport/batch_light.h"
#include "radiosity/engine/stored_transport/ray_plan.h"
#include "radiosity/paper/solving/solver.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace hemilux {

class StoredRays {
  public:
    static constexpr unsigned batches = BatchLight::batches;

    /// Begins without rays, in generation 0.
    explicit StoredRays(const SolverInput& input);

    /// Returns the patches whose light comes by shadow rays.
    [[nodiscard]] std::span<const std::uint32_t> emitters() const { return emitters_; }
    /// Returns whether shadow rays bring any light.
    [[nodiscard]] bool has_shadow_rays() const {
        return !emitters_.empty() || !direct_->of_points().empty();
    }
    [[nodiscard]] std::span<const RayCounts> counts() const { return counts_; }
    [[nodiscard]] const DirectLight& direct() const { return *direct_; }

    /// Forgets all rays. Those of different generations are independent.
    void renew(std::uint64_t generation);
    /// Traces until each patch has so many rays in each batch. Returns the number of rays that this
    /// call traced. Where the monitor was interrupted meanwhile some patches have fewer, and
    /// another call takes up the rest. `share` is the part of a step that the random rays are.
    std::uint64_t trace_up_to(const PlannedRays& rays, double share, const Workers& workers);

    /// Returns the factors that the random rays of all batches show. `area` gives the area of each
    /// patch in local units.
    [[nodiscard]] ExchangeMatrix factors(std::span<const double> area,
                                         const Workers& workers) const;
    /// Returns, by patch, whether it is of a part of the scene (linked_parts.h) where a patch emits
    /// or has got light by a shadow ray. `emission` gives that of each patch.
    [[nodiscard]] std::vector<bool> lit_patches(std::span<const Vec3> emission) const;
    /// Returns the bytes of the random rays, on all ranks, which all call this.
    [[nodiscard]] std::uint64_t bytes_of_counts() const;
    /// Returns those that grow with the rays.
    [[nodiscard]] std::uint64_t bytes_of_hits() const;

    void save(StateWriter& state) const;
    /// Loads a state; throws StateError for what save() cannot have written of this mesh.
    void load(StateReader& state);

  private:
    SolverInput input_;
    std::vector<std::uint32_t> emitters_;
    std::vector<RayCounts> counts_; ///< counts by batch
    std::optional<DirectLight> direct_;
};

} // namespace hemilux
