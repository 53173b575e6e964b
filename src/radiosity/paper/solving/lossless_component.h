#pragma once
// Finds light that cannot get out: patches that reflect all of it and from which all of it falls on
// such patches again. If one of them emits, there is no finite solution.
//
// Faces do not tell with certainty whether a scene is closed, so rays show it. Patches from which
// one ray has left the scene, or fallen on something that absorbs, let light out, and so do those
// whose rays meet them. Patches that remain when many rays have found no other way out trap the
// light. The search looks only at reflectances of exactly 1.

#include <cstdint>
#include <optional>
#include <vector>

namespace hemilux {

struct SolverInput;

struct LosslessComponent {
    int channel;
    std::vector<std::uint32_t> patches; ///< those that an emitter lights, in ascending order
    std::uint64_t rays;                 ///< number of rays, none of which got out
};

/// Finds such a component that holds an emitter; empty if there is none, or when interrupted. There
/// is no way out if `enough_rays` rays in a row have found none.
[[nodiscard]] std::optional<LosslessComponent> find_lossless_component(const SolverInput& input,
                                                                       double enough_rays);

} // namespace hemilux
