#include "radiosity/sobol.h"

#include "radiosity/rng.h"

namespace hemilux {
namespace {

constexpr std::size_t dimensions = 5;
using Words = std::array<std::uint32_t, dimensions>; // one per dimension

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
constexpr std::array<Polynomial, dimensions - 1> polynomials{
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
    for (std::size_t d = 0; d < dimensions; ++d) {
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

/// A hash in which each bit depends on itself and lower bits only: on reversed words it is a nested
/// uniform scrambling. The constants are those of Vegdahl (2021, "Building a better LK hash").
constexpr std::uint32_t permute(std::uint32_t x, std::uint32_t seed) {
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16) | 1u;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return x;
}

template <std::size_t n>
std::array<double, n> sobol(std::uint32_t index, std::uint64_t seed) {
    const std::uint64_t a = mix_bits(seed + 0x9e3779b97f4a7c15u);
    const std::uint64_t b = mix_bits(a + 0x632be59bd9b4e019u);
    const std::uint64_t c = mix_bits(b + 0x632be59bd9b4e019u);
    const Words seeds{static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(a >> 32),
                      static_cast<std::uint32_t>(b), static_cast<std::uint32_t>(b >> 32),
                      static_cast<std::uint32_t>(c >> 32)};
    index = reverse_bits(permute(reverse_bits(index), static_cast<std::uint32_t>(c)));

    std::array<std::uint32_t, n> word{};
    for (std::size_t group = 0; group < 8; ++group) {
        const Words& part = table[group][(index >> (4 * group)) & 15u];
        for (std::size_t d = 0; d < n; ++d)
            word[d] ^= part[d];
    }
    std::array<double, n> point{};
    for (std::size_t d = 0; d < n; ++d)
        point[d] = (static_cast<double>(reverse_bits(permute(word[d], seeds[d]))) + 0.5) * 0x1p-32;
    return point;
}

} // namespace

std::array<double, 4> sobol4(std::uint32_t index, std::uint64_t seed) {
    return sobol<4>(index, seed);
}

std::array<double, 5> sobol5(std::uint32_t index, std::uint64_t seed) {
    return sobol<5>(index, seed);
}

} // namespace hemilux
