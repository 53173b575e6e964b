#include "radiosity/light/layers/coplanar_layers.h"

#include "geometry/elementary.h"
#include "geometry/polygon.h"
#include "radiosity/light/layers/coplanar_overlaps.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

namespace hemilux {
namespace {

/// The facets that overlap with others, numbered in the order of the scene, with their neighbours.
class Graph {
  public:
    explicit Graph(std::span<const Overlap> pairs) {
        for (const auto& [a, b] : pairs)
            facets_.insert(facets_.end(), {a, b});
        std::ranges::sort(facets_);
        facets_.erase(std::unique(facets_.begin(), facets_.end()), facets_.end());
        neighbours_.resize(facets_.size());
        for (const auto& [a, b] : pairs) {
            const std::uint32_t i = number_of(a), j = number_of(b);
            neighbours_[i].push_back(j);
            neighbours_[j].push_back(i);
        }
    }

    [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(facets_.size()); }
    [[nodiscard]] std::uint32_t facet(std::uint32_t i) const { return facets_[i]; }
    [[nodiscard]] std::span<const std::uint32_t> neighbours(std::uint32_t i) const {
        return neighbours_[i];
    }

  private:
    [[nodiscard]] std::uint32_t number_of(std::uint32_t facet) const {
        return static_cast<std::uint32_t>(std::ranges::lower_bound(facets_, facet) -
                                          facets_.begin());
    }

    std::vector<std::uint32_t> facets_;
    std::vector<std::vector<std::uint32_t>> neighbours_;
};

/// The properties that decide which facet covers which.
struct Member {
    Vec3 normal;
    double area, glow; ///< glow: emission summed over channels
    double size_class; ///< class by powers of two, whose limits are no areas that anybody draws
    int side;          ///< +1 or -1: faces the way of the first of its layers, or the other
};

class LayerFinder {
  public:
    LayerFinder(const Scene& scene, std::span<const Vec3> vertices, const Graph& graph)
        : graph_(graph), level_(graph.size(), unset), height_(graph.size(), 0) {
        members_.reserve(graph.size());
        for (std::uint32_t i = 0; i < graph.size(); ++i)
            members_.push_back(member(scene, vertices, graph.facet(i)));
    }

    void layers() {
        for (std::uint32_t i = 0; i < graph_.size(); ++i)
            if (members_[i].side == 0) {
                find_layers(i);
                set_levels();
                set_heights();
            }
    }

    /// Returns the number of steps by which facet i of the graph moves to its front.
    [[nodiscard]] std::int32_t offset(std::uint32_t i) const {
        return members_[i].side * height_[i];
    }
    [[nodiscard]] bool is_covered(std::uint32_t i) const {
        return std::ranges::any_of(graph_.neighbours(i), [&](std::uint32_t j) {
            return members_[j].side == members_[i].side && offset(j) > offset(i);
        });
    }

  private:
    static Member member(const Scene& scene, std::span<const Vec3> vertices, std::uint32_t f) {
        constexpr double odd = 0.3719;
        const Vec3 normal = polygon_of(vertices, scene.facets[f].vertex).area_vector();
        const Vec3& e = scene.materials[scene.facets[f].material].emission;
        const double area = glm::length(normal);
        return {normal, area, e.x + e.y + e.z, std::floor(elementary::log2(area) + odd), 0};
    }

    /// Collects in stack_ all facets that are connected with i, and finds which way each of them
    /// faces.
    void find_layers(std::uint32_t i) {
        stack_ = {i};
        members_[i].side = 1;
        for (std::size_t k = 0; k < stack_.size(); ++k) {
            const Member& member = members_[stack_[k]];
            for (const std::uint32_t j : graph_.neighbours(stack_[k])) {
                if (members_[j].side != 0)
                    continue;
                const bool alike = glm::dot(members_[j].normal, member.normal) > 0;
                members_[j].side = alike ? member.side : -member.side;
                stack_.push_back(j);
            }
        }
    }

    /// Returns a negative number where a must lie lower than b, a positive one where it must lie
    /// higher, and 0 where either will do. Levels count along the front of side +1.
    [[nodiscard]] int order(std::uint32_t a, std::uint32_t b) const {
        const Member &x = members_[a], &y = members_[b];
        if (x.side != y.side)
            return x.side - y.side;
        if (x.glow != y.glow)
            return x.glow < y.glow ? -x.side : x.side;
        if (x.size_class != y.size_class)
            return x.size_class > y.size_class ? -x.side : x.side;
        return 0;
    }

