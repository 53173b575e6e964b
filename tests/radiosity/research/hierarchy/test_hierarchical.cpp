// Hierarchical radiosity: trees over patches, links that cover each pair once, their factors, and
// the solution.
#include "radiosity/engine/factors/pairs/exchange_area.h"
#include "radiosity/engine/factors/pairs/pair_factor.h"
#include "radiosity/paper/sampling/rng.h"
#include "radiosity/paper/solution/solve_error.h"
#include "radiosity/research/hierarchy/links.h"
#include "support/catch.h"
#include "support/scenes.h"
#include "support/solve.h"

#include <cmath>
#include <map>
#include <numeric>

using namespace hemilux;

namespace {

using Node = PatchTree::Node;

double total_area(const Mesh& mesh) {
    double area = 0;
    for (const Patch& patch : mesh.patches())
        area += patch.area;
    return area;
}

/// How many links cover each ordered pair of patches.
std::map<std::pair<std::uint32_t, std::uint32_t>, int> cover(const PatchTree& tree,
                                                             const Links& links) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> count;
    for (const Link& link : links.all())
        for (std::uint32_t i = tree[link.to].begin; i < tree[link.to].end; ++i)
            for (std::uint32_t j = tree[link.from].begin; j < tree[link.from].end; ++j)
                ++count[{tree.order()[i], tree.order()[j]}];
    return count;
}

struct Hierarchy {
    const test::Model& model;
    PatchTree tree;
    Links links;

    explicit Hierarchy(const test::Model& of) : model(of), tree(of.mesh), links(of.mesh, tree) {}

    /// All patches shine and reflect alike; `tolerance`: of the power of all.
    Refinement refine(double tolerance) {
        const std::vector<double> light(model.mesh.patches().size(), 1.0);
        return links.refine(light, light, tolerance * total_area(model.mesh));
    }
};

} // namespace

TEST_CASE("Trees hold each patch once, and nodes are as large as their patches") {
    const test::Model model(test::room_with_block(), {.max_edge = .5});
    const PatchTree tree(model.mesh);
    const auto patches = model.mesh.patches();
    std::vector<int> found(patches.size());
    double of_roots = 0;
    for (const std::uint32_t root : tree.roots())
        of_roots += tree[root].area;
    CHECK(of_roots == Approx(total_area(model.mesh)));
    CHECK(tree.roots().size() == 6 + 1 + 5 + 5); // walls, lamp, two blocks
    for (const Node& node : tree.nodes()) {
        if (node.is_patch()) {
            ++found[tree.patch(node)];
            CHECK(node.end == node.begin + 1);
            CHECK(node.area == patches[tree.patch(node)].area);
        } else {
            const Node &one = tree[node.child], &other = tree[node.child + 1];
            REQUIRE(one.begin == node.begin);
            REQUIRE(one.end == other.begin);
            REQUIRE(other.end == node.end);
            REQUIRE(node.area == Approx(one.area + other.area));
        }
        for (std::uint32_t k = node.begin; k < node.end; ++k) {
            const Patch& patch = patches[tree.order()[k]];
            REQUIRE(glm::dot(patch.normal, node.normal) > 1 - 1e-9);
            REQUIRE(patch.material == patches[tree.order()[node.begin]].material);
            for (const Vec3& corner : patch.shape.corner)
                REQUIRE(glm::distance(corner, node.centre) <= node.radius * (1 + 1e-12));
        }
    }
    CHECK(std::ranges::all_of(found, [](int times) { return times == 1; }));
}

