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

/// The starts of all patches. In small scenes they are kept, 240 bytes a patch: patches shoot few
/// rays at a time, and to find them anew each time takes a twentieth of a run.
class PatchStarts {
  public:
    /// The mesh must outlive this object.
    explicit PatchStarts(const Mesh& mesh);

    /// The start of a patch: a reference to what is kept, or to what is put into `memory`.
    [[nodiscard]] const PatchStart& of(std::uint32_t patch,
                                       std::optional<PatchStart>& memory) const;

  private:
    [[nodiscard]] PatchStart make(std::uint32_t patch) const;

    const Mesh& mesh_;
    std::vector<PatchStart> kept_;
};

} // namespace hemilux
