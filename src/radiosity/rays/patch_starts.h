#pragma once
// How rays leave a patch: points on it, and the frame of its hemisphere.

#include "geometry/frame.h"
#include "geometry/polygon_sampler.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace hemilux {

class Mesh;

struct PatchStart {
    PolygonSampler points;
    Frame frame; ///< Mesh::hemisphere_frame
    std::uint32_t patch, facet;
};

/// Of all patches. In small scenes they are kept, 240 bytes a patch: patches shoot few rays at a
/// time, and to work them out each time takes a twentieth of a run.
class PatchStarts {
  public:
    /// The mesh outlives this.
    explicit PatchStarts(const Mesh& mesh);

    /// Refers to what is kept, or to what is put into `memory`.
    [[nodiscard]] const PatchStart& of(std::uint32_t patch,
                                       std::optional<PatchStart>& memory) const;

  private:
    [[nodiscard]] PatchStart make(std::uint32_t patch) const;

    const Mesh& mesh_;
    std::vector<PatchStart> kept_;
};

} // namespace hemilux
