#pragma once
// Draws random numbers. Each (patch, step, bounce) has a stream of its own, so that results do not
// depend on which thread does what.

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <initializer_list>

namespace hemilux {

/// Maps 64-bit words to each other one to one, without visible structure (Stafford 2011, "Better
/// bit mixing", mix 13).
[[nodiscard]] constexpr std::uint64_t mix_bits(std::uint64_t x) {
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
}

/// Hashes several words. Each is mixed in turn: seeds in arithmetic progression would give streams
/// that are shifted copies of each other.
[[nodiscard]] constexpr std::uint64_t hash_words(std::initializer_list<std::uint64_t> words) {
    std::uint64_t h = 0x9e3779b97f4a7c15u;
    for (const std::uint64_t word : words)
        h = mix_bits(h ^ mix_bits(word + 0x632be59bd9b4e019u)) + 0x9e3779b97f4a7c15u;
    return mix_bits(h);
}

/// The generator xoshiro256++ (Blackman and Vigna 2021), with period 2^256 - 1.
class Rng {
  public:
    explicit constexpr Rng(std::uint64_t seed) {
        for (std::size_t i = 0; i < 4; ++i)
            state_[i] = mix_bits(seed + std::uint64_t{i + 1} * 0x9e3779b97f4a7c15u);
    }

    constexpr std::uint64_t bits() {
        const std::uint64_t result = std::rotl(state_[0] + state_[3], 23) + state_[0];
        const std::uint64_t t = state_[1] << 17;
        state_[2] ^= state_[0];
        state_[3] ^= state_[1];
        state_[1] ^= state_[2];
        state_[0] ^= state_[3];
        state_[2] ^= t;
        state_[3] = std::rotl(state_[3], 45);
        return result;
    }
    /// Draws a number uniform in (0,1): the middle of one of 2^52 equal intervals, so never on an
    /// edge or vertex.
    constexpr double uniform() { return (static_cast<double>(bits() >> 12) + 0.5) * 0x1p-52; }

  private:
    std::array<std::uint64_t, 4> state_{};
};

} // namespace hemilux
