#include "radiosity/sampling/sobol.h"

#include "radiosity/sampling/rng.h"

namespace hemilux {
namespace {

using Words = std::array<std::uint32_t, most_dimensions>; // one per dimension

constexpr std::uint32_t reverse_bits(std::uint32_t x) {
    x = (x >> 16) | (x << 16);
    x = ((x & 0xff00ff00u) >> 8) | ((x & 0x00ff00ffu) << 8);
    x = ((x & 0xf0f0f0f0u) >> 4) | ((x & 0x0f0f0f0fu) << 4);
    x = ((x & 0xccccccccu) >> 2) | ((x & 0x33333333u) << 2);
    return ((x & 0xaaaaaaaau) >> 1) | ((x & 0x55555555u) << 1);
}

/// A primitive polynomial over GF(2) of some degree, its inner coefficients as bits, and the first
/// direction integers m (Joe and Kuo's table).
struct Polynomial {
    unsigned degree, inner;
    std::array<std::uint32_t, 3> m;
};
constexpr std::array<Polynomial, most_dimensions - 1> polynomials{
    {{1, 0, {1}}, {2, 1, {1, 3}}, {3, 1, {1, 3, 1}}, {3, 2, {1, 1, 1}}}};

/// Direction number j of a dimension, the binary point before the highest bit.
constexpr std::array<std::uint32_t, 32> direction_numbers(std::size_t dimension) {
    std::array<std::uint32_t, 32> v{};
    for (unsigned j = 0; j < 32; ++j) {
        if (dimension == 0) {
            v[j] = 1u << (31 - j);
            continue;
        }
        const auto& [degree, inner, m] = polynomials[dimension - 1];
        if (j < degree) {
            v[j] = m[j] << (31 - j);
            continue;
        }
        v[j] = v[j - degree] ^ (v[j - degree] >> degree);
        for (unsigned k = 1; k < degree; ++k)
            if ((inner >> (degree - 1 - k)) & 1u)
                v[j] ^= v[j - k];
    }
    return v;
}

/// The xor of direction numbers for each value of each four bits of the index; bits reversed, as
/// the scrambling wants them.
using Table = std::array<std::array<Words, 16>, 8>;
constexpr Table make_table() {
    Table table{};
    for (std::size_t d = 0; d < most_dimensions; ++d) {
        const auto v = direction_numbers(d);
        for (std::size_t group = 0; group < 8; ++group)
            for (std::size_t value = 0; value < 16; ++value)
                for (std::size_t bit = 0; bit < 4; ++bit)
                    if ((value >> bit) & 1u)
                        table[group][value][d] ^= reverse_bits(v[4 * group + bit]);
    }
    return table;
}
constexpr Table table = make_table();

/// Those of the lowest four bits.
constexpr SobolSteps make_steps() {
    SobolSteps steps{};
    for (std::size_t d = 0; d < most_dimensions; ++d)
        for (std::size_t k = 0; k < samples_per_block; ++k)
            steps.step[d][k] = table[0][k][d];
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
    for (std::size_t d = 0; d < n; ++d) {
        start_.first[d] = 0;
        for (std::size_t group = 1; group < 8; ++group)
            start_.first[d] ^= table[group][(index >> (4 * group)) & 15u][d];
    }
    sampling_kernels().sobol(start_, steps, n, points_.data());
}

template class SobolBlocks<4>;
template class SobolBlocks<5>;

} // namespace hemilux
