#pragma once
// The rays of a patch that find which others it sees, and how much of its view is sky, ground and
// the backs of faces.

#include "bvh/tracer.h"
#include "parallel/workers.h"
#include "radiosity/engine/factors/pairs/facing_backs.h"
#include "radiosity/engine/factors/rows/open_share.h"

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace hemilux {

class Mesh;
class SkyBands;
struct Monitor;

/// A patch that rays of another hit, and how many.
struct SeenPatch {
    std::uint32_t patch, rays;
};

struct RowView {
    std::vector<SeenPatch> seen; ///< ascending
    std::array<OpenShare, opens> open;
    std::vector<OpenShare> bands; ///< of the sky
};

/// What rays look at.
struct RowScene {
    const Mesh& mesh;
    const Tracer& tracer;
    const FacingBacks& backs; ///< of the mesh
    std::uint64_t seed;
    int up; ///< axis that points to the sky
    const SkyBands* bands = nullptr;
};

/// The rays of a row are independent batches of scrambled Sobol points, whose spread is the error
/// (share_of_blocks). It is 0 where no direction of the patch goes one way, or no back faces it.
/// Reusable memory of one thread.
class RowRays {
  public:
    static constexpr std::uint32_t batches = 16;

    explicit RowRays(const RowScene& scene) : scene_(scene) {}

    /// Traces `rays` rays of a patch by Lambert's law, a power of two, 256 at least.
    void trace(std::uint32_t patch, std::uint32_t rays, RowView& view);

  private:
    RowScene scene_;
    FacingBacks::Last last_{};
    std::vector<std::uint32_t> band_counts_;
    std::vector<Ray> rays_;
    std::vector<std::uint32_t> receivers_, hit_;
};

/// Traces `rays` rays of every patch, as RowRays does, and calls keep(patch, view), from all
/// threads. `phase` is the monitor's. Returns false if an interrupt came before all were traced.
[[nodiscard]] bool
trace_all_rows(const RowScene& scene, std::uint32_t rays, const char* phase, const Workers& workers,
               Monitor& monitor,
               const std::function<void(std::uint32_t patch, const RowView& view)>& keep);

} // namespace hemilux
