#pragma once
// The random numbers of one ray: a hash of the stream, of the ray's number in that, and of the
// attempt. So no ray depends on which others are traced (docs/paper/decisions.md, D14).

#include "geometry/vector.h"

#include <array>
#include <cstdint>

namespace hemilux::plain {

class RayNumbers {
  public:
    /// `key` is that of a patch in a bounce of a step; `number` that of the ray among those of the
    /// patch.
    RayNumbers(std::uint64_t key, std::uint32_t number)
        : low_(static_cast<std::uint32_t>(key)), high_(static_cast<std::uint32_t>(key >> 32)),
          number_(number) {}

    /// Returns two numbers for the point where the ray starts, uniform in (0,1).
    [[nodiscard]] Vec2 start() const {
        const std::array<double, 4> four = of_attempt(0);
        return {four[2], four[3]};
    }
    /// Returns the next number for the direction, uniform in (0,1). Each attempt has two.
    [[nodiscard]] double next() {
        const std::uint32_t attempt = taken_ / 2, which = taken_ % 2;
        ++taken_;
        return of_attempt(attempt)[which];
    }
    double operator()() { return next(); }

  private:
    /// Computes pcg4d of Jarzynski and Olano (2020, "Hash functions for GPU rendering").
    [[nodiscard]] std::array<double, 4> of_attempt(std::uint32_t attempt) const {
        std::array<std::uint32_t, 4> v{low_, high_, number_, attempt};
        for (std::uint32_t& word : v)
            word = word * 1664525u + 1013904223u;
        const auto mix = [&v] {
            v[0] += v[1] * v[3], v[1] += v[2] * v[0], v[2] += v[0] * v[1], v[3] += v[1] * v[2];
        };
        mix();
        for (std::uint32_t& word : v)
            word ^= word >> 16;
        mix();
        const auto uniform = [](std::uint32_t word) { return (double(word) + 0.5) * 0x1p-32; };
        return {uniform(v[0]), uniform(v[1]), uniform(v[2]), uniform(v[3])};
    }

    std::uint32_t low_, high_, number_, taken_ = 0;
};

} // namespace hemilux::plain
