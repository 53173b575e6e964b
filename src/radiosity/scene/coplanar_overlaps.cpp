#include "radiosity/scene/coplanar_overlaps.h"

#include "geometry/box.h"
#include "geometry/flat_polygon.h"
#include "geometry/polygon.h"
#include "geometry/rectangle_pairs.h"
#include "radiosity/sampling/rng.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace hemilux {
namespace {

/// What was computed in two ways may differ by as much, of the size of the scene.
constexpr double rounding = 0x1p-36;
/// Of facets narrower than this it is not known which way they face.
constexpr double narrowest = 0x1p-21;
/// Of the smaller one's area: to have less in common is to be neighbours.
constexpr double least_share = 0x1p-13;

Box box_of(const Polygon& shape) {
    Box box;
    for (const Vec3& corner : shape.corner)
        box.include(corner);
    return box;
}

/// Planes are told apart by their points nearest to a place through which hardly any plane goes:
/// three numbers that do not depend on which side is the front. They are put into cells, and where
/// rounding may have moved one over a border, into both.
class PlaneCells {
  public:
    /// None for what is too narrow.
    explicit PlaneCells(const Polygon& shape) {
        const Box bounds = box_of(shape);
        const Vec3 size = bounds.high - bounds.low, normal = shape.area_vector();
        const double square = glm::dot(normal, normal);
        const double per_width = std::sqrt(glm::dot(size, size) / square);
        if (!(per_width <= 1 / narrowest))
            return;
        const Vec3 foot = glm::dot(shape.corner[0] - place, normal) / square * normal;
        const Vec3 doubt(rounding * (1 + 4 * reach * per_width)); // the plane may be tilted
        first_ = cell_of(foot - doubt);
        last_ = cell_of(foot + doubt);
    }

    template <class Use>
    void for_each(const Use& use) const {
        for (std::uint64_t x = first_[0]; x <= last_[0]; ++x)
            for (std::uint64_t y = first_[1]; y <= last_[1]; ++y)
                for (std::uint64_t z = first_[2]; z <= last_[2]; ++z)
                    use((x << 32) | (y << 16) | z);
    }

  private:
    using Cell = std::array<std::uint64_t, 3>;
    static constexpr Vec3 place{1.3716, -1.6194, 1.8277};
    static constexpr double reach = 5; ///< from the place to the farthest corner of the scene
    static constexpr double cells_per_unit = 2048;
    /// 0, where axis-aligned planes have two of their numbers, is in the middle of a cell.
    static Cell cell_of(const Vec3& foot) {
        const Vec3 index = (foot + reach + 1.0) * cells_per_unit + 0.5; // positive
        return {std::uint64_t(std::int64_t(index.x)), std::uint64_t(std::int64_t(index.y)),
                std::uint64_t(std::int64_t(index.z))};
    }

    Cell first_{1, 1, 1}, last_{0, 0, 0};
};

/// Seen along an axis, counter-clockwise.
FlatPolygon outline_of(const Polygon& shape, const Vec3& normal, int axis) {
    const int x = (axis + 1) % 3, y = (axis + 2) % 3, n = shape.size();
    FlatPolygon outline;
    for (int i = 0; i < n; ++i) {
        const Vec3& corner =
            shape.corner[static_cast<std::size_t>(normal[axis] > 0 ? i : n - 1 - i)];
        outline.add({corner[x], corner[y]});
    }
    return outline;
}

/// The plane of a facet as heights along an axis.
class Heights {
  public:
    Heights(const Polygon& shape, const Vec3& normal, int axis)
        : x_((axis + 1) % 3), y_((axis + 2) % 3) {
        for (int i = 0; i < shape.size(); ++i)
            middle_ += shape.corner[static_cast<std::size_t>(i)] / double(shape.size());
        slope_ = -Vec2(normal[x_], normal[y_]) / normal[axis];
        height_ = middle_[axis];
    }
    [[nodiscard]] double at(const Vec2& point) const {
        return height_ + glm::dot(slope_, point - Vec2(middle_[x_], middle_[y_]));
    }

