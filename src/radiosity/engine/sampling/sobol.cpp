#include "radiosity/engine/sampling/sobol.h"

#include "radiosity/paper/sampling/rng.h"

#include <algorithm>
#include <bit>

namespace hemilux {
namespace {

using Words = std::array<std::uint32_t, max_dimensions>; // one per dimension, bits reversed

/// A primitive polynomial over GF(2) of some degree, with its inner coefficients as bits. It comes
/// with the first direction integers of Joe and Kuo's table: the j + 1 bits of m[j] reversed.
struct Polynomial {
    unsigned degree, inner;
    std::array<std::uint32_t, 3> m;
};
constexpr std::array<Polynomial, max_dimensions - 1> polynomials{
    {{1, 0, {1}}, {2, 1, {1, 3}}, {3, 1, {1, 3, 4}}, {3, 2, {1, 2, 4}}}};

/// Returns direction number j of each dimension. Bits are reversed, as the scrambling wants them:
/// the binary point is before the lowest bit.
constexpr std::array<Words, 32> direction_numbers() {
    std::array<Words, 32> v{};
    for (unsigned j = 0; j < 32; ++j) {
        v[j][0] = 1u << j;
        for (std::size_t d = 1; d < max_dimensions; ++d) {
            const auto& [degree, inner, m] = polynomials[d - 1];
            if (j < degree) {
                v[j][d] = m[j];
                continue;
            }
            v[j][d] = v[j - degree][d] ^ (v[j - degree][d] << degree);
            for (unsigned k = 1; k < degree; ++k)
                if ((inner >> (degree - 1 - k)) & 1u)
                    v[j][d] ^= v[j - k][d];
        }
    }
    return v;
}
constexpr std::array<Words, 32> numbers = direction_numbers();

/// Returns a point of the sequence that is not scrambled.
constexpr Words word_of(std::uint32_t index) {
    Words word{};
    for (; index != 0; index &= index - 1)
        for (std::size_t d = 0; d < max_dimensions; ++d)
            word[d] ^= numbers[static_cast<std::size_t>(std::countr_zero(index))][d];
    return word;
}

constexpr SobolSteps make_steps() {
    SobolSteps steps{};
    for (std::size_t d = 0; d < max_dimensions; ++d)
        for (std::uint32_t k = 0; k < samples_per_block; ++k)
            steps.step[d][k] = word_of(k)[d];
    return steps;
}
constexpr SobolSteps steps = make_steps();

} // namespace

template <std::size_t n>
SobolBlocks<n>::SobolBlocks(std::uint64_t seed) {
    std::uint64_t word = seed + 0x9e3779b97f4a7c15u - 0x632be59bd9b4e019u;
    for (std::size_t d = 0; d < n; d += 2) {
        word = mix_bits(word + 0x632be59bd9b4e019u);
        start_.seeds[d] = static_cast<std::uint32_t>(word);
        if (d + 1 < n)
            start_.seeds[d + 1] = static_cast<std::uint32_t>(word >> 32);
    }
}

template <std::size_t n>
void SobolBlocks<n>::move_to(std::uint32_t index) {
    block_ = index / samples_per_block;
    std::ranges::copy(word_of(static_cast<std::uint32_t>(block_ * samples_per_block)),
                      start_.first);
    sampling_kernels().sobol(start_, steps, n, points_.data());
}

template class SobolBlocks<4>;
template class SobolBlocks<5>;

} // namespace hemilux
