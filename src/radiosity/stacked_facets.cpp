#include "radiosity/stacked_facets.h"

#include "geometry/box.h"
#include "geometry/polygon.h"
#include "radiosity/rng.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <tuple>
#include <utility>

namespace hemilux {
namespace {

/// Corners of less than this apart, of the size of the scene, are in one place: what was computed
/// in two ways may differ in the last bits.
constexpr double rounding = 0x1p-36;

/// Corners in an order that does not depend on where a facet begins and which way it runs, as whole
/// numbers.
using Place = std::array<Vec3, 4>;

bool before(const Vec3& a, const Vec3& b) {
    return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
}

Polygon shape_of(const Facet& facet, std::span<const Vec3> vertices) {
    Polygon shape;
    for (std::size_t i = 0; i < 4; ++i)
        shape.corner[i] = vertices[facet.vertex[i]];
    return shape;
}

/// A triangle's third corner stands there twice; here its first one does.
Place place_of(const Facet& facet, std::span<const Vec3> vertices, double unit) {
    Place place = shape_of(facet, vertices).corner;
    for (Vec3& corner : place)
        corner = glm::round(corner / unit);
    if (facet.is_triangle())
        place[3] = std::min({place[0], place[1], place[2]}, before);
    for (const auto& [low, high] : {std::pair{0u, 1u}, {2u, 3u}, {0u, 2u}, {1u, 3u}, {1u, 2u}})
        if (before(place[high], place[low]))
            std::swap(place[low], place[high]);
    return place;
}

std::uint64_t hash_of(const Place& place) {
    const auto word = [](double x) { return std::bit_cast<std::uint64_t>(x + 0.0); }; // -0 is 0
    std::uint64_t hash = 0;
    for (const Vec3& p : place)
        hash = hash_words({hash, word(p.x), word(p.y), word(p.z)});
    return hash;
}

class Stacker {
  public:
    Stacker(const Scene& scene, std::span<const Vec3> vertices)
        : scene_(scene), vertices_(vertices) {
        Box bounds;
        for (const Vec3& v : vertices)
            bounds.include(v);
        const Vec3 extent = bounds.extent();
        int exponent = 0;
        std::frexp(std::max({extent.x, extent.y, extent.z}), &exponent);
        unit_ = std::ldexp(rounding, exponent);
    }

    Stacks find() {
        std::vector<std::pair<std::uint64_t, std::uint32_t>> facets;
        facets.reserve(scene_.facets.size());
        for (std::uint32_t f = 0; f < scene_.facets.size(); ++f)
            facets.emplace_back(hash_of(place_of(scene_.facets[f], vertices_, unit_)), f);
        std::ranges::sort(facets);
        for (auto begin = facets.begin(); begin != facets.end();) {
            const auto end = std::find_if(begin, facets.end(),
                                          [&](const auto& f) { return f.first != begin->first; });
            if (end - begin > 1)
                stack({begin, end});
            begin = end;
        }
        return std::move(stacks_);
    }

  private:
    /// Facets with the same hash, by index.
    void stack(std::span<const std::pair<std::uint64_t, std::uint32_t>> facets) {
        const Place place = place_of(scene_.facets[facets[0].second], vertices_, unit_);
        const Vec3 normal = shape_of(scene_.facets[facets[0].second], vertices_).area_vector();
        std::array<std::vector<std::uint32_t>, 2> sides;
        for (const auto& [hash, f] : facets) {
            if (place_of(scene_.facets[f], vertices_, unit_) !=
                place) // by chance; it stays where it is
                continue;
            const Vec3 own = shape_of(scene_.facets[f], vertices_).area_vector();
            sides[glm::dot(own, normal) < 0 ? 1 : 0].push_back(f);
        }
        // The other side begins a step off this one.
        pile(sides[0], 0);
        pile(sides[1], 1);
    }

    void pile(std::vector<std::uint32_t>& side, std::uint32_t lowest) {
        const auto glow = [&](std::uint32_t f) {
            const Vec3& e = scene_.materials[scene_.facets[f].material].emission;
            return e.x + e.y + e.z;
        };
        std::ranges::stable_sort(side, [&](std::uint32_t a, std::uint32_t b) {
            return glow(a) > glow(b); // the first ends on top
        });
        for (std::size_t k = 0; k < side.size(); ++k) {
            const auto above = static_cast<std::uint32_t>(side.size() - 1 - k);
            stacks_.covered += k > 0;
            if (lowest + above == 0)
                continue;
            stacks_.lift.resize(scene_.facets.size());
            stacks_.lift[side[k]] = lowest + above;
        }
    }

    const Scene& scene_;
    std::span<const Vec3> vertices_;
    double unit_ = 1;
    Stacks stacks_;
};

} // namespace

Stacks find_stacks(const Scene& scene, std::span<const Vec3> vertices) {
    return Stacker(scene, vertices).find();
}

} // namespace hemilux
