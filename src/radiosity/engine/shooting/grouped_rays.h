#pragma once
// Draws rays that are listed: where on their patch they start, and where they go.

#include "bvh/tracer.h"
#include "radiosity/engine/shooting/shooting_rules.h"
#include "radiosity/engine/shooting/strategy.h"
#include "radiosity/paper/rays/patch_start.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace hemilux {

class Mesh;

/// Some rays from a patch into one of its cells.
struct RayGroup {
    std::uint32_t patch;
    std::uint16_t cell;
    std::uint32_t cell_first; ///< the number of the cell's first ray among all those of the patch
    std::uint32_t first;      ///< number of the group's first ray
    std::uint32_t rays;
    /// The power of a ray, Phi_ray / Phi_patch [-]; until the rays are drawn it is Phi_ray /
    /// Phi_tr.
    double ray_power;
};

/// This is what the rays are drawn from.
struct RaySource {
    const Mesh& mesh;
    std::span<const Vec2> turns; ///< turns by patch, Mesh::hemisphere_turn
    const CellDirections& directions;
    const Strategy& strategy;
    RayOrigins origins;
};

/// The rays of a list of groups in their order, some at a time. A ray depends on the stream, its
/// patch, its number there and its cell, not on what else is listed.
class GroupedRays {
  public:
    /// `memory` holds the rays between two calls and may be used again afterwards.
    GroupedRays(const RaySource& source, std::span<RayGroup> groups, std::uint64_t stream,
                std::vector<Ray>& memory);

    /// Returns the next rays, as many as a batch has room for; none if all have been drawn.
    [[nodiscard]] std::span<const Ray> next();
    /// Calls found(k, patch) for the rays that next() has given, in their order.
    template <class Found>
    void for_each_patch(const Found& found) const {
        std::size_t k = 0;
        for (const Run& run : runs_)
            for (std::uint32_t ray = 0; ray < run.rays; ++ray)
                found(k++, run.patch);
    }

  private:
    /// The rays of a patch in the current batch: those of one private cell, or those of shared
    /// cells.
    struct Run {
        std::uint32_t patch, rays;
        std::uint32_t own; ///< the private cell's place in own_, else none
    };
    struct OwnCell {
        PrivateCell cell;
        std::uint32_t first; ///< the number of its first ray
    };
    void list();
    void list_group(RayGroup& group, std::uint32_t rays);
    void list_private(RayGroup& group, std::uint32_t rays, const PrivateCell& own);
    void add_to_batch(RayGroup& group, std::uint32_t rays, std::uint16_t cell, double power);
    [[nodiscard]] const PatchStart& start_of(std::uint32_t patch);
    void fill(const Run& run, std::size_t first);
    void fill_private(const OwnCell& own, const PatchStart& start, std::size_t first,
                      std::span<Ray> rays);

    RaySource source_;
    std::span<RayGroup> groups_;
    std::uint64_t stream_;
    std::vector<Ray>& rays_;
    const PrivateCells* private_; ///< nullptr: the strategy has none
    std::uint32_t drawn_ = 0;     ///< rays of the first of groups_ that are drawn
    std::uint32_t listed_ = none; ///< the patch of that
    std::uint64_t key_ = 0;       ///< key of that patch's random numbers
    std::vector<Run> runs_;
    std::vector<OwnCell> own_;
    DirectionBatch batch_;
    std::optional<PatchStart> start_; ///< start of the last patch
};

} // namespace hemilux
