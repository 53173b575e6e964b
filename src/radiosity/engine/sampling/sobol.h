#pragma once
// Draws Owen-scrambled Sobol points in up to five dimensions. They say where on a patch a ray
// starts, where it goes, and to which of several lights.
//
// Any aligned block of 2^k points is a net: every dyadic box of volume 2^-k of dimensions (0,1)
// holds one of them. So smooth integrals converge almost as n^-3/2 instead of n^-1/2, and one can
// always go on. The direction numbers are those of Joe and Kuo (2008). The nested uniform
// scrambling of Owen (1995) is done by a hash (Laine and Karras 2011; Burley 2020): each seed gives
// an independent randomisation. Sixteen points at once cost little more than two.

#include "radiosity/engine/sampling/sampling_kernels.h"

#include <array>
#include <cstdint>

namespace hemilux {

/// The sequence of a seed, sixteen points at a time, in n <= 5 dimensions; each coordinate is
/// uniform in (0,1) over the seeds.
template <std::size_t n>
class SobolBlocks {
  public:
    explicit SobolBlocks(std::uint64_t seed);

    /// Moves on to the block that holds a point.
    void move_to(std::uint32_t index);
    /// Returns coordinate d of the points of the block; point `index` stands at index % 16.
    [[nodiscard]] const double* coordinate(std::size_t d) const {
        return &points_[samples_per_block * d];
    }
    /// Returns any point of the sequence. Consecutive indices cost least.
    [[nodiscard]] std::array<double, n> at(std::uint32_t index) {
        if (index / samples_per_block != block_)
            move_to(index);
        return point(index);
    }
    /// Returns a point of the present block.
    [[nodiscard]] std::array<double, n> point(std::uint32_t index) const {
        std::array<double, n> point;
        for (std::size_t d = 0; d < n; ++d)
            point[d] = coordinate(d)[index % samples_per_block];
        return point;
    }

  private:
    SobolBlockStart start_{};
    std::size_t block_ = ~std::size_t{0}; ///< none yet
    alignas(64) std::array<double, samples_per_block * n> points_;
};

extern template class SobolBlocks<4>;
extern template class SobolBlocks<5>;

} // namespace hemilux
