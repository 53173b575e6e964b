#pragma once
// Says what a scene needs: work that would not change its solution may be left out.
//
// The engine finds out (engine/needs/find_needs.h). Whoever knows nothing takes everything for
// needed.

#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace hemilux {

struct Needs {
    /// The channel whose solution each channel has: itself, or an earlier one in which all
    /// reflectances and emissions are the same; `dark` where nothing is emitted.
    std::array<int, 3> channel{0, 1, 2};
    static constexpr int dark = 3;

    /// False in a convex enclosure: nothing stands between two patches, and there is one surface in
    /// each direction, so densities need no rays.
    bool visibility = true;
    bool bounces = true; ///< false: nothing that light may reach reflects

    /// No ray can leave the scene or meet the back of a face, as its geometry proves. This leaves
    /// no work out; it says which errors are possible.
    bool closed = false;

    /// Returns whether a channel is to be solved by itself.
    [[nodiscard]] bool solves(int c) const { return channel[static_cast<std::size_t>(c)] == c; }

    /// Returns whether a patch may ever hold power to be shot. If not, it needs no rays and no
    /// hemisphere.
    [[nodiscard]] bool power(std::uint32_t patch) const {
        assert(idle.empty() || patch < idle.size()); // found for other patches
        return idle.empty() || !idle[patch];
    }

    std::vector<bool> idle;           ///< idle patches; empty where none is
    std::size_t black = 0, unlit = 0; ///< idle because it reflects nothing; because no light comes
};

/// The needs of a scene about which nothing is known: no work is left out.
inline const Needs everything_needed;

} // namespace hemilux