    /// Sets levels from below. Each facet lies as low as what must be beneath it allows, and not on
    /// the level of another that it overlaps.
    void set_levels() {
        std::ranges::sort(stack_, [&](std::uint32_t a, std::uint32_t b) {
            const int o = order(a, b);
            return o != 0 ? o < 0 : members_[a].side > 0 ? a > b : a < b; // the first is on top
        });
        for (const std::uint32_t i : stack_) {
            std::int32_t level = 0;
            taken_.clear();
            for (const std::uint32_t j : graph_.neighbours(i)) {
                if (level_[j] == unset)
                    continue;
                if (order(j, i) < 0)
                    level = std::max(level, level_[j] + 1);
                else
                    taken_.push_back(level_[j]);
            }
            std::ranges::sort(taken_);
            for (const std::int32_t other : taken_)
                level += other == level;
            level_[i] = level;
        }
    }

    [[nodiscard]] std::int32_t lowest_above(std::uint32_t i, std::int32_t none,
                                            const std::vector<std::int32_t>& values) const {
        for (const std::uint32_t j : graph_.neighbours(i))
            if (level_[j] > level_[i])
                none = std::min(none, values[j]);
        return none;
    }

    /// Returns the level where most area can stay in place. That area belongs to facets on the
    /// level and to lower ones which nothing keeps from it.
    [[nodiscard]] std::int32_t find_rest() const {
        constexpr double as_much = 1 - 1e-3; // so that rounding decides nothing
        std::int32_t end = 0;
        for (const std::uint32_t i : stack_)
            end = std::max(end, level_[i] + 1);
        std::vector<double> area(static_cast<std::size_t>(end) + 1, 0.0);
        for (const std::uint32_t i : stack_) {
            area[static_cast<std::size_t>(level_[i])] += members_[i].area;
            area[static_cast<std::size_t>(lowest_above(i, end, level_))] -= members_[i].area;
        }
        std::partial_sum(area.begin(), area.end(), area.begin());
        const double most = *std::ranges::max_element(area);
        const auto rest = std::ranges::find_if(area, [&](double a) { return a >= as_much * most; });
        return static_cast<std::int32_t>(rest - area.begin());
    }

    /// Raises lower levels to the resting one, as far as others are not in their way.
    void set_heights() {
        const std::int32_t rest = find_rest();
        std::ranges::sort(stack_, std::ranges::greater(),
                          [&](std::uint32_t i) { return std::pair(level_[i], i); });
        for (const std::uint32_t i : stack_)
            height_[i] = level_[i] > rest ? level_[i] - rest : lowest_above(i, 1, height_) - 1;
    }

    static constexpr std::int32_t unset = -1;
    const Graph& graph_;
    std::vector<Member> members_;
    std::vector<std::int32_t> level_;  ///< level, counted from the lowest layer
    std::vector<std::int32_t> height_; ///< height over where it was, along the front of side +1
    std::vector<std::int32_t> taken_;
    std::vector<std::uint32_t> stack_;
};

} // namespace

CoplanarLayers find_coplanar_layers(const Scene& scene, std::span<const Vec3> vertices) {
    const Overlaps overlaps = find_overlaps(scene, vertices);
    CoplanarLayers layers{.offset = {}, .buried = {}, .covered = 0, .complete = overlaps.complete};
    if (overlaps.pairs.empty() && overlaps.buried.empty())
        return layers;
    const Graph graph(overlaps.pairs);
    LayerFinder finder(scene, vertices, graph);
    finder.layers();
    layers.offset.resize(scene.facets.size());
    for (std::uint32_t i = 0; i < graph.size(); ++i) {
        layers.offset[graph.facet(i)] = finder.offset(i);
        layers.covered += finder.is_covered(i);
    }
    for (const Buried& buried : overlaps.buried) {
        layers.offset[buried.facet] = layers.offset[buried.under];
        layers.buried.push_back(buried.facet);
        ++layers.covered;
    }
    return layers;
}

} // namespace hemilux
