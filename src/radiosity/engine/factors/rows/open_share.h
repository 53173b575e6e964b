#pragma once
// What a row of view factors has besides surfaces.

#include <cstddef>
#include <cstdint>
#include <span>

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

/// Returns the share of rays that went one way, by the counts of more than three equal blocks of
/// `of_block` rays. Their spread is the error; `of_independent` is the variance of the mean as a
/// share of that of independent blocks. Where no ray, or each, went that way, the error is half of
/// what is possible in 95 % of all cases: three rays of so many.
[[nodiscard]] OpenShare share_of_blocks(std::span<const std::uint32_t> counts,
                                        std::uint32_t of_block, double of_independent = 1);

} // namespace hemilux
