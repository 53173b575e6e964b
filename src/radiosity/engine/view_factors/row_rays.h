#pragma once
// The rays of a patch that find which others it sees, and how much of its view is sky, ground and
// the backs of faces.

#include "bvh/tracer.h"
#include "parallel/workers.h"

#include <array>
#include <cstdint>
#include <vector>

namespace hemilux {

class Mesh;
struct Monitor;

/// What a row of factors has besides patches.
enum class Open : std::uint8_t {
    sky,    ///< upper hemisphere of what leaves the scene
    ground, ///< lower hemisphere of it
    back    ///< backs of one-sided faces
};
inline constexpr std::size_t opens = 3;

/// A share of a patch's rays [-] and its standard error.
struct OpenShare {
    double factor = 0, standard_error = 0;
};

struct RowView {
    std::vector<std::uint32_t> seen; ///< patches, ascending
    std::array<OpenShare, opens> open;
};

/// The rays of a row are independent batches of scrambled Sobol points, whose spread is the error.
/// Reusable memory of one thread.
class RowRays {
  public:
    static constexpr std::uint32_t batches = 16;

    /// The mesh and the tracer must outlive this. `up` is the axis that points to the sky.
    RowRays(const Mesh& mesh, const Tracer& tracer, std::uint64_t seed, int up)
        : mesh_(mesh), tracer_(tracer), seed_(seed), up_(up) {}

    /// Traces `rays` rays of a patch by Lambert's law, a power of two, 256 at least.
    void trace(std::uint32_t patch, std::uint32_t rays, RowView& view);

  private:
    const Mesh& mesh_;
    const Tracer& tracer_;
    std::uint64_t seed_;
    int up_;
    std::vector<Ray> rays_;
    std::vector<std::uint32_t> receivers_;
};

/// Sky, ground and backs of all patches, without factors between them.
struct OpenViews {
    std::vector<std::array<OpenShare, opens>> open; ///< by patch
    std::uint64_t rays = 0;
};

/// Traces rays of each patch until the standard errors of its sky and its ground are at most
/// `error` of these, or of .01 where they are smaller. A patch gets 262 144 rays at most. The
/// result is void if the monitor was interrupted.
[[nodiscard]] OpenViews find_open_views(const Mesh& mesh, const Tracer& tracer, double error,
                                        std::uint64_t seed, int up, const Workers& workers,
                                        Monitor& monitor);

} // namespace hemilux
