#include "bvh/bvh.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace hemilux {
namespace {

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

/// Where a range of items is to be divided: those whose bin on `axis` is below `bin` go left.
struct Split {
    int axis = -1;
    int bin = 0;
    double cost = std::numeric_limits<double>::infinity();
};

/// Maps a coordinate of the range's centres to its bin.
struct Binning {
    double low, scale;
    int bins;

    Binning(const Box& centres, int axis, int count)
        : low(centres.low[axis]), scale(count / (centres.high[axis] - centres.low[axis])),
          bins(count) {}
    [[nodiscard]] int operator()(double coordinate) const {
        return std::min(static_cast<int>((coordinate - low) * scale), bins - 1);
    }
};

/// Divides ranges of items top-down and writes the nodes.
class Builder {
  public:
    Builder(const FacetSoup& soup, const BvhOptions& options, std::vector<Bvh::Node>& nodes)
        : options_(options), nodes_(nodes), bins_(static_cast<std::size_t>(options.bins)),
          right_area_(bins_.size()), right_count_(bins_.size()) {
        items_.reserve(soup.facets.size());
        for (std::uint32_t f = 0; f < soup.facets.size(); ++f)
            add(soup, f);
    }

    void build() {
        if (items_.empty())
            return;
        // Float boxes and float ray origins are off by half an ulp of the largest coordinate each.
        const Vec3 reach = glm::max(glm::abs(bounds_.low), glm::abs(bounds_.high));
        widen_ = std::max({reach.x, reach.y, reach.z}) * 0x1p-22;
        nodes_.emplace_back();
        const auto n = static_cast<std::uint32_t>(items_.size());
        const std::uint32_t middle = choose_or_halve(0, n, 0);
        fill(0, 0, middle, n, 1);
        quality_.nodes = nodes_.size();
        quality_.sah_cost += options_.cost_visit;
    }

    [[nodiscard]] const std::vector<Item>& items() const { return items_; }
    [[nodiscard]] const BvhQuality& quality() const { return quality_; }
    /// Of all facets, widened like the nodes' boxes.
    [[nodiscard]] Box bounds() const {
        return items_.empty() ? bounds_ : Box{bounds_.low - widen_, bounds_.high + widen_};
    }

  private:
    static constexpr int balanced_below = 64; ///< from this depth on ranges are halved

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

    /// The best division by bins, its cost relative to one facet test in a box of `boxes`' size.
    Split best_split(std::uint32_t begin, std::uint32_t end, const Box& boxes, const Box& centres) {
        Split best;
        for (int axis = 0; axis < 3; ++axis) {
            if (!(centres.high[axis] > centres.low[axis]))
                continue;
            const Binning bin_of(centres, axis, options_.bins);
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
            const double cost = options_.cost_visit +
                                options_.cost_facet *
                                    (left.half_area() * count + right_area_[b] * right_count_[b]) /
                                    area;
            if (cost < best.cost)
                best = {axis, static_cast<int>(b), cost};
        }
    }

    std::uint32_t partition(std::uint32_t begin, std::uint32_t end, const Box& centres,
                            const Split& split) {
        const Binning bin_of(centres, split.axis, options_.bins);
        const auto at = [&](std::uint32_t i) {
            return items_.begin() + static_cast<std::ptrdiff_t>(i);
        };
        const auto middle = std::stable_partition(at(begin), at(end), [&](const Item& item) {
            return bin_of(item.centre[split.axis]) < split.bin;
        });
        return static_cast<std::uint32_t>(middle - items_.begin());
    }

    /// Where to divide [begin, end); end when a leaf is cheaper.
    std::uint32_t choose(std::uint32_t begin, std::uint32_t end, int depth) {
        const std::uint32_t n = end - begin;
        if (n == 1)
            return end;
        if (depth < balanced_below) {
            Box boxes, centres;
            bounds_of(begin, end, boxes, centres);
            const Split split = best_split(begin, end, boxes, centres);
            if (n <= options_.max_leaf && !(split.cost < options_.cost_facet * n))
                return end;
            if (split.axis >= 0)
                return partition(begin, end, centres, split);
        }
        return n <= options_.max_leaf ? end : begin + n / 2;
    }

    /// Like choose, but never a leaf: the root is a node even over one facet (its second child is
    /// then empty).
    std::uint32_t choose_or_halve(std::uint32_t begin, std::uint32_t end, int depth) {
        const std::uint32_t middle = choose(begin, end, depth);
        return middle < end ? middle : begin + (end - begin + 1) / 2;
    }

    void fill(std::uint32_t node, std::uint32_t begin, std::uint32_t middle, std::uint32_t end,
              int depth) {
        set_child(node, 0, begin, middle, depth);
        set_child(node, 1, middle, end, depth);
    }

    void set_child(std::uint32_t node, std::size_t child, std::uint32_t begin, std::uint32_t end,
                   int depth) {
        Box boxes, centres;
        bounds_of(begin, end, boxes, centres);
        write_box(nodes_[node], child, boxes);
        quality_.depth = std::max(quality_.depth, depth);
        const std::uint32_t middle = begin < end ? choose(begin, end, depth) : end;
        const double share =
            begin < end ? boxes.half_area() / std::max(bounds_.half_area(), 1e-300) : 0;
        if (middle == end) {
            nodes_[node].first[child] = begin;
            nodes_[node].count[child] = end - begin;
            ++quality_.leaves;
            quality_.sah_cost += options_.cost_facet * share * (end - begin);
            return;
        }
        quality_.sah_cost += options_.cost_visit * share;
        const auto below = static_cast<std::uint32_t>(nodes_.size());
        nodes_[node].first[child] = below;
        nodes_[node].count[child] = none;
        nodes_.emplace_back();
        fill(below, begin, middle, end, depth + 1);
    }

    void write_box(Bvh::Node& node, std::size_t child, const Box& box) const {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const int i = static_cast<int>(axis);
            node.low[axis][child] = static_cast<float>(box.low[i] - widen_);
            node.high[axis][child] = static_cast<float>(box.high[i] + widen_);
        }
    }

    BvhOptions options_;
    std::vector<Bvh::Node>& nodes_;
    std::vector<Item> items_;
    std::vector<Bin> bins_;
    std::vector<double> right_area_;
    std::vector<std::uint32_t> right_count_;
    Box bounds_;
    double widen_ = 0;
    BvhQuality quality_;
};

} // namespace

Bvh::Bvh(const FacetSoup& soup, const BvhOptions& options)
    : vertices_(soup.vertices.begin(), soup.vertices.end()) {
    Builder builder(soup, options, nodes_);
    builder.build();
    facets_.reserve(builder.items().size());
    order_.reserve(builder.items().size());
    for (const auto& item : builder.items()) {
        facets_.push_back(soup.facets[item.facet]);
        order_.push_back(item.facet);
    }
    bounds_ = builder.bounds();
    quality_ = builder.quality();
    quality_.bytes = nodes_.size() * sizeof(Node) + facets_.size() * sizeof(FacetCorners) +
                     order_.size() * sizeof(std::uint32_t) + vertices_.size() * sizeof(Vec3);
}

} // namespace hemilux