  private:
    int x_, y_;
    Vec3 middle_{0.0};
    Vec2 slope_;
    double height_;
};

bool lie_in_one_place(const Polygon& a, const Polygon& b) {
    const Vec3 normal_a = a.area_vector(), normal_b = b.area_vector();
    const int axis = largest_axis(normal_a);
    const FlatPolygon outline_a = outline_of(a, normal_a, axis);
    const FlatPolygon outline_b = outline_of(b, normal_b, axis);
    if (are_apart(outline_a, outline_b, rounding))
        return false;
    const FlatPolygon common = common_part(outline_a, outline_b);
    const double smaller = std::min(std::abs(normal_a[axis]), std::abs(normal_b[axis]));
    if (!(common.area() > least_share * smaller))
        return false;
    const Heights height_a(a, normal_a, axis), height_b(b, normal_b, axis);
    return std::all_of(common.corner.begin(),
                       common.corner.begin() + static_cast<std::ptrdiff_t>(common.size),
                       [&](const Vec2& point) {
                           return std::abs(height_a.at(point) - height_b.at(point)) <= 2 * rounding;
                       });
}

/// The corners in an order that does not depend on where a facet begins or which way it faces.
std::array<Vec3, 4> sorted_corners(const Facet& facet, std::span<const Vec3> vertices) {
    std::array<Vec3, 4> corners = polygon_of(vertices, facet.vertex).corner;
    std::sort(corners.begin(), corners.end() - (facet.is_triangle() ? 1 : 0),
              [](const Vec3& a, const Vec3& b) {
                  return std::array{a.x, a.y, a.z} < std::array{b.x, b.y, b.z};
              });
    if (facet.is_triangle())
        corners[3] = corners[2];
    return corners;
}

/// Equal for facets with the same corners.
std::uint64_t hash_of(const Facet& facet, std::span<const Vec3> vertices) {
    const auto bits = [](double x) { return std::bit_cast<std::uint64_t>(x + 0.0); }; // of -0, too
    std::uint64_t hash = 0;
    for (std::size_t i = 0; i < (facet.is_triangle() ? 3 : 4); ++i) {
        const Vec3& p = vertices[facet.vertex[i]];
        hash += mix_bits(bits(p.x) + mix_bits(bits(p.y) + mix_bits(bits(p.z))));
    }
    return hash;
}

/// Those that may have many of their corners: a count by hash leaves out most others at once.
std::vector<std::uint32_t> perhaps_many(const Scene& scene, std::span<const Vec3> vertices) {
    const std::size_t slots = std::bit_ceil(2 * scene.facets.size() + 64);
    std::vector<std::uint32_t> count(slots, 0), many;
    const auto slot_of = [&](const Facet& f) { return hash_of(f, vertices) & (slots - 1); };
    for (const Facet& facet : scene.facets)
        ++count[slot_of(facet)];
    if (std::ranges::none_of(count, [](std::uint32_t c) { return c > kept_alike; }))
        return many;
    for (std::uint32_t f = 0; f < scene.facets.size(); ++f)
        if (count[slot_of(scene.facets[f])] > kept_alike)
            many.push_back(f);
    return many;
}

/// One of many facets with the same corners.
struct Alike {
    std::array<Vec3, 4> corners;
    bool turned; ///< faces the other way than most of its normal's axis does
    double glow;
    std::uint32_t facet;

