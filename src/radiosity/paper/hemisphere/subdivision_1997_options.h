#pragma once
// Defines the user's parameters of the technique of 1997.

#include <cstdint>

namespace hemilux {

/// The user's parameters of the technique of 1997 (paper section 4). Each step makes four times as
/// many spherical triangles. A patch may have at most 16384 of them: parts times 4^(1 +
/// stored_steps + estimated_steps).
struct Subdivision1997Options {
    std::uint32_t stored_steps = 2; ///< n, 0 to 5: of counted surfaces; each takes rays and memory
    std::uint32_t estimated_steps = 1; ///< m, 0 to 6: of estimated ones
    /// The number of fictive parts of a patch, each with a hemisphere of its own: 1, 4, 16 or 64.
    std::uint32_t parts = 4;
};

} // namespace hemilux
