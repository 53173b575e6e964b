#include "radiosity/answers/charts/chart_regions.h"

#include "bvh/tracer.h"
#include "geometry/frame.h"
#include "radiosity/answers/charts/flat_overlaps.h"
#include "radiosity/engine/needs/welded_edges.h"
#include "radiosity/paper/scene/mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <unordered_map>
#include <utility>

namespace hemilux {
namespace {

/// The least cosines between the normal of a facet and that of its region, and that of the
/// neighbour from which it is reached.
constexpr double min_cosine = .6, min_cosine_of_neighbours = .5;

/// A region joins a larger one beside it that has at least so many times its area, where all its
/// facets have this cosine to that.
constexpr double much_larger = 8, min_cosine_to_join = .4;

class Regions {
  public:
    Regions(const Mesh& mesh, std::span<const ChartSide> sides);

    std::vector<ChartRegion> find();

  private:
    using Neighbours = std::vector<std::vector<std::uint32_t>>;

    [[nodiscard]] Vec3 normal_of(std::uint32_t side) const {
        const ChartSide& of = sides_[side];
        const Vec3& normal = normals_[of.facet];
        return of.back ? -normal : normal;
    }
    [[nodiscard]] Polygon shape_of(std::uint32_t side) const {
        return mesh_.shape_of(sides_[side].facet);
    }
    [[nodiscard]] bool are_alike(std::uint32_t a, std::uint32_t b) const {
        const std::vector<Facet>& facets = mesh_.scene().facets;
        return facets[sides_[a].facet].material == facets[sides_[b].facet].material;
    }
    void find_neighbours();
    std::vector<std::uint32_t> grow(std::uint32_t seed);
    void separate(const Vec3& normal, std::vector<std::uint32_t>& region);
    [[nodiscard]] bool overlap(const Vec3& normal, std::span<const std::uint32_t> region) const;
    void join_small();
    [[nodiscard]] bool may_join(std::uint32_t small, std::uint32_t large) const;

    struct Region {
        Vec3 normal;
        std::vector<std::uint32_t> sides;
        double area = 0;
    };

