#pragma once
// What a row of view factors has besides surfaces.

#include <cstddef>
#include <cstdint>

namespace hemilux {

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

} // namespace hemilux
