#include "radiosity/light/layers/coplanar_overlaps.h"

#include "geometry/box.h"
#include "geometry/flat_polygon.h"
#include "geometry/plane_cuts.h"
#include "geometry/polygon.h"
#include "radiosity/paper/sampling/rng.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <optional>
#include <utility>

namespace hemilux {
namespace {

/// Two ways to compute one quantity may differ by this much, as a share of the size of the scene.
constexpr double rounding = 0x1p-36;
/// Facets narrower than this [local units] have no reliable normal.
constexpr double narrowest = 0x1p-21;
/// Two facets that share less than this part of the smaller one's area are neighbours, not layers.
constexpr double min_share = 0x1p-13;

/// Calls use(cell) for the cells of a facet's plane; for none if the facet is too narrow. A plane
/// is identified by its point nearest to a place through which hardly any plane goes. Its three
/// numbers do not depend on which side is the front. They are put into cells, and where rounding
/// may have moved one over a border, into both.
template <class Use>
void for_each_plane_cell(const Polygon& shape, const Use& use) {
    constexpr Vec3 place{1.3716, -1.6194, 1.8277};
    constexpr double reach = 5; // from the place to the farthest corner of the scene
    constexpr double cells_per_unit = 2048;
    const Box bounds = box_of(shape.corner);
    const Vec3 size = bounds.high - bounds.low, normal = shape.area_vector();
    const double square = glm::dot(normal, normal);
    const double per_width = std::sqrt(glm::dot(size, size) / square);
    if (!(per_width <= 1 / narrowest))
        return;
    const Vec3 foot = glm::dot(shape.corner[0] - place, normal) / square * normal;
    const Vec3 doubt(rounding * (1 + 4 * reach * per_width)); // the plane may be tilted
    // The value 0, which axis-aligned planes have twice, is in the middle of a cell.
    const auto cell_of = [](const Vec3& point) {
        const Vec3 index = (point + reach + 1.0) * cells_per_unit + 0.5; // positive
        return std::array{std::uint64_t(std::int64_t(index.x)),
                          std::uint64_t(std::int64_t(index.y)),
                          std::uint64_t(std::int64_t(index.z))};
    };
    const auto first = cell_of(foot - doubt), last = cell_of(foot + doubt);
    for (std::uint64_t x = first[0]; x <= last[0]; ++x)
        for (std::uint64_t y = first[1]; y <= last[1]; ++y)
            for (std::uint64_t z = first[2]; z <= last[2]; ++z)
                use((x << 32) | (y << 16) | z);
}

/// Returns the outline seen along an axis, counter-clockwise.
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

/// Returns the height of a facet's plane along an axis, above or below a point seen along it.
double height_at(const Polygon& shape, const Vec3& normal, int axis, const Vec2& point) {
    const int x = (axis + 1) % 3, y = (axis + 2) % 3;
    Vec3 middle(0.0);
    for (int i = 0; i < shape.size(); ++i)
        middle += shape.corner[static_cast<std::size_t>(i)] / double(shape.size());
    const Vec2 slope = -Vec2(normal[x], normal[y]) / normal[axis];
    return middle[axis] + glm::dot(slope, point - Vec2(middle[x], middle[y]));
}

bool lie_in_one_place(const Polygon& a, const Polygon& b) {
    const Vec3 normal_a = a.area_vector(), normal_b = b.area_vector();
    const int axis = largest_axis(normal_a);
    const FlatPolygon outline_a = outline_of(a, normal_a, axis);
    const FlatPolygon outline_b = outline_of(b, normal_b, axis);
    if (are_apart(outline_a, outline_b, rounding))
        return false;
    const FlatPolygon common = common_part(outline_a, outline_b);
    const double smaller = std::min(std::abs(normal_a[axis]), std::abs(normal_b[axis]));
    if (!(common.area() > min_share * smaller))
        return false;
    return std::all_of(common.corner.begin(),
                       common.corner.begin() + static_cast<std::ptrdiff_t>(common.size),
                       [&](const Vec2& point) {
                           return std::abs(height_at(a, normal_a, axis, point) -
                                           height_at(b, normal_b, axis, point)) <= 2 * rounding;
                       });
}

/// Returns a hash that is equal for facets with the same corners that face one way, wherever they
/// begin.
std::uint64_t shape_of(const Facet& facet, std::span<const Vec3> vertices) {
    const auto bits = [](double x) { return std::bit_cast<std::uint64_t>(x + 0.0); }; // of -0, too
    std::uint64_t hash = 0;
    for (std::size_t i = 0; i < (facet.is_triangle() ? 3 : 4); ++i) {
        const Vec3& p = vertices[facet.vertex[i]];
        hash += mix_bits(bits(p.x) + mix_bits(bits(p.y) + mix_bits(bits(p.z))));
    }
    const Vec3 normal = polygon_of(vertices, facet.vertex).area_vector();
    return normal[largest_axis(normal)] < 0 ? ~hash : hash;
}

std::vector<Buried> find_buried(const Scene& scene, std::span<const Vec3> vertices) {
    struct Alike {
        std::uint64_t shape;
        double dark;
        std::uint32_t facet;
        auto operator<=>(const Alike&) const = default; ///< what is to lie on top first
    };
    std::vector<Alike> alike;
    for (std::uint32_t f = 0; f < scene.facets.size(); ++f) {
        const Vec3& e = scene.materials[scene.facets[f].material].emission;
        alike.push_back({shape_of(scene.facets[f], vertices), -(e.x + e.y + e.z), f});
    }
    std::ranges::sort(alike);
    std::vector<Buried> buried;
    for (std::size_t first = 0, k = 0; k < alike.size(); ++k) {
        if (alike[k].shape != alike[first].shape)
            first = k;
        if (k - first >= kept_alike)
            buried.push_back({alike[k].facet, alike[first + kept_alike - 1].facet});
    }
    return buried;
}

/// The rectangle that a facet covers, seen along an axis.
struct Rectangle {
    Vec2 low, high;
    std::uint32_t facet;
};

std::vector<Rectangle> rectangles_of(std::span<const PlanePiece> pieces) {
    std::vector<Rectangle> rectangles;
    for (const auto& [facet, outline] : pieces) {
        Rectangle r{outline.corner[0], outline.corner[0], facet};
        for (std::size_t i = 1; i < outline.size; ++i) {
            r.low = glm::min(r.low, outline.corner[i]);
            r.high = glm::max(r.high, outline.corner[i]);
        }
        rectangles.push_back(r);
    }
    return rectangles;
}

/// Calls use(pair) for rectangles that overlap, by a sweep along the first axis. Returns false
/// where there was more to be compared than allowed, or `use` returned false.
template <class Use>
bool sweep(std::vector<Rectangle>& seen, std::size_t most, const Use& use) {
    std::ranges::sort(seen, {}, [](const Rectangle& r) { return std::pair(r.low.x, r.facet); });
    for (auto a = seen.begin(); a != seen.end(); ++a)
        for (auto b = a + 1; b != seen.end() && b->low.x < a->high.x; ++b) {
            if (most-- == 0)
                return false;
            if (a->low.y < b->high.y && b->low.y < a->high.y &&
                !use(Overlap{std::min(a->facet, b->facet), std::max(a->facet, b->facet)}))
                return false;
        }
    return true;
}

/// Returns the pairs that overlap, where they are few and quickly found, as for tiles in rows of up
/// to a thousand.
std::optional<std::vector<Overlap>> few_near(std::vector<Rectangle>& seen) {
    constexpr std::size_t pairs_each = 16, boxes_each = 1024;
    std::vector<Overlap> near;
    const bool is_all = sweep(seen, boxes_each * seen.size(), [&](const Overlap& pair) {
        near.push_back(pair);
        return near.size() <= pairs_each * seen.size();
    });
    return is_all ? std::optional(std::move(near)) : std::nullopt;
}

class Finder {
  public:
    Finder(const Scene& scene, std::span<const Vec3> vertices, const OverlapLimits& limits)
        : scene_(scene), vertices_(vertices), left_(limits.comparisons), max_pairs_(limits.pairs) {}

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
        std::uint64_t cell; ///< cell of its plane
        std::uint32_t facet;
    };

