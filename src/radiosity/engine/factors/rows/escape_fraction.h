#pragma once
// The part of a patch's light that meets no patch.

namespace hemilux {

/// The shares of a patch's rays [-] that met no patch.
struct EscapeFraction {
    double escaped = 0;  ///< left the scene
    double absorbed = 0; ///< fell on the back of a one-sided face

    [[nodiscard]] double sum() const { return escaped + absorbed; }
};

} // namespace hemilux
