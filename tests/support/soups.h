#pragma once
// Facets for the tests of tracers: random ones, and those on which tracers have failed.

#include "bvh/intersect.h"
#include "radiosity/paper/sampling/rng.h"

#include <cmath>
#include <vector>

namespace hemilux::test {

struct Soup {
    std::vector<Vec3> vertices;
    std::vector<FacetCorners> facets;

    [[nodiscard]] FacetSoup view() const { return {vertices, facets}; }
    void triangle(const Vec3& a, const Vec3& b, const Vec3& c) {
        const auto v = static_cast<std::uint32_t>(vertices.size());
        vertices.insert(vertices.end(), {a, b, c});
        facets.push_back({v, v + 1, v + 2, v + 2});
    }
    void quad(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
        const auto v = static_cast<std::uint32_t>(vertices.size());
        vertices.insert(vertices.end(), {a, b, c, d});
        facets.push_back({v, v + 1, v + 2, v + 3});
    }
};

[[nodiscard]] inline Vec3 point_within(Rng& rng, double size) {
    const double x = rng.uniform(), y = rng.uniform(), z = rng.uniform();
    return size * (2.0 * Vec3(x, y, z) - 1.0);
}

/// Triangles and parallelograms of many sizes.
[[nodiscard]] inline Soup random_soup(std::size_t facets, std::uint64_t seed) {
    Rng rng(seed);
    Soup soup;
    for (std::size_t f = 0; f < facets; ++f) {
        const Vec3 at = point_within(rng, 1);
        const double size = std::pow(10.0, -3 * rng.uniform());
        const Vec3 e = point_within(rng, size), g = point_within(rng, size);
        if (f % 2 == 0)
            soup.triangle(at, at + e, at + e + g);
        else
            soup.quad(at, at + e, at + e + g, at + g);
    }
    return soup;
}

/// Needles a million times as long as wide.
[[nodiscard]] inline Soup needles(std::size_t facets, std::uint64_t seed) {
    Rng rng(seed);
    Soup soup;
    for (std::size_t f = 0; f < facets; ++f) {
        const Vec3 at = point_within(rng, 1), along = point_within(rng, 1);
        const Vec3 across = 1e-6 * glm::cross(along, point_within(rng, 1));
        soup.triangle(at, at + along, at + 0.5 * along + across);
    }
    return soup;
}

/// Walls of n x n quads, so near to each other that single precision hardly tells them apart.
[[nodiscard]] inline Soup thin_walls(std::uint32_t n, double gap, int walls) {
    Soup soup;
    for (int w = 0; w < walls; ++w) {
        const double z = .3 + w * gap;
        const auto at = [&](std::uint32_t i, std::uint32_t j) {
            return Vec3(-1 + 2.0 * i / n, -1 + 2.0 * j / n, z);
        };
        for (std::uint32_t i = 0; i < n; ++i)
            for (std::uint32_t j = 0; j < n; ++j)
                soup.quad(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
    }
    return soup;
}

/// Quads that are none: folded, arrow-shaped, crossing themselves, collapsed.
[[nodiscard]] inline Soup odd_quads(std::size_t facets, std::uint64_t seed) {
    Rng rng(seed);
    Soup soup;
    for (std::size_t f = 0; f < facets; ++f) {
        const Vec3 at = point_within(rng, 1);
        const Vec3 e = point_within(rng, .3), g = point_within(rng, .3);
        switch (f % 4) {
        case 0:
            soup.quad(at, at + e, at + e + g, at + g + point_within(rng, .1));
            break;
        case 1:
            soup.quad(at, at + e, at + .3 * (e + g), at + g);
            break;
        case 2:
            soup.quad(at, at + e, at + g, at + e + g);
            break;
        default:
            soup.quad(at, at + e, at + 2.0 * e, at + e + g);
            break;
        }
    }
    return soup;
}

/// Quads of many sizes that are not quite planar, or not at all.
[[nodiscard]] inline Soup warped_quads(std::size_t facets, std::uint64_t seed) {
    Rng rng(seed);
    Soup soup;
    for (std::size_t f = 0; f < facets; ++f) {
        const double size = std::pow(10.0, -4 * rng.uniform());
        const double warp = std::pow(10.0, -1 - 7 * rng.uniform());
        const Vec3 at = point_within(rng, 1);
        const Vec3 e = point_within(rng, size), g = point_within(rng, size);
        soup.quad(at, at + e, at + e + g, at + g + point_within(rng, warp * size));
    }
    return soup;
}

/// Each a little smaller and nearer to a corner than the one before: trees become deep.
[[nodiscard]] inline Soup nested(std::size_t facets, double shrink) {
    Soup soup;
    double size = 1;
    for (std::size_t f = 0; f < facets; ++f, size *= shrink)
        soup.triangle({size, 0, .1 * size}, {0, size, .2 * size}, {.1 * size, .2 * size, size});
    return soup;
}

/// Many copies of a few facets.
[[nodiscard]] inline Soup copies(std::size_t facets, std::uint64_t seed) {
    Soup soup = random_soup(7, seed);
    const std::vector<FacetCorners> few = soup.facets;
    while (soup.facets.size() < facets)
        soup.facets.push_back(few[soup.facets.size() % few.size()]);
    return soup;
}

} // namespace hemilux::test
