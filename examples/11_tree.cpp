// The tree of boxes, by which a ray finds what it hits without asking all facets.
//
//   examples/11_tree [SCENE.obj [DRAWING.svg]]
//
// Shows: a tree of boxes built by two rules. One halves the facets along the longest side of their
// box; the other divides where the surface area heuristic (SAH) says that a random line will have
// the least to do. Prints: what this heuristic predicts for each tree, and how much random lines
// really do: boxes opened and facets tested; the same of the tree of src/bvh, which tries 16 places
// in place of all. Draws: which boxes a line opens, from above. docs/paper/bvh.md explains it.
#include "bvh/bvh.h"
#include "io/drawings/canvas.h"
#include "io/scene_files/obj.h"
#include "radiosity/paper/sampling/rng.h"
#include "radiosity/paper/scene/mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <exception>
#include <fstream>
#include <functional>
#include <limits>
#include <numbers>
#include <numeric>
#include <vector>

using namespace hemilux;

namespace {

constexpr double cost_of_opening = 1; ///< two boxes; a facet's test costs 1, too
constexpr std::size_t max_leaf = 8;

struct Node {
    Box box;
    std::array<std::size_t, 2> child{}; ///< 0 in a leaf: the root is nobody's child
    std::vector<std::uint32_t> facets;  ///< of a leaf
    [[nodiscard]] bool is_leaf() const { return child[0] == 0; }
};
using Tree = std::vector<Node>;

using Facets = std::vector<std::uint32_t>;

Box box_of(const std::vector<Box>& boxes, std::span<const std::uint32_t> facets) {
    Box box;
    for (const std::uint32_t f : facets)
        box.include(boxes[f]);
    return box;
}

void sort_along(int axis, const std::vector<Box>& boxes, Facets& facets) {
    std::ranges::stable_sort(
        facets, {}, [&](std::uint32_t f) { return boxes[f].low[axis] + boxes[f].high[axis]; });
}

/// A rule puts the facets in an order and returns how many of them are to be the first child's; 0
/// makes a leaf.
using Rule = std::function<std::size_t(const std::vector<Box>& boxes, Facets& facets)>;

std::size_t halve(const std::vector<Box>& boxes, Facets& facets) {
    if (facets.size() <= max_leaf / 2)
        return 0;
    const Vec3 size = box_of(boxes, facets).extent();
    sort_along(size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2, boxes, facets);
    return facets.size() / 2;
}

/// A line that opens a box of area A opens one inside it, of area A', with the probability A' / A.
/// So a division costs the opening, and the facets of each side times that probability.
std::size_t divide_by_areas(const std::vector<Box>& boxes, Facets& facets) {
    const std::size_t n = facets.size();
    const double area = box_of(boxes, facets).half_area();
    double least = n <= max_leaf ? double(n) : std::numeric_limits<double>::infinity();
    std::size_t best = 0;
    Facets order = facets, best_order = facets;
    std::vector<double> area_behind(n);
    for (int axis = 0; axis < 3; ++axis) {
        sort_along(axis, boxes, order);
        Box behind, before;
        for (std::size_t k = n; k-- > 1;) {
            behind.include(boxes[order[k]]);
            area_behind[k] = behind.half_area();
        }
        for (std::size_t k = 1; k < n; ++k) {
            before.include(boxes[order[k - 1]]);
            const double tests =
                (before.half_area() * double(k) + area_behind[k] * double(n - k)) / area;
            if (const double cost = cost_of_opening + tests; cost < least)
                least = cost, best = k, best_order = order;
        }
    }
    facets = best_order;
    return best;
}

/// Builds the tree of some facets at the end of `tree`.
void build(const std::vector<Box>& boxes, Facets facets, const Rule& rule, Tree& tree) {
    const std::size_t at = tree.size(), first = rule(boxes, facets);
    tree.push_back({box_of(boxes, facets), {}, {}});
    if (first == 0) {
        tree[at].facets = facets;
        return;
    }
    const auto middle = facets.begin() + static_cast<std::ptrdiff_t>(first);
    tree[at].child[0] = tree.size();
    build(boxes, {facets.begin(), middle}, rule, tree);
    tree[at].child[1] = tree.size();
    build(boxes, {middle, facets.end()}, rule, tree);
}

/// The tree of src/bvh in the same form.
void copy(const Bvh& bvh, const Bvh::Child& child, const Box& box, Tree& tree) {
    const std::size_t at = tree.size();
    tree.push_back({box, {}, {}});
    if (child.count != none) {
        const auto facets = bvh.facets_of(child);
        tree[at].facets.assign(facets.begin(), facets.end());
        return;
    }
    const Bvh::Node& node = bvh.nodes()[child.first];
    for (std::size_t c = 0; c < 2; ++c) {
        tree[at].child[c] = tree.size();
        copy(bvh, node.child[c],
             {{node.low[0][c], node.low[1][c], node.low[2][c]},
              {node.high[0][c], node.high[1][c], node.high[2][c]}},
             tree);
    }
}

/// What a random line that meets the outermost box does: boxes opened, and facets tested.
struct Work {
    double opened = 0, tested = 0;
    [[nodiscard]] double cost() const { return cost_of_opening * opened + tested; }
};

Work predicted(const Tree& tree) {
    Work work;
    for (const Node& node : tree) {
        const double probability = node.box.half_area() / tree[0].box.half_area();
        work.opened += node.is_leaf() ? 0 : probability;
        work.tested += probability * double(node.facets.size());
    }
    return work;
}

bool meets(const Box& box, const Ray& line) {
    double enter = -std::numeric_limits<double>::infinity(), leave = -enter;
    for (int axis = 0; axis < 3; ++axis) {
        const double a = (box.low[axis] - line.origin[axis]) / line.direction[axis];
        const double b = (box.high[axis] - line.origin[axis]) / line.direction[axis];
        enter = std::max(enter, std::min(a, b));
        leave = std::min(leave, std::max(a, b));
    }
    return enter <= leave;
}

/// Calls visit(node, depth) for each node whose box the line meets.
template <class Visit>
void follow(const Tree& tree, const Ray& line, const Visit& visit, std::size_t at = 0,
            int depth = 0) {
    if (!meets(tree[at].box, line))
        return;
    visit(tree[at], depth);
    if (!tree[at].is_leaf())
        for (const std::size_t child : tree[at].child)
            follow(tree, line, visit, child, depth + 1);
}

Work work_of(const Tree& tree, const Ray& line) {
    Work work;
    follow(tree, line, [&](const Node& node, int) {
        work.opened += node.is_leaf() ? 0 : 1;
        work.tested += double(node.facets.size());
    });
    return work;
}

/// A line of which all that meet the box are as likely: it starts anywhere on the box's surface, by
/// the cosine law.
Ray random_line(const Box& box, Rng& rng) {
    const Vec3 size = box.extent();
    const std::array<double, 3> area{size.y * size.z, size.z * size.x, size.x * size.y};
    double u = rng.uniform() * (area[0] + area[1] + area[2]);
    int axis = 0;
    for (; axis < 2 && u > area[static_cast<std::size_t>(axis)]; ++axis)
        u -= area[static_cast<std::size_t>(axis)];
    Vec3 origin = box.low + Vec3(rng.uniform(), rng.uniform(), rng.uniform()) * size, direction;
    const bool high = rng.uniform() < .5;
    origin[axis] = high ? box.high[axis] : box.low[axis];
    const double r2 = rng.uniform(), phi = 2 * std::numbers::pi * rng.uniform();
    direction[axis] = std::sqrt(1 - r2) * (high ? -1 : 1);
    direction[(axis + 1) % 3] = std::sqrt(r2) * std::cos(phi);
    direction[(axis + 2) % 3] = std::sqrt(r2) * std::sin(phi);
    return {.origin = origin, .direction = direction};
}

Work measured(const Tree& tree, int lines) {
    Rng rng(1);
    Work mean;
    for (int k = 0; k < lines; ++k) {
        const Work work = work_of(tree, random_line(tree[0].box, rng));
        mean.opened += work.opened / lines;
        mean.tested += work.tested / lines;
    }
    return mean;
}

/// A line across the scene, through the middle of what is in it.
Ray line_across(const Box& all, const std::vector<Box>& facets) {
    Vec3 middle;
    for (int axis = 0; axis < 3; ++axis) {
        std::vector<double> centres;
        for (const Box& facet : facets)
            centres.push_back(facet.centre()[axis]);
        const auto half = centres.begin() + static_cast<std::ptrdiff_t>(centres.size() / 2);
        std::ranges::nth_element(centres, half);
        middle[axis] = *half;
    }
    const Vec3 direction = Vec3(1, .1, .8) * all.extent();
    double before = 1, behind = 1;
    for (int axis = 0; axis < 3; ++axis) {
        before = std::min(before, (middle[axis] - all.low[axis]) / direction[axis]);
        behind = std::min(behind, (all.high[axis] - middle[axis]) / direction[axis]);
    }
    return {.origin = middle - before * direction, .direction = (before + behind) * direction};
}

/// The boxes that a line opens, from above: x to the right, z downwards.
void draw(Canvas& canvas, const Vec2& corner, double width, const std::vector<Box>& facets,
          const Tree& tree, const Ray& line, const char* title) {
    const Box& all = tree[0].box;
    const double scale = width / (all.high.x - all.low.x);
    const auto at = [&](const Vec3& p) {
        return corner + scale * Vec2(p.x - all.low.x, p.z - all.low.z);
    };
    const auto outline = [&](const Box& box, const Stroke& stroke) {
        const Vec2 a = at(box.low), c = at(box.high);
        canvas.line(std::array<Vec2, 5>{a, {c.x, a.y}, c, {a.x, c.y}, a}, stroke);
    };
    const Work work = work_of(tree, line);
    char text[160];
    std::snprintf(text, sizeof text, "%s: the line opens %.0f boxes and tests %.0f of %zu facets",
                  title, work.opened, work.tested, facets.size());
    canvas.text(corner - Vec2(0, 14), text, {Anchor::start, 15, ink});
    for (const Box& facet : facets)
        if (facet.extent().x > 0 && facet.extent().z > 0) // not edge-on
            outline(facet, {{215, 215, 215}, .6});
    follow(tree, line, [&](const Node& node, int) {
        if (node.is_leaf())
            fill_box(canvas, at(node.box.low), at(node.box.high), {230, 120, 20}, .12);
    });
    follow(tree, line, [&](const Node& node, int depth) {
        const auto fade = static_cast<std::uint8_t>(std::min(40 + 14 * depth, 190));
        if (!node.is_leaf())
            outline(node.box, {{fade, fade, fade}, std::max(2.2 - .2 * depth, .5)});
    });
    const Vec3 end = line.origin + line.direction;
    canvas.line(std::array<Vec2, 2>{at(line.origin), at(end)}, {ray_blue, 2});
}

void print(const char* name, const Tree& tree, const Work& expected, const Work& found) {
    const auto leaves = static_cast<std::size_t>(std::ranges::count_if(tree, &Node::is_leaf));
    std::printf("%-24s  %6zu  %6.1f  %6.1f  %6.1f  %6.1f  %6.1f\n", name, leaves, expected.opened,
                expected.tested, expected.cost(), found.opened, found.tested);
}

int compare(const char* path, const char* drawing) {
    const Mesh mesh(read_obj(path).scene);
    std::vector<Box> boxes;
    for (std::uint32_t f = 0; f < mesh.scene().facets.size(); ++f) {
        Box& box = boxes.emplace_back();
        for (const std::uint32_t v : mesh.soup().facets[f])
            box.include(mesh.vertices()[v]);
    }
    Facets all(boxes.size());
    std::iota(all.begin(), all.end(), 0U);
    const Bvh bvh(mesh.soup());
    Tree halved, by_areas, of_bvh;
    build(boxes, all, halve, halved);
    build(boxes, all, divide_by_areas, by_areas);
    copy(bvh, bvh.root(), bvh.bounds(), of_bvh);

    std::printf("%zu facets\n%-24s  %6s  predicted               measured\n"
                "%-24s  %6s  %6s  %6s  %6s  %6s  %6s\n",
                boxes.size(), "", "", "tree", "leaves", "opened", "tested", "cost", "opened",
                "tested");
    constexpr int lines = 50'000;
    bool right = true;
    std::vector<double> costs;
    for (const auto& [name, tree] : {std::pair("halved", &halved), std::pair("by areas", &by_areas),
                                     std::pair("by areas, src/bvh", &of_bvh)}) {
        const Work expected = predicted(*tree), found = measured(*tree, lines);
        print(name, *tree, expected, found);
        costs.push_back(expected.cost());
        right = right && std::abs(found.cost() / expected.cost() - 1) < .02;
    }
    if (drawing) {
        const Vec3 size = halved[0].box.extent();
        const Ray line = line_across(halved[0].box, boxes);
        constexpr int width = 560, margin = 30, top = 50, foot = 50;
        const int height = static_cast<int>(width * size.z / size.x) + top + foot;
        SvgCanvas canvas(2 * width + 3 * margin, height);
        draw(canvas, {margin, top}, width, boxes, halved, line, "Halved");
        draw(canvas, {width + 2 * margin, top}, width, boxes, by_areas, line, "By areas");
        canvas.text({margin, height - 18.0},
                    "From above. Blue: the line. Grey: the boxes that it opens, the outermost "
                    "darkest. Orange: leaves whose facets it tests.",
                    {Anchor::start, 14, ink});
        if (!(std::ofstream(drawing) << canvas.document()).flush())
            throw std::runtime_error(std::string(drawing) + ": cannot be written");
    }
    return right && costs[1] < costs[0] && costs[2] < 1.1 * costs[1] ? 0 : 1;
}

} // namespace

int main(int argc, char** argv) {
    try {
        return compare(argc > 1 ? argv[1] : "examples/scenes/room_1002.obj",
                       argc > 2 ? argv[2] : nullptr);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "11_tree: %s\n", error.what());
        return 2;
    }
}
