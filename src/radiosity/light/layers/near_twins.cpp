#include "geometry/box.h"
#include "geometry/elementary.h"
#include "geometry/polygon.h"
#include "radiosity/light/layers/coplanar_layers.h"
#include "radiosity/light/layers/coplanar_overlaps.h"
#include "radiosity/paper/sampling/rng.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

namespace hemilux {
namespace {

/// The cells for corners are smaller than the width of the facet by this factor.
constexpr int cells_per_width = 18; // as a power of two
/// Twins on either side of a cell's border meet in another round, whose cells lie elsewhere.
constexpr int rounds = 4;
/// Cells of narrower facets [local units] could not be numbered.
constexpr double narrowest_twin = 0x1p-40;

/// Returns area over size, which is small for a sliver: slivers side by side are no twins.
double width_of(const Polygon& shape) {
    return shape.area() / glm::length(box_of(shape.corner).extent());
}

std::uint64_t hash_of_cell(const Vec3& corner, double cell, double shift) {
    std::uint64_t hash = 0;
    for (int axis = 0; axis < 3; ++axis)
        hash =
            mix_bits(hash + std::uint64_t(std::int64_t(std::floor(corner[axis] / cell + shift))));
    return hash;
}

/// Returns a key that is equal for twins, at whatever corner they begin. Facets that face the other
/// way have another key; those that have no twins have 0.
std::uint64_t key_of(const Polygon& shape, int round) {
    constexpr double golden = 0.6180339887;
    const double shift = golden * (round + 1); // no drawn wall is on a border
    const double width = width_of(shape) * elementary::exp2(double(round) / rounds);
    if (!(width > narrowest_twin))
        return 0;
    int exponent = 0;
    std::frexp(width, &exponent);
    const double cell = std::ldexp(1.0, exponent - cells_per_width);
    const auto size = static_cast<std::size_t>(shape.size());
    std::array<std::uint64_t, 4> corners{};
    for (std::size_t i = 0; i < size; ++i)
        corners[i] = hash_of_cell(shape.corner[i], cell, shift);
    std::uint64_t key = std::uint64_t(exponent);
    for (std::size_t i = 0; i < size; ++i)
        key += mix_bits(corners[i] + mix_bits(corners[(i + 1) % size]));
    return key;
}

/// Groups twins into heaps. The first facet of each heap stands for all of it.
class Heaps {
  public:
    Heaps(const Scene& scene, std::span<const Vec3> vertices)
        : scene_(scene), vertices_(vertices) {}

    /// Returns the first facet of each one's heap; empty where there are no heaps.
    std::vector<std::uint32_t> find() {
        if (!may_have_any())
            return {};
        first_.resize(scene_.facets.size());
        count_.assign(scene_.facets.size(), 1);
        for (std::uint32_t f = 0; f < first_.size(); ++f)
            first_[f] = f;
        for (int round = 0; round < rounds; ++round)
            unite(round);
        for (std::uint32_t f = 0; f < first_.size(); ++f)
            first_[f] = first_[first_[f]]; // which is earlier, so that it has been done
        return std::move(first_);
    }

  private:
    struct Entry {
        std::uint64_t key;
        std::uint32_t facet;
        auto operator<=>(const Entry&) const = default;
    };

    [[nodiscard]] std::uint64_t key(std::uint32_t f, int round) const {
        return key_of(polygon_of(vertices_, scene_.facets[f].vertex), round);
    }

    /// Counts keys in buckets, in which hardly ever more than a few meet by chance.
    [[nodiscard]] bool may_have_any() const {
        std::vector<std::uint8_t> counts(std::bit_ceil(scene_.facets.size()));
        for (std::uint32_t f = 0; f < scene_.facets.size(); ++f)
            if (const std::uint64_t k = key(f, 0);
                k != 0 && ++counts[k % counts.size()] > kept_alike)
                return true;
        return false;
    }

    void unite(int round) {
        std::vector<Entry> entries;
        for (std::uint32_t f = 0; f < first_.size(); ++f)
            if (const std::uint64_t k = first_[f] == f ? key(f, round) : 0; k != 0)
                entries.push_back({k, f});
        std::ranges::sort(entries);
        for (auto begin = entries.begin(); begin != entries.end();) {
            std::size_t facets = 0;
            auto end = begin;
            for (; end != entries.end() && end->key == begin->key; ++end)
                facets += count_[end->facet];
            if (facets > kept_alike) {
                for (auto other = begin; other != end; ++other)
                    first_[other->facet] = begin->facet;
                count_[begin->facet] = facets;
            }
            begin = end;
        }
    }

    const Scene& scene_;
    std::span<const Vec3> vertices_;
    std::vector<std::uint32_t> first_;
    std::vector<std::size_t> count_;
};

/// Returns the corners of one facet, beginning at that which is nearest to the first of another.
std::array<std::uint32_t, 4> begun_as(const Facet& facet, const Facet& other,
                                      std::span<const Vec3> vertices) {
    const std::size_t size = facet.is_triangle() ? 3 : 4;
    const auto distance = [&](std::uint32_t v) {
        return glm::length(vertices[v] - vertices[other.vertex[0]]);
    };
    std::array<std::uint32_t, 4> corners = facet.vertex;
    const auto end = corners.begin() + static_cast<std::ptrdiff_t>(size);
    std::rotate(corners.begin(), std::ranges::min_element(corners.begin(), end, {}, distance), end);
    if (size == 3)
        corners[3] = corners[2];
    return corners;
}

} // namespace

void unite_near_twins(Scene& scene, std::span<const Vec3> vertices) {
    const std::vector<std::uint32_t> first = Heaps(scene, vertices).find();
    for (std::uint32_t f = 0; f < first.size(); ++f)
        if (first[f] != f)
            scene.facets[f].vertex = begun_as(scene.facets[first[f]], scene.facets[f], vertices);
}

} // namespace hemilux