    Alike(const Scene& scene, std::span<const Vec3> vertices, std::uint32_t f)
        : corners(sorted_corners(scene.facets[f], vertices)), facet(f) {
        const Vec3 normal = polygon_of(vertices, scene.facets[f].vertex).area_vector();
        turned = normal[largest_axis(normal)] < 0;
        const Vec3& e = scene.materials[scene.facets[f].material].emission;
        glow = e.x + e.y + e.z;
    }
    /// By shape and side; then what is to lie on top first.
    [[nodiscard]] bool operator<(const Alike& other) const {
        for (std::size_t i = 0; i < corners.size(); ++i)
            for (int axis = 0; axis < 3; ++axis)
                if (corners[i][axis] != other.corners[i][axis])
                    return corners[i][axis] < other.corners[i][axis];
        if (turned != other.turned)
            return turned < other.turned;
        return glow != other.glow ? glow > other.glow : facet < other.facet;
    }
    [[nodiscard]] bool has_shape_of(const Alike& other) const {
        return corners == other.corners && turned == other.turned;
    }
};

std::vector<Buried> find_buried(const Scene& scene, std::span<const Vec3> vertices) {
    std::vector<Alike> alike;
    for (const std::uint32_t f : perhaps_many(scene, vertices))
        alike.emplace_back(scene, vertices, f);
    std::ranges::sort(alike, [](const Alike& a, const Alike& b) { return a < b; });
    std::vector<Buried> buried;
    for (std::size_t first = 0, k = 0; k < alike.size(); ++k) {
        if (!alike[k].has_shape_of(alike[first]))
            first = k;
        if (k - first >= kept_alike)
            buried.push_back({alike[k].facet, alike[first + kept_alike - 1].facet});
    }
    return buried;
}

class Finder {
  public:
    Finder(const Scene& scene, std::span<const Vec3> vertices, const OverlapLimits& limits)
        : scene_(scene), vertices_(vertices), left_(limits.comparisons), most_pairs_(limits.pairs) {
    }

    Overlaps find() {
        found_.buried = find_buried(scene_, vertices_);
        if (!found_.buried.empty())
            is_buried_.assign(scene_.facets.size(), false);
        for (const Buried& buried : found_.buried)
            is_buried_[buried.facet] = true;
        std::vector<Entry> entries = facets_by_plane();
        for (auto begin = entries.begin(); begin != entries.end();) {
            const auto end = std::find_if(begin, entries.end(),
                                          [&](const Entry& e) { return e.cell != begin->cell; });
            if (end - begin > 1)
                search({begin, end});
            begin = end;
        }
        std::ranges::sort(found_.pairs);
        found_.pairs.erase(std::unique(found_.pairs.begin(), found_.pairs.end()),
                           found_.pairs.end());
        return std::move(found_);
    }

  private:
    struct Entry {
        std::uint64_t cell; ///< of its plane
        std::uint32_t facet;
    };

    [[nodiscard]] Polygon shape(std::uint32_t facet) const {
        return polygon_of(vertices_, scene_.facets[facet].vertex);
    }

    /// Facets of one cell beside each other, without most of those that are alone in theirs.
    std::vector<Entry> facets_by_plane() const {
        std::vector<Entry> entries;
        entries.reserve(scene_.facets.size());
        const std::size_t slots = std::bit_ceil(2 * scene_.facets.size() + 64);
        const auto slot_of = [&](const Entry& e) { return mix_bits(e.cell) & (slots - 1); };
        std::vector<std::uint32_t> end(slots, 0);
        for (std::uint32_t f = 0; f < scene_.facets.size(); ++f) {
            if (!is_buried_.empty() && is_buried_[f])
                continue;
            PlaneCells(shape(f)).for_each([&](std::uint64_t cell) {
                entries.push_back({cell, f});
                ++end[slot_of(entries.back())];
            });
        }
        std::erase_if(entries, [&](const Entry& e) { return end[slot_of(e)] == 1; });
        for (std::uint32_t sum = 0; std::uint32_t & count : end)
            count = sum += count == 1 ? 0 : count;
        std::vector<Entry> sorted(entries.size());
        for (auto e = entries.rbegin(); e != entries.rend(); ++e)
            sorted[--end[slot_of(*e)]] = *e;
        for (std::size_t slot = 0; slot < slots; ++slot)
            by_cell(std::span(sorted).subspan(
                end[slot], (slot + 1 < slots ? end[slot + 1] : sorted.size()) - end[slot]));
        return sorted;
    }