TEST_CASE("Light is pulled up as a mean and pushed down as a sum") {
    const test::Model model(test::furnace_box(4, .5));
    const PatchTree tree(model.mesh);
    const std::size_t n = model.mesh.patches().size();
    std::vector<double> by_patch(n), by_node(tree.nodes().size());
    for (std::size_t i = 0; i < n; ++i)
        by_patch[i] = double(i);
    tree.pull(by_patch, by_node);
    for (std::size_t k = 0; k < by_node.size(); ++k) {
        const Node& node = tree.nodes()[k];
        double power = 0;
        for (std::uint32_t p = node.begin; p < node.end; ++p)
            power += model.mesh.patches()[tree.order()[p]].area * by_patch[tree.order()[p]];
        REQUIRE(by_node[k] == Approx(power / node.area));
    }
    std::ranges::fill(by_node, 1.0);
    tree.push(by_node, by_patch);
    std::vector<int> ancestors(n);
    for (const Node& node : tree.nodes())
        for (std::uint32_t p = node.begin; p < node.end; ++p)
            ++ancestors[tree.order()[p]];
    for (std::size_t i = 0; i < n; ++i)
        CHECK(by_patch[i] == ancestors[i]);
}

TEST_CASE("Patches of a node are drawn by their areas, and what is left is uniform") {
    Scene scene = test::furnace_box(1, .5);
    test::add_quad(scene, {.1, .1, 1}, {.2, .1, 1}, {.2, .2, 1}, {.1, .2, 1}, 1, 1, 0);
    test::add_quad(scene, {.3, .1, 1}, {.8, .1, 1}, {.8, .9, 1}, {.3, .9, 1}, 1, 2, 0);
    const test::Model model(scene);
    const PatchTree tree(model.mesh);
    const auto found = std::ranges::find_if(
        tree.nodes(), [](const Node& node) { return node.end - node.begin == 3; });
    REQUIRE(found != tree.nodes().end());
    std::map<std::uint32_t, int> drawn;
    double left = 0;
    constexpr int draws = 41'000;
    for (int k = 0; k < draws; ++k) {
        double u = (k + .5) / draws;
        ++drawn[tree.sample(*found, u)];
        REQUIRE((u >= 0 && u < 1));
        left += u / draws;
    }
    REQUIRE(drawn.size() == 3);
    for (const auto& [patch, times] : drawn)
        CHECK(times == Approx(draws * model.mesh.patches()[patch].area / found->area).margin(1));
    CHECK(left == Approx(.5).margin(1e-3));
}

TEST_CASE("Links cover each pair that may see each other once, however they are refined") {
    const test::Model model(test::room_with_block());
    Hierarchy it(model);
    const auto patches = model.mesh.patches();
    for (const double tolerance : {0.0, 1e-1, 1e-4, 1e-6, 1e-12}) {
        CAPTURE(tolerance, it.links.all().size());
        if (tolerance > 0)
            it.refine(tolerance);
        const auto count = cover(it.tree, it.links);
        bool once = true, complete = true;
        for (const auto& [pair, times] : count)
            once = once && times == 1;
        for (std::uint32_t i = 0; i < patches.size(); ++i)
            for (std::uint32_t j = 0; j < patches.size(); ++j)
                if (i != j && may_see(patches[i], patches[j]))
                    complete = complete && count.contains({i, j});
        CHECK(once);
        CHECK(complete);
    }
    for (const Link& link : it.links.all()) { // the last tolerance leaves none above patches
        REQUIRE(it.tree[link.to].is_patch());
        REQUIRE(it.tree[link.from].is_patch());
    }
    CHECK(it.links.are_whole());
    CHECK(it.refine(1e-12) == Refinement::not_needed);
}

TEST_CASE("The guess of a link's factor is hardly ever too small") {
    const test::Model model(test::cube_with_lit_floor(4, .5));
    Hierarchy it(model);
    const auto patches = model.mesh.patches();
    for (const double tolerance : {1.0, 1e-3, 1e-9}) {
        it.refine(tolerance);
        for (const Link& link : it.links.all()) {
            const Node &to = it.tree[link.to], &from = it.tree[link.from];
            double exchange = 0;
            for (std::uint32_t i = to.begin; i < to.end; ++i)
                for (std::uint32_t j = from.begin; j < from.end; ++j)
                    exchange += exchange_area(patches[it.tree.order()[i]].shape,
                                              patches[it.tree.order()[j]].shape);
            REQUIRE(rough_factor(to, from) > .95 * exchange / to.area);
        }
    }
}

