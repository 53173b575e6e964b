#include "bvh/wide/wide_build.h"

#include "bvh/wide/wide_split.h"

#include <algorithm>
#include <cmath>

namespace hemilux::wide {
namespace {

/// Ranges up to this share of all items, or up to this many, are jobs.
constexpr std::uint32_t jobs_at_least = 64, small_job = 4096;
/// From this depth on ranges are halved, so that max_depth is kept: 8^11 > 2^32.
constexpr unsigned balanced_below = max_depth - 12;

bool is_finite(const Vec3& p) {
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

/// The nodes and leaves made by one thread; child indices count within it.
struct Part {
    std::vector<Node> nodes;
    std::vector<Leaf> leaves;
    double cost = 0; ///< sum of surfaces
    unsigned depth = 0;
};

class Builder {
  public:
    Builder(const FacetSoup& soup, unsigned threads) : soup_(soup), workers_(threads) {}

    Built run() {
        Built built;
        find_bounds(built);
        make_items();
        if (items_.empty())
            return built;
        const auto n = static_cast<std::uint32_t>(items_.size());
        job_size_ = std::max(small_job, n / jobs_at_least);
        const Range all = range_of(items_, 0, n);
        Part top;
        top.nodes.emplace_back();
        fill(top, 0, all, 1, true);
        std::vector<Part> parts(jobs_.size());
        workers_.for_chunks(jobs_.size(), 1, [&](std::size_t j, std::size_t) {
            parts[j].nodes.emplace_back();
            fill(parts[j], 0, jobs_[j].range, jobs_[j].depth, false);
        });
        join(top, parts, built);
        describe(top, parts, std::max(all.box.half_area(), 1e-30f), built);
        return built;
    }

  private:
    struct Job {
        Range range;
        unsigned depth;
        std::uint32_t node, child; ///< place in the upper tree where it hangs
    };

    void find_bounds(Built& built) {
        Box bounds;
        for (const FacetCorners& corners : soup_.facets)
            if (finite(corners))
                for (const std::uint32_t v : corners)
                    bounds.include(soup_.vertices[v]);
        if (!bounds.empty())
            built.bounds = bounds;
        shrink_ = 1 / size_of(built.bounds);
    }

    [[nodiscard]] bool finite(const FacetCorners& corners) const {
        return std::all_of(corners.begin(), corners.end(),
                           [&](std::uint32_t v) { return is_finite(soup_.vertices[v]); });
    }

    void make_items() {
        items_.reserve(soup_.facets.size());
        for (std::uint32_t f = 0; f < soup_.facets.size(); ++f) {
            const FacetCorners& c = soup_.facets[f];
            if (!finite(c))
                continue;
            add_item(c[0], c[1], c[2], f);
            if (c[3] != c[2])
                add_item(c[0], c[2], c[3], f | flag);
        }
    }

    void add_item(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t slot) {
        const Vec3 p = shrink_ * soup_.vertices[a], q = shrink_ * soup_.vertices[b],
                   r = shrink_ * soup_.vertices[c];
        items_.emplace_back(glm::min(p, glm::min(q, r)), glm::max(p, glm::max(q, r)), slot);
    }

    /// Divides a range into up to eight and makes them the children of a node.
    void fill(Part& part, std::uint32_t node, const Range& range, unsigned depth, bool upper) {
        part.depth = std::max(part.depth, depth);
        part.cost += static_cast<double>(range.box.half_area());
        std::array<Range, width> children{};
        children[0] = range;
        unsigned count = 1;
        for (; count < width; ++count) {
            const bool balanced = depth >= balanced_below;
            const unsigned widest = choose(children, count, balanced);
            if (widest == width)
                break;
            const auto halves = divide(items_, children[widest], balanced, workers_for(upper));
            children[widest] = halves[0];
            children[count] = halves[1];
        }
        // A child is the likelier to stop a ray the larger it is: the largest is the last, which
        // rays that end at any hit visit first.
        const auto surface_and_place = [](const Range& child) {
            return std::pair(child.box.half_area(), child.begin);
        };
        std::sort(children.begin(), children.begin() + count, [&](const Range& a, const Range& b) {
            return surface_and_place(a) < surface_and_place(b);
        });
        // They are made in the order of the items, so that neighbours in space lie together in
        // memory.
        std::array<unsigned, width> order{0, 1, 2, 3, 4, 5, 6, 7};
        std::sort(order.begin(), order.begin() + count,
                  [&](unsigned a, unsigned b) { return children[a].begin < children[b].begin; });
        for (const unsigned c : order)
            set_child(part, node, c, children[c], depth, upper);
        set_order(part.nodes[node], children);
    }

    /// Sets the order of the children along the diagonal of each octant, the farthest first.
    static void set_order(Node& node, const std::array<Range, width>& children) {
        for (unsigned octant = 0; octant < width; ++octant) {
            std::array<float, width> along;
            std::array<unsigned, width> order;
            for (unsigned c = 0; c < width; ++c) {
                order[c] = c;
                const FloatBox& box = children[c].box;
                along[c] = children[c].size() > 0 ? 0 : std::numeric_limits<float>::infinity();
                for (unsigned i = 0; i < 3 && children[c].size() > 0; ++i)
                    along[c] += (octant >> i & 1 ? -1.0f : 1.0f) * (box.low.v[i] + box.high.v[i]);
            }
            std::stable_sort(order.begin(), order.end(),
                             [&](unsigned a, unsigned b) { return along[a] > along[b]; });
            node.order[octant] = 0;
            for (unsigned k = 0; k < width; ++k)
                node.order[octant] |= order[k] << (4 * k);
        }
    }

    /// Returns the part with the largest surface, or with the most triangles, of those that are too
    /// many for a leaf; width: none.
    [[nodiscard]] static unsigned choose(const std::array<Range, width>& children, unsigned count,
                                         bool balanced) {
        unsigned best = width;
        float most = -1;
        for (unsigned c = 0; c < count; ++c) {
            const float weight =
                balanced ? static_cast<float>(children[c].size()) : children[c].box.half_area();
            if (children[c].size() > width && weight > most) {
                best = c;
                most = weight;
            }
        }
        return best;
    }

    void set_child(Part& part, std::uint32_t node, unsigned c, const Range& range, unsigned depth,
                   bool upper) {
        write_box(part.nodes[node], c, range.box);
        if (range.size() <= width) {
            part.nodes[node].child[c] = range.size() == 0 ? no_facet : make_leaf(part, range);
        } else if (upper && range.size() <= job_size_) {
            jobs_.push_back({range, depth + 1, node, c});
        } else {
            const auto below = static_cast<std::uint32_t>(part.nodes.size());
            part.nodes[node].child[c] = below;
            part.nodes.emplace_back();
            fill(part, below, range, depth + 1, upper);
        }
    }

    /// Writes a box that is wider than the triangles by what rounding can do to box, origin and
    /// direction.
    static void write_box(Node& node, unsigned c, const FloatBox& box) {
        constexpr float widen = 0x1p-22f;
        for (unsigned axis = 0; axis < 3; ++axis) {
            node.plane[2 * axis][c] = box.low.v[axis] - widen;
            node.plane[2 * axis + 1][c] = box.high.v[axis] + widen;
        }
    }

    std::uint32_t make_leaf(Part& part, const Range& range) const {
        Leaf leaf{};
        std::fill(std::begin(leaf.slot), std::end(leaf.slot), no_facet);
        // The slots are sorted, so that the leaf is the same whatever the order of the items.
        std::array<std::uint32_t, width> slots;
        const std::uint32_t size = std::min(range.size(), width);
        for (std::uint32_t i = 0; i < size; ++i)
            slots[i] = items_[range.begin + i].slot();
        std::sort(slots.begin(), slots.begin() + size);
        for (unsigned k = 0; k < size; ++k)
            write_slot(leaf, k, slots[k]);
        part.cost += static_cast<double>(range.box.half_area());
        part.leaves.push_back(leaf);
        return static_cast<std::uint32_t>(part.leaves.size() - 1) | flag;
    }

    void write_slot(Leaf& leaf, unsigned k, std::uint32_t slot) const {
        const FacetCorners& c = soup_.facets[slot & ~flag];
        const bool second = (slot & flag) != 0;
        const Vec3 a = shrink_ * soup_.vertices[c[0]];
        Vec3 e1 = shrink_ * soup_.vertices[c[second ? 2 : 1]] - a;
        Vec3 e2 = shrink_ * soup_.vertices[c[second ? 3 : 2]] - a;
        // The products of edges shorter than this would vanish in floats.
        constexpr double tiny = 1e-12;
        if (is_doubtful(c) || !(std::max(glm::length(e1), glm::length(e2)) > tiny))
            e1 = e2 = Vec3(std::numeric_limits<double>::quiet_NaN());
        for (unsigned i = 0; i < 3; ++i) {
            const auto axis = static_cast<int>(i);
            leaf.corner[i][k] = static_cast<float>(a[axis]);
            leaf.edge1[i][k] = static_cast<float>(e1[axis]);
            leaf.edge2[i][k] = static_cast<float>(e2[axis]);
        }
        leaf.slot[k] = slot;
    }

    /// Returns whether a quad has halves that a ray might both hit. It does where it is not planar
    /// and convex, and the filter would not be uncertain of such rays anyway. Its hits are always
    /// decided in doubles.
    ///
    /// A ray that strikes both halves meets one from the front and one from behind, so its sine to
    /// either plane is at most the angle between the normals. The filter is certain only where that
    /// sine, times the length of e1 x e2, is more than twice its error bound.
    [[nodiscard]] bool is_doubtful(const FacetCorners& c) const {
        if (c[2] == c[3])
            return false;
        std::array<Vec3, 4> p;
        for (std::size_t i = 0; i < 4; ++i)
            p[i] = shrink_ * soup_.vertices[c[i]];
        const Vec3 first = glm::cross(p[1] - p[0], p[2] - p[0]);
        const Vec3 second = glm::cross(p[2] - p[0], p[3] - p[0]);
        const double a = glm::length(first), b = glm::length(second);
        const double angle = glm::length(glm::cross(first, second)) / (a * b);
        const auto largest = [](const Vec3& v) { return std::max({v.x, v.y, v.z}); };
        const double corner = largest(glm::abs(p[0]));               // at most |A| + |O|
        const auto min_error = [&](const Vec3& e1, const Vec3& e2) { // over all origins
            const double longest = largest(glm::max(glm::abs(e1), glm::abs(e2)));
            return error_share * longest * (longest + error_offset * corner);
        };
        constexpr double longest_direction = 1.75, small = .05;
        const bool hit_by_undecided_rays_only =
            longest_direction * angle * a <= 2 * min_error(p[1] - p[0], p[2] - p[0]) &&
            longest_direction * angle * b <= 2 * min_error(p[2] - p[0], p[3] - p[0]);
        return !(glm::dot(first, second) > 0 && angle < small && hit_by_undecided_rays_only);
    }

    [[nodiscard]] const Workers& workers_for(bool upper) const { return upper ? workers_ : alone_; }

    /// Appends the jobs' parts to the upper tree and moves their indices.
    void join(Part& top, const std::vector<Part>& parts, Built& built) const {
        std::vector<std::array<std::size_t, 2>> start(parts.size() + 1);
        start[0] = {top.nodes.size(), top.leaves.size()};
        for (std::size_t j = 0; j < parts.size(); ++j) {
            start[j + 1] = {start[j][0] + parts[j].nodes.size(),
                            start[j][1] + parts[j].leaves.size()};
            top.nodes[jobs_[j].node].child[jobs_[j].child] =
                static_cast<std::uint32_t>(start[j][0]);
        }
        built.nodes = HugeArray<Node>(start.back()[0]);
        built.leaves = HugeArray<Leaf>(start.back()[1]);
        std::copy(top.nodes.begin(), top.nodes.end(), built.nodes.data());
        std::copy(top.leaves.begin(), top.leaves.end(), built.leaves.data());
        workers_.for_chunks(parts.size(), 1, [&](std::size_t j, std::size_t) {
            Node* to = built.nodes.data() + start[j][0];
            for (const Node& node : parts[j].nodes) {
                *to = node;
                for (std::uint32_t& child : to->child)
                    if (child != no_facet)
                        child += static_cast<std::uint32_t>(start[j][(child & flag) != 0]);
                ++to;
            }
            std::copy(parts[j].leaves.begin(), parts[j].leaves.end(),
                      built.leaves.data() + start[j][1]);
        });
    }

    static void describe(const Part& top, const std::vector<Part>& parts, float area,
                         Built& built) {
        double cost = top.cost;
        unsigned depth = top.depth;
        for (const Part& part : parts) {
            cost += part.cost;
            depth = std::max(depth, part.depth);
        }
        built.quality = {.sah_cost = cost / static_cast<double>(area),
                         .depth = static_cast<int>(depth),
                         .nodes = built.nodes.size(),
                         .leaves = built.leaves.size(),
                         .bytes = built.nodes.bytes() + built.leaves.bytes()};
    }

    FacetSoup soup_;
    Workers workers_, alone_{1};
    double shrink_ = 1;
    std::vector<Item> items_;
    std::uint32_t job_size_ = 0;
    std::vector<Job> jobs_;
};

} // namespace

double size_of(const Box& bounds) {
    const Vec3 reach = glm::max(glm::abs(bounds.low), glm::abs(bounds.high));
    int exponent = 0;
    std::frexp(std::max({reach.x, reach.y, reach.z}), &exponent);
    return std::ldexp(1.0, std::clamp(exponent, -1000, 1000));
}

Built build(const FacetSoup& soup, unsigned threads) { return Builder(soup, threads).run(); }

} // namespace hemilux::wide
