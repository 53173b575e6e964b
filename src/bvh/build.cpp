#include "bvh/bvh.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace hemilux {
namespace {

constexpr int bins = 16;              ///< candidates per axis; more: slightly better trees
constexpr std::uint32_t max_leaf = 8; ///< facets in a leaf at most
constexpr double cost_visit = 1.0;    ///< price of a node's two boxes; 1: the test of a facet

/// A facet's box and the point by which it is sorted into bins.
struct Item {
    Box box;
    Vec3 centre;
    std::uint32_t facet;
};

struct Bin {
    Box box;
    std::uint32_t count = 0;
};

/// The place where a range of items is to be divided: items whose bin on `axis` is below `bin` go
/// left.
struct Split {
    int axis = -1;
    int bin = 0;
    double cost = std::numeric_limits<double>::infinity();
};

/// Maps a coordinate of the range's centres to its bin.
struct Binning {
    double low, scale;

    Binning(const Box& centres, int axis)
        : low(centres.low[axis]), scale(bins / (centres.high[axis] - centres.low[axis])) {}
    [[nodiscard]] int operator()(double coordinate) const {
        return std::min(static_cast<int>((coordinate - low) * scale), bins - 1);
    }
};

/// Divides ranges of items top-down and writes the nodes.
class Builder {
  public:
    Builder(const FacetSoup& soup, std::vector<Bvh::Node>& nodes) : nodes_(nodes) {
        items_.reserve(soup.facets.size());
        for (std::uint32_t f = 0; f < soup.facets.size(); ++f)
            add(soup, f);
    }

    Bvh::Child build() {
        // Float boxes and float ray origins are off by half an ulp of the largest coordinate each.
        const Vec3 reach = glm::max(glm::abs(bounds_.low), glm::abs(bounds_.high));
        widen_ = std::max({reach.x, reach.y, reach.z}) * 0x1p-22;
        return make(0, static_cast<std::uint32_t>(items_.size()), 0);
    }

    [[nodiscard]] const std::vector<Item>& items() const { return items_; }
    /// Returns the box of all facets, widened like the nodes' boxes.
    [[nodiscard]] Box bounds() const { return {bounds_.low - widen_, bounds_.high + widen_}; }

  private:
    static constexpr int balanced_below = 64; ///< depth from which ranges are halved

    void add(const FacetSoup& soup, std::uint32_t facet) {
        Box box;
        bool finite = true;
        for (const std::uint32_t v : soup.facets[facet]) {
            const Vec3& p = soup.vertices[v];
            finite = finite && std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
            box.include(p);
        }
        if (!finite)
            return;
        bounds_.include(box);
        items_.push_back({box, box.centre(), facet});
    }

    void bounds_of(std::uint32_t begin, std::uint32_t end, Box& boxes, Box& centres) const {
        for (std::uint32_t i = begin; i < end; ++i) {
            boxes.include(items_[i].box);
            centres.include(items_[i].centre);
        }
    }

    /// Returns the best division by bins, its cost relative to one facet test in a box of `boxes`'
    /// size.
    Split best_split(std::uint32_t begin, std::uint32_t end, const Box& boxes, const Box& centres) {
        Split best;
        for (int axis = 0; axis < 3; ++axis) {
            if (!(centres.high[axis] > centres.low[axis]))
                continue;
            const Binning bin_of(centres, axis);
            if (!std::isfinite(bin_of.scale))
                continue;
            std::fill(bins_.begin(), bins_.end(), Bin{});
            for (std::uint32_t i = begin; i < end; ++i) {
                Bin& bin = bins_[static_cast<std::size_t>(bin_of(items_[i].centre[axis]))];
                bin.box.include(items_[i].box);
                ++bin.count;
            }
            sweep(axis, boxes, best);
        }
        return best;
    }

    void sweep(int axis, const Box& boxes, Split& best) {
        Box right;
        std::uint32_t count = 0;
        for (std::size_t b = bins_.size(); b-- > 1;) {
            right.include(bins_[b].box);
            count += bins_[b].count;
            right_area_[b] = right.empty() ? 0 : right.half_area();
            right_count_[b] = count;
        }
        Box left;
        count = 0;
        const double area = boxes.half_area();
        for (std::size_t b = 1; b < bins_.size(); ++b) {
            left.include(bins_[b - 1].box);
            count += bins_[b - 1].count;
            if (count == 0 || right_count_[b] == 0)
                continue;
            const double cost =
                cost_visit + (left.half_area() * count + right_area_[b] * right_count_[b]) / area;
            if (cost < best.cost)
                best = {axis, static_cast<int>(b), cost};
        }
    }

    std::uint32_t partition(std::uint32_t begin, std::uint32_t end, const Box& centres,
                            const Split& split) {
        const Binning bin_of(centres, split.axis);
        const auto at = [&](std::uint32_t i) {
            return items_.begin() + static_cast<std::ptrdiff_t>(i);
        };
        const auto middle = std::stable_partition(at(begin), at(end), [&](const Item& item) {
            return bin_of(item.centre[split.axis]) < split.bin;
        });
        return static_cast<std::uint32_t>(middle - items_.begin());
    }

    /// Returns where to divide [begin, end); end when a leaf is cheaper.
    std::uint32_t choose(std::uint32_t begin, std::uint32_t end, int depth) {
        const std::uint32_t n = end - begin;
        if (n <= 1)
            return end;
        if (depth < balanced_below) {
            Box boxes, centres;
            bounds_of(begin, end, boxes, centres);
            const Split split = best_split(begin, end, boxes, centres);
            if (n <= max_leaf && !(split.cost < n))
                return end;
            if (split.axis >= 0)
                return partition(begin, end, centres, split);
        }
        return n <= max_leaf ? end : begin + n / 2;
    }

    /// Makes the tree of [begin, end).
    Bvh::Child make(std::uint32_t begin, std::uint32_t end, int depth) {
        const std::uint32_t middle = choose(begin, end, depth);
        if (middle == end)
            return {begin, end - begin};
        const auto node = static_cast<std::uint32_t>(nodes_.size());
        nodes_.emplace_back();
        const std::array<std::uint32_t, 3> limit{begin, middle, end};
        for (std::size_t c = 0; c < 2; ++c) {
            Box boxes, centres;
            bounds_of(limit[c], limit[c + 1], boxes, centres);
            write_box(nodes_[node], c, boxes);
            const Bvh::Child child = make(limit[c], limit[c + 1], depth + 1);
            nodes_[node].child[c] = child;
        }
        return {node, none};
    }

    void write_box(Bvh::Node& node, std::size_t child, const Box& box) const {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const int i = static_cast<int>(axis);
            node.low[axis][child] = static_cast<float>(box.low[i] - widen_);
            node.high[axis][child] = static_cast<float>(box.high[i] + widen_);
        }
    }

    std::vector<Bvh::Node>& nodes_;
    std::vector<Item> items_;
    std::array<Bin, bins> bins_;
    std::array<double, bins> right_area_;
    std::array<std::uint32_t, bins> right_count_;
    Box bounds_;
    double widen_ = 0;
};

} // namespace

Bvh::Bvh(const FacetSoup& soup) : vertices_(soup.vertices.begin(), soup.vertices.end()) {
    Builder builder(soup, nodes_);
    root_ = builder.build();
    facets_.reserve(builder.items().size());
    order_.reserve(builder.items().size());
    for (const auto& item : builder.items()) {
        facets_.push_back(soup.facets[item.facet]);
        order_.push_back(item.facet);
    }
    bounds_ = builder.bounds();
}

} // namespace hemilux
