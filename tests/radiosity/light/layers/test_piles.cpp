// Piles of facets in one place cost no more than a few pairs, and the lit one stays on top.
#include "radiosity/light/layers/coplanar_layers.h"
#include "radiosity/light/layers/coplanar_overlaps.h"
#include "radiosity/light/layers/layered_mesh.h"
#include "radiosity/paper/sampling/rng.h"
#include "radiosity/paper/scene/mesh.h"
#include "support/catch.h"
#include "support/layered_model.h"
#include "support/scenes.h"
#include "support/solve.h"

#include <algorithm>

using namespace hemilux;
using Model = test::LayeredModel;

namespace {

enum : std::uint32_t { grey, bright };

Scene empty_scene() {
    Scene scene;
    scene.materials = {{"grey", Vec3(.5), Vec3(0.0)}, {"bright", Vec3(.5), Vec3(1.0)}};
    scene.groups = {"default"};
    return scene;
}

/// A lamp over n triangles in one place. Each begins at another corner, and every third faces down.
Scene pile(std::uint32_t n) {
    Scene scene = empty_scene();
    test::add_quad(scene, {0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}, 1, 1, bright);
    const auto v = static_cast<std::uint32_t>(scene.vertices.size());
    scene.vertices.insert(scene.vertices.end(), {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    for (std::uint32_t k = 0; k < n; ++k) {
        std::array<std::uint32_t, 3> c{v + k % 3, v + (k + 1) % 3, v + (k + 2) % 3};
        if (k % 3 == 2)
            std::swap(c[0], c[1]);
        scene.facets.push_back({{c[0], c[1], c[2], c[2]}, scene.faces++, grey, 0});
    }
    return scene;
}

/// The same with corners of their own, each moved along each axis by up to so much.
Scene scattered_pile(std::uint32_t n, double by) {
    Scene scene = pile(n);
    Rng rng(3);
    for (Facet& facet : std::span(scene.facets).subspan(1)) {
        for (std::size_t i = 0; i < 3; ++i) {
            scene.vertices.push_back(
                scene.vertices[facet.vertex[i]] +
                by * (2.0 * Vec3(rng.uniform(), rng.uniform(), rng.uniform()) - 1.0));
            facet.vertex[i] = static_cast<std::uint32_t>(scene.vertices.size() - 1);
        }
        facet.vertex[3] = facet.vertex[2];
    }
    return scene;
}

/// Squares of one plane each of which lies over every other, no two in the same place.
Scene heap(std::uint32_t n) {
    Scene scene = empty_scene();
    Rng rng(7);
    for (std::uint32_t k = 0; k < n; ++k) {
        const double x = .01 * rng.uniform(), y = .01 * rng.uniform();
        test::add_quad(scene, {x, y, 0}, {x + 1, y, 0}, {x + 1, y + 1, 0}, {x, y + 1, 0}, 1, 1,
                       bright);
    }
    return scene;
}

std::vector<Vec3> local(const Scene& scene) {
    return LocalFrame::of(scene).to_local(scene.vertices);
}

std::size_t facets_out_of_reach(const Mesh& mesh) {
    return static_cast<std::size_t>(
        std::ranges::count_if(mesh.soup_to_trace().facets,
                              [](const FacetCorners& c) { return c[0] == c[1] && c[1] == c[2]; }));
}

/// How many facets unite_near_twins() changes.
std::size_t united(const Scene& scene) {
    Scene after = scene;
    unite_near_twins(after, local(scene));
    std::size_t changed = 0;
    for (std::size_t f = 0; f < scene.facets.size(); ++f)
        changed += after.facets[f].vertex != scene.facets[f].vertex;
    return changed;
}

} // namespace

TEST_CASE("Facets in one place make no more pairs than the few that are kept") {
    const Scene scene = pile(30'000);
    const Overlaps overlaps = find_overlaps(scene, local(scene));
    CHECK(overlaps.complete);
    CHECK(overlaps.buried.size() == 30'000 - 2 * kept_alike);
    CHECK(overlaps.pairs.size() == kept_alike * (2 * kept_alike - 1));
    CHECK(find_coplanar_layers(scene, local(scene)).covered == 30'000 - 2);
    const Mesh mesh = layered_mesh(scene);
    CHECK(mesh.all_layers_are_offset());
    CHECK(mesh.patches().size() == 30'001);
    CHECK(facets_out_of_reach(mesh) == 30'000 - 2 * kept_alike);
}

TEST_CASE("Facets that are in one place but for rounding are as if they were in it exactly") {
    constexpr double by = 1e-7;
    const Scene scene = scattered_pile(3000, by);
    const Mesh mesh = layered_mesh(scene);
    CHECK(mesh.all_layers_are_offset());
    CHECK(facets_out_of_reach(mesh) >= 3000 - 8 * kept_alike);
    double farthest = 0;
    for (std::uint32_t f = 0; f < scene.facets.size(); ++f)
        for (std::size_t i = 0; i < 3; ++i)
            farthest =
                std::max(farthest, glm::length(scene.vertices[mesh.scene().facets[f].vertex[i]] -
                                               scene.vertices[scene.facets[f].vertex[i]]));
    CHECK(farthest > 0);
    CHECK(farthest < 4 * by);
}

TEST_CASE("Few facets near each other, and many that lie beside each other, stay where they are") {
    CHECK(united(scattered_pile(kept_alike, 1e-7)) == 0);
    CHECK(united(scattered_pile(3000, 1e-2)) == 0);
    CHECK(united(scattered_pile(3000, 1e-7)) > 2800);
    Scene strip = empty_scene();
    test::add_quad(strip, {0, 0, 0}, {1e-3, 0, 0}, {1e-3, 1, 0}, {0, 1, 0}, 2000, 1, grey);
    test::add_quad(strip, {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, 1, 1, grey);
    CHECK(united(strip) == 0);
}

TEST_CASE("Of many facets in one place the first is lit as if it were alone", "[slow]") {
    const Method& method = *find_method("monte-carlo");
    const auto solved = [&](std::uint32_t n) {
        const Model model(pile(n));
        const SolveOptions options{.rays = 40'000.0 / (n + 1), .threads = 1};
        return test::solve(model, method, options, test::steps(16)).radiosity[1].x;
    };
    const double few = solved(3);
    CHECK(few > 0);
    CHECK(solved(100) == Approx(few).epsilon(.05));
    Scene one_way = scattered_pile(100, 1e-7);
    for (std::size_t f = 3; f < one_way.facets.size(); f += 3)
        std::swap(one_way.facets[f].vertex[0], one_way.facets[f].vertex[1]);
    const Model scattered(one_way);
    const SolveOptions options{.rays = 40'000.0 / 101, .threads = 1};
    const Solution solution = test::solve(scattered, method, options, test::steps(16));
    CHECK(solution.radiosity[1].x == Approx(few).epsilon(.05));
}

TEST_CASE("The brightest of many facets in one place is never buried") {
    Scene scene = pile(300);
    scene.facets[200].material = bright;
    const std::vector<Buried> buried = find_overlaps(scene, local(scene)).buried;
    CHECK(buried.size() == 300 - 2 * kept_alike);
    CHECK(std::ranges::none_of(buried, [](const Buried& b) { return b.facet == 200; }));
}

TEST_CASE("Pairs of facets over each other end at their limit, which is reported", "[slow]") {
    const Scene scene = heap(1500);
    const OverlapLimits limits = OverlapLimits::of(scene);
    const Overlaps overlaps = find_overlaps(scene, local(scene));
    CHECK(overlaps.pairs.size() <= limits.pairs);
    CHECK_FALSE(overlaps.complete);
    CHECK_FALSE(layered_mesh(scene).all_layers_are_offset());
    CHECK(find_overlaps(heap(500), local(heap(500))).complete);
}