    [[nodiscard]] Polygon shape(std::uint32_t facet) const {
        return polygon_of(vertices_, scene_.facets[facet].vertex);
    }

    /// Lists facets with the cells of their planes, so that facets of one cell are adjacent.
    std::vector<Entry> facets_by_plane() const {
        std::vector<Entry> entries;
        entries.reserve(scene_.facets.size());
        for (std::uint32_t f = 0; f < scene_.facets.size(); ++f)
            if (is_buried_.empty() || !is_buried_[f])
                for_each_plane_cell(shape(f), [&](std::uint64_t cell) {
                    entries.push_back({cell, f});
                });
        std::ranges::sort(entries, {}, &Entry::cell);
        return entries;
    }

    /// Searches facets whose planes are in one cell. They are seen along each axis that is steep
    /// enough for any plane to have one. Two facets whose planes have several such axes meet more
    /// than once.
    void search(std::span<const Entry> entries) {
        constexpr double steep = 0.57; // 1 / sqrt(3) and what neighbours in a cell may differ
        for (int axis = 0; axis < 3; ++axis) {
            std::vector<Rectangle> seen;
            for (const Entry& entry : entries) {
                const Polygon polygon = shape(entry.facet);
                if (std::abs(polygon.normal()[axis]) > steep)
                    seen.push_back(rectangle(box_of(polygon.corner), entry.facet, axis));
            }
            if (const auto near = few_near(seen))
                compare(*near);
            else
                cut_and_compare(pieces_of(seen, axis));
        }
    }