    const Mesh& mesh_;
    std::span<const ChartSide> sides_;
    std::vector<Vec3> normals_; ///< by facet
    std::vector<double> areas_; ///< by facet
    Neighbours neighbours_;     ///< by side
    std::vector<Region> regions_;
    std::vector<std::uint32_t> region_of_; ///< by side
};

Regions::Regions(const Mesh& mesh, std::span<const ChartSide> sides)
    : mesh_(mesh), sides_(sides), neighbours_(sides.size()), region_of_(sides.size(), none) {
    for (std::uint32_t f = 0; f < mesh.scene().facets.size(); ++f) {
        const Polygon shape = mesh.shape_of(f);
        normals_.push_back(shape.normal());
        areas_.push_back(shape.area());
    }
    find_neighbours();
}

/// Sides are neighbours where their facets meet at an edge and they look the same way across it.
void Regions::find_neighbours() {
    std::vector<std::array<std::uint32_t, 2>> side_of(normals_.size(), {none, none});
    for (std::uint32_t s = 0; s < sides_.size(); ++s)
        side_of[sides_[s].facet][sides_[s].back ? 1 : 0] = s;
    const auto join = [&](std::uint32_t a, std::uint32_t b) {
        if (a == none || b == none || !are_alike(a, b) ||
            !(glm::dot(normal_of(a), normal_of(b)) > min_cosine_of_neighbours))
            return;
        neighbours_[a].push_back(b);
        neighbours_[b].push_back(a);
    };
    const std::vector<Edge> edges = welded_edges(mesh_.scene());
    for_each_place(edges, [&](auto first, auto last) {
        for (auto next = first + 1; next < last; ++next)
            for (const std::uint32_t a : side_of[(next - 1)->facet])
                for (const std::uint32_t b : side_of[next->facet])
                    join(a, b);
    });
}

/// Returns the sides that are reached from a seed, in the order in which they are met.
std::vector<std::uint32_t> Regions::grow(std::uint32_t seed) {
    const auto number = static_cast<std::uint32_t>(regions_.size());
    const Vec3 normal = normal_of(seed);
    std::vector<std::uint32_t> reached{seed};
    region_of_[seed] = number;
    for (std::size_t next = 0; next < reached.size(); ++next)
        for (const std::uint32_t neighbour : neighbours_[reached[next]])
            if (region_of_[neighbour] == none &&
                glm::dot(normal_of(neighbour), normal) > min_cosine) {
                region_of_[neighbour] = number;
                reached.push_back(neighbour);
            }
    return reached;
}

bool Regions::overlap(const Vec3& normal, std::span<const std::uint32_t> region) const {
    const Frame frame = Frame::from_normal(normal);
    std::vector<LaidPolygon> flat;
    for (const std::uint32_t side : region)
        flat.push_back(LaidPolygon::of(shape_of(side), frame.x, frame.y));
    return find_flat_overlap(flat).has_value();
}

/// Gives back the sides that lie over others which were met before them.
void Regions::separate(const Vec3& normal, std::vector<std::uint32_t>& region) {
    const Frame frame = Frame::from_normal(normal);
    std::vector<LaidPolygon> flat;
    for (const std::uint32_t side : region)
        flat.push_back(LaidPolygon::of(shape_of(side), frame.x, frame.y));
    const std::vector<bool> over = lie_over_earlier(flat);
    std::vector<std::uint32_t> kept;
    for (std::size_t k = 0; k < region.size(); ++k)
        if (over[k])
            region_of_[region[k]] = none;
        else
            kept.push_back(region[k]);
    region = std::move(kept);
}

bool Regions::may_join(std::uint32_t small, std::uint32_t large) const {
    const Vec3& normal = regions_[large].normal;
    for (const std::uint32_t side : regions_[small].sides)
        if (!(glm::dot(normal_of(side), normal) > min_cosine_to_join))
            return false;
    std::vector<std::uint32_t> both = regions_[large].sides;
    both.insert(both.end(), regions_[small].sides.begin(), regions_[small].sides.end());
    return !overlap(normal, both);
}

void Regions::join_small() {
    std::vector<std::uint32_t> order(regions_.size());
    std::iota(order.begin(), order.end(), 0u);
    std::ranges::stable_sort(order, {}, [&](std::uint32_t r) { return regions_[r].area; });
    for (const std::uint32_t small : order) {
        std::vector<std::uint32_t> beside;
        for (const std::uint32_t side : regions_[small].sides)
            for (const std::uint32_t neighbour : neighbours_[side])
                if (const std::uint32_t r = region_of_[neighbour];
                    r != small && std::ranges::find(beside, r) == beside.end() &&
                    regions_[r].area >= much_larger * regions_[small].area)
                    beside.push_back(r);
        std::ranges::stable_sort(beside, std::ranges::greater{},
                                 [&](std::uint32_t r) { return regions_[r].area; });
        for (const std::uint32_t large : beside) {
            if (!may_join(small, large))
                continue;
            Region& to = regions_[large];
            for (const std::uint32_t side : regions_[small].sides) {
                region_of_[side] = large;
                to.sides.push_back(side);
            }
            to.area += regions_[small].area;
            regions_[small].sides.clear();
            break;
        }
    }
}

std::vector<ChartRegion> Regions::find() {
    std::vector<std::uint32_t> order(sides_.size());
    std::iota(order.begin(), order.end(), 0u);
    std::ranges::stable_sort(order, std::ranges::greater{},
                             [&](std::uint32_t side) { return areas_[sides_[side].facet]; });
    // A seed stays in its region, so each round leaves fewer.
    for (bool all_found = false; !all_found;) {
        all_found = true;
        for (const std::uint32_t seed : order) {
            if (region_of_[seed] != none)
                continue;
            Region region{normal_of(seed), grow(seed), 0};
            const std::size_t reached = region.sides.size();
            separate(region.normal, region.sides);
            all_found = all_found && region.sides.size() == reached;
            for (const std::uint32_t side : region.sides)
                region.area += areas_[sides_[side].facet];
            regions_.push_back(std::move(region));
        }
    }
    join_small();
    std::vector<ChartRegion> found;
    for (const Region& region : regions_) {
        if (region.sides.empty())
            continue;
        ChartRegion& chart = found.emplace_back();
        chart.normal = region.normal;
        for (const std::uint32_t side : region.sides)
            chart.sides.push_back(sides_[side]);
    }
    return found;
}

} // namespace

std::vector<ChartRegion> find_chart_regions(const Mesh& mesh, std::span<const ChartSide> sides) {
    return Regions(mesh, sides).find();
}

PlaneAxes axes_of(const Mesh& mesh, const ChartRegion& region) {
    constexpr std::size_t max_candidates = 12;
    std::vector<Vec3> edges, corners;
    for (const ChartSide& side : region.sides) {
        const Polygon shape = mesh.shape_of(side.facet);
        for (std::size_t c = 0, n = static_cast<std::size_t>(shape.size()); c < n; ++c) {
            const Vec3 edge = shape.corner[(c + 1) % n] - shape.corner[c];
            edges.push_back(edge - glm::dot(edge, region.normal) * region.normal);
            corners.push_back(shape.corner[c]);
        }
    }
    const auto squared = [](const Vec3& edge) { return glm::dot(edge, edge); };
    std::ranges::stable_sort(edges, std::ranges::greater{}, squared);
    const auto extent_along = [&](const Vec3& axis) {
        double low = std::numeric_limits<double>::infinity(), high = -low;
        for (const Vec3& corner : corners) {
            low = std::min(low, glm::dot(corner, axis));
            high = std::max(high, glm::dot(corner, axis));
        }
        return high - low;
    };
    constexpr double clearly = .999; // by rounding no axis is better
    PlaneAxes best{};
    double least = std::numeric_limits<double>::infinity();
    std::vector<Vec3> tried;
    for (const Vec3& edge : edges) {
        if (!(squared(edge) > 0) || tried.size() == max_candidates)
            break;
        const Vec3 along = glm::normalize(edge), across = glm::cross(region.normal, along);
        constexpr double same_direction = .9999;
        const bool is_known = std::ranges::any_of(tried, [&](const Vec3& other) {
            return std::abs(glm::dot(other, along)) > same_direction ||
                   std::abs(glm::dot(other, across)) > same_direction;
        });
        if (is_known)
            continue;
        tried.push_back(along);
        const double width = extent_along(along), height = extent_along(across);
        if (width * height < clearly * least) {
            least = width * height;
            best = width >= height ? PlaneAxes{along, across} : PlaneAxes{across, along};
        }
    }
    if (tried.empty()) {
        const Frame frame = Frame::from_normal(region.normal);
        return {frame.x, frame.y};
    }
    return best;
}

} // namespace hemilux
