#pragma once
// Sky, ground and backs of all patches, without factors between them.

#include "parallel/workers.h"
#include "radiosity/engine/factors/rows/open_share.h"

#include <array>
#include <cstdint>
#include <vector>

namespace hemilux {

class Mesh;
class SkyBands;
class Tracer;
struct Monitor;

struct OpenViewOptions {
    double error = .01; ///< of sky and ground, relative [-]
    bool ground = true; ///< whether it is asked of the ground, too
    std::uint64_t seed = 1;
    int up = 2; ///< axis that points to the sky
    const SkyBands* bands = nullptr;
};

struct OpenViews {
    std::vector<std::array<OpenShare, opens>> open; ///< by patch
    std::vector<OpenShare> bands;                   ///< by patch and band
    std::uint64_t rays = 0;
    std::uint64_t rows_left = 0; ///< patches that should have got more rays
    bool is_void = false;
};

/// Looks around with a few rays of each patch. Then rays to the sky alone, and to the ground alone,
/// ask whether anything is in their way, until the standard error is at most `error` of the share,
/// or of .01 where it is smaller. One that none of 1024 such rays found asks for no more, and each
/// gets 262 144 rays at most. The end of the monitor's time, or an interrupt, leaves patches with
/// the first rays; the result is void if an interrupt came before all had these.
[[nodiscard]] OpenViews find_open_views(const Mesh& mesh, const Tracer& tracer,
                                        const OpenViewOptions& options, const Workers& workers,
                                        Monitor& monitor);

} // namespace hemilux