    /// Shrinks the rectangle by what may be rounding, so that most neighbours are apart.
    static Rectangle rectangle(const Box& bounds, std::uint32_t f, int axis) {
        const int x = (axis + 1) % 3, y = (axis + 2) % 3;
        return {Vec2(bounds.low[x], bounds.low[y]) + rounding,
                Vec2(bounds.high[x], bounds.high[y]) - rounding, f};
    }

    [[nodiscard]] std::vector<PlanePiece> pieces_of(std::span<const Rectangle> seen,
                                                    int axis) const {
        std::vector<PlanePiece> pieces;
        for (const Rectangle& r : seen) {
            const Polygon polygon = shape(r.facet);
            pieces.push_back({r.facet, outline_of(polygon, polygon.area_vector(), axis)});
        }
        return pieces;
    }

    /// Cuts pieces whose boxes overlap too often, until few do. Where cuts do not help, all pairs
    /// that overlap are compared.
    void cut_and_compare(std::vector<PlanePiece> pieces) {
        const bool may_cut = left_ > pieces.size();
        left_ -= may_cut ? pieces.size() : 0;
        auto halves = may_cut ? cut_in_two(pieces) : std::nullopt;
        if (!halves) {
            std::vector<Rectangle> seen = rectangles_of(pieces);
            if (!sweep(seen, boxes_per_comparison * left_,
                       [&](const Overlap& pair) { return compare(pair); }))
                found_.complete = false;
            return;
        }
        pieces = {};
        for (std::vector<PlanePiece>& half : *halves) {
            std::vector<Rectangle> seen = rectangles_of(half);
            if (const auto near = few_near(seen))
                compare(*near);
            else
                cut_and_compare(std::move(half));
        }
    }

    void compare(std::span<const Overlap> pairs) {
        if (!std::ranges::all_of(pairs, [&](const Overlap& pair) { return compare(pair); }))
            found_.complete = false;
    }

    /// Compares the shapes of a pair. Returns false where enough has been compared.
    bool compare(const Overlap& pair) {
        if (left_ == 0 || found_.pairs.size() >= max_pairs_)
            return false;
        --left_;
        if (lie_in_one_place(shape(pair.a), shape(pair.b)))
            found_.pairs.push_back(pair);
        return true;
    }

    const Scene& scene_;
    std::span<const Vec3> vertices_;
    /// Comparisons of boxes that cost as much as one of shapes.
    static constexpr std::size_t boxes_per_comparison = 16;
    std::size_t left_, max_pairs_;
    std::vector<bool> is_buried_; ///< marks by facet; empty where none is
    Overlaps found_;
};

} // namespace

Overlaps find_overlaps(const Scene& scene, std::span<const Vec3> vertices,
                       const OverlapLimits& limits) {
    return Finder(scene, vertices, limits).find();
}

} // namespace hemilux