    static void by_cell(std::span<Entry> of_one_slot) {
        if (!std::ranges::is_sorted(of_one_slot, {}, &Entry::cell))
            std::ranges::stable_sort(of_one_slot, {}, &Entry::cell);
    }

    /// Facets whose planes are in one cell.
    void search(std::span<const Entry> entries) {
        constexpr std::size_t few = 16;
        if (entries.size() > few)
            return search_many(entries);
        for (std::size_t i = 1; i < entries.size(); ++i) {
            const Polygon b = shape(entries[i].facet);
            const Box bounds_b = box_of(b);
            for (std::size_t j = 0; j < i; ++j) {
                const Polygon a = shape(entries[j].facet);
                const Box bounds_a = box_of(a);
                if (glm::all(glm::lessThanEqual(bounds_a.low, bounds_b.high + 2 * rounding)) &&
                    glm::all(glm::lessThanEqual(bounds_b.low, bounds_a.high + 2 * rounding)))
                    compare(entries[j].facet, entries[i].facet);
            }
        }
    }

    /// They are seen along each axis that is steep enough for any plane to have one. Two of a plane
    /// with several meet more than once.
    void search_many(std::span<const Entry> entries) {
        constexpr double steep = 0.57; // 1 / sqrt(3) and what neighbours in a cell may differ
        std::array<std::vector<Rectangle>, 3> seen;
        seen[static_cast<std::size_t>(largest_axis(shape(entries[0].facet).area_vector()))].reserve(
            entries.size());
        for (const Entry& entry : entries) {
            const Polygon polygon = shape(entry.facet);
            const Box bounds = box_of(polygon);
            const Vec3 normal = polygon.normal();
            for (int axis = 0; axis < 3; ++axis)
                if (std::abs(normal[axis]) > steep)
                    seen[static_cast<std::size_t>(axis)].push_back(
                        rectangle(bounds, entry.facet, axis));
        }
        for (std::vector<Rectangle>& rectangles : seen)
            if (!for_each_overlap(
                    std::move(rectangles),
                    [&](std::uint32_t a, std::uint32_t b) {
                        return compare(std::min(a, b), std::max(a, b));
                    },
                    boxes_per_comparison * left_))
                found_.complete = false;
    }

    /// Smaller by what may be rounding, so that most neighbours are apart.
    [[nodiscard]] Rectangle rectangle(const Box& bounds, std::uint32_t f, int axis) const {
        const int x = (axis + 1) % 3, y = (axis + 2) % 3;
        return {Vec2(bounds.low[x], bounds.low[y]) + rounding,
                Vec2(bounds.high[x], bounds.high[y]) - rounding, f, scene_.facets[f].face};
    }

    /// False where enough has been compared.
    bool compare(std::uint32_t a, std::uint32_t b) {
        if (left_ == 0 || found_.pairs.size() >= most_pairs_)
            return found_.complete = false;
        --left_;
        if (lie_in_one_place(shape(a), shape(b)))
            found_.pairs.push_back({a, b});
        return true;
    }

    const Scene& scene_;
    std::span<const Vec3> vertices_;
    /// Boxes are compared sooner than shapes.
    static constexpr std::size_t boxes_per_comparison = 16;
    std::size_t left_, most_pairs_;
    std::vector<bool> is_buried_; ///< by facet; empty where none is
    Overlaps found_;
};

} // namespace

Overlaps find_overlaps(const Scene& scene, std::span<const Vec3> vertices,
                       const OverlapLimits& limits) {
    return Finder(scene, vertices, limits).find();
}

} // namespace hemilux