TEST_CASE("The number of links grows as the patches, not as their square") {
    std::vector<double> links, pairs;
    for (const std::uint32_t n : {8u, 16u, 32u}) {
        const test::Model model(test::cube_with_lit_floor(n, .5));
        Hierarchy it(model);
        it.refine(1e-3);
        links.push_back(double(it.links.all().size()));
        pairs.push_back(30 * std::pow(n, 4));
    }
    CAPTURE(links);
    CHECK(links[1] < 5 * links[0]);
    CHECK(links[2] < 5 * links[1]);
    CHECK(links[2] < .02 * pairs[2]);
}

TEST_CASE("Factors of links are right on average") {
    const test::Model model(test::cube_with_lit_floor(4, .5));
    Hierarchy it(model);
    it.refine(3e-3);
    Monitor monitor;
    const std::vector<std::uint32_t> points(it.links.all().size(), 64);
    const LinkFactors factors(model.mesh, model.bvh, it.tree, it.links, points, 9, Workers(2),
                              monitor);
    const auto patches = model.mesh.patches();
    int above_patches = 0;
    for (std::size_t l = 0; l < points.size(); ++l) {
        const Node &to = it.tree[it.links.all()[l].to], &from = it.tree[it.links.all()[l].from];
        double exchange = 0;
        for (std::uint32_t i = to.begin; i < to.end; ++i)
            for (std::uint32_t j = from.begin; j < from.end; ++j)
                exchange += exchange_area(patches[it.tree.order()[i]].shape,
                                          patches[it.tree.order()[j]].shape);
        above_patches += to.end - to.begin > 1 || from.end - from.begin > 1;
        REQUIRE(factors.factors()[l] == Approx(exchange / to.area).epsilon(.25).margin(1e-4));
    }
    CHECK(above_patches > 100);
    std::vector<double> ones(patches.size(), 1.0), sums(patches.size());
    factors.multiply(ones, sums);
    CHECK(std::accumulate(sums.begin(), sums.end(), 0.0) / double(sums.size()) ==
          Approx(1).margin(.01));
}

TEST_CASE("Hierarchical radiosity comes to the solution of the matrix, within its errors",
          "[slow]") {
    for (const bool open : {false, true}) {
        const test::Model model(open ? test::open_scene() : test::room_with_block());
        const Solution exact = test::reference(model, .005);
        const Solution s = test::solve(model, *find_method("hierarchical"), {}, test::steps(5));
        const double off = true_error(model.mesh, s.radiosity, exact.radiosity).all;
        CAPTURE(open, off, estimated_error(model.mesh, s));
        CHECK(off < .08);
        CHECK(off < 1.5 * estimated_error(model.mesh, s));
        CHECK(s.figures.value("links") > 0);
        const ZScores z = z_scores(model.mesh, s, exact.radiosity, exact.standard_error);
        CHECK(std::abs(z.mean) < 1);
        CHECK(z.rms < 1.5);
    }
}

TEST_CASE("Hierarchical radiosity gives the same bytes whatever the threads", "[slow]") {
    const test::Model model(test::room_with_block());
    const auto radiosity = [&](unsigned threads) {
        SolveOptions options;
        options.rays = 8;
        options.threads = threads;
        return test::solve(model, *find_method("hierarchical"), options, test::steps(3)).radiosity;
    };
    const std::vector<Vec3> one = radiosity(1);
    CHECK(test::same_bits(one, radiosity(2)));
    CHECK(test::same_bits(one, radiosity(3)));
}

TEST_CASE("Planes that would take too many links are refused before there is no memory") {
    const test::Model model(test::sphere(4, 1, .5, 1)); // 2048 planes, all of which see each other
    const PatchTree tree(model.mesh);
    CHECK_THROWS_AS(Links(model.mesh, tree), SolveError);
}
