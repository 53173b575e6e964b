// The BVH against brute force, and what must not break it.
#include "bvh/brute_force.h"
#include "bvh/bvh.h"
#include "radiosity/paper/sampling/rng.h"
#include "support/catch.h"

#include <algorithm>
#include <limits>

using namespace hemilux;

namespace {

struct Soup {
    std::vector<Vec3> vertices;
    std::vector<FacetCorners> facets;
    [[nodiscard]] FacetSoup view() const { return {vertices, facets}; }
};

Vec3 point(Rng& rng, double size) {
    const double x = rng.uniform(), y = rng.uniform(), z = rng.uniform();
    return size * (2.0 * Vec3(x, y, z) - 1.0);
}

/// Triangles and parallelograms of many sizes.
Soup random_soup(std::size_t facets, std::uint64_t seed) {
    Rng rng(seed);
    Soup soup;
    for (std::size_t f = 0; f < facets; ++f) {
        const Vec3 at = point(rng, 1);
        const double size = std::pow(10.0, -3 * rng.uniform());
        const Vec3 e = point(rng, size), g = point(rng, size);
        const auto first = static_cast<std::uint32_t>(soup.vertices.size());
        soup.vertices.insert(soup.vertices.end(), {at, at + e, at + e + g, at + g});
        const std::uint32_t last = f % 2 == 0 ? first + 2 : first + 3;
        soup.facets.push_back({first, first + 1, first + 2, last});
    }
    return soup;
}

void check_equal(const Tracer& a, const Tracer& b, const Ray& ray) {
    const auto x = a.closest(ray), y = b.closest(ray);
    REQUIRE(x.has_value() == y.has_value());
    if (x) {
        CHECK(x->facet == y->facet);
        CHECK(x->t == y->t);
        CHECK(x->u == y->u);
        CHECK(x->v == y->v);
        CHECK(x->front == y->front);
    }
    CHECK(a.count(ray) == b.count(ray));
    CHECK(a.occluded(ray, 3) == b.occluded(ray, 3));
}

} // namespace

TEST_CASE("The BVH answers as brute force does") {
    for (const std::size_t facets : {1u, 2u, 9u, 200u, 1000u}) {
        const Soup soup = random_soup(facets, facets);
        const Bvh bvh(soup.view());
        const BruteForce referee(soup.view());
        Rng rng(99);
        for (int k = 0; k < 2000; ++k) {
            Ray ray{point(rng, 1.2), point(rng, 1)};
            if (k % 3 == 0)
                ray.t_max = rng.uniform();
            if (k % 5 == 0)
                ray.from = static_cast<std::uint32_t>(rng.uniform() * double(facets));
            if (k % 7 == 0)
                ray.direction[k % 3] = 0;
            if (k % 11 == 0)
                ray.origin *= 1000.0; // from far away
            if (k % 33 == 0)
                ray.direction = -ray.origin;
            check_equal(bvh, referee, ray);
        }
    }
}

TEST_CASE("Rays along axes and within the planes of boxes find what brute force finds") {
    Soup soup;
    for (int i = 0; i < 5; ++i)
        for (int j = 0; j < 5; ++j) { // a grid of quads in the plane z = 0 and its copy at z = 1
            for (const double z : {0.0, 1.0}) {
                const auto v = static_cast<std::uint32_t>(soup.vertices.size());
                soup.vertices.insert(soup.vertices.end(),
                                     {{i, j, z}, {i + 1, j, z}, {i + 1, j + 1, z}, {i, j + 1, z}});
                soup.facets.push_back({v, v + 1, v + 2, v + 3});
            }
        }
    const Bvh bvh(soup.view());
    const BruteForce referee(soup.view());
    for (int i = 0; i <= 10; ++i)
        for (int j = 0; j <= 10; ++j)
            for (const Vec3& d : {Vec3(0, 0, 1), Vec3(0, 0, -1), Vec3(1, 0, 0), Vec3(0, -1, 0),
                                  Vec3(1, 1, 0), Vec3(0, 1, 1)})
                check_equal(bvh, referee, {{.5 * i, .5 * j, .5}, d});
}

TEST_CASE("Scenes with nothing, one facet, duplicates and bad coordinates") {
    const Bvh empty(FacetSoup{});
    CHECK_FALSE(empty.closest({Vec3(0.0), Vec3(0, 0, 1)}));
    CHECK(empty.count({Vec3(0.0), Vec3(0, 0, 1)}) == 0);

    Soup soup{{{-1, -1, 1}, {1, -1, 1}, {0, 1, 1}}, {}};
    soup.facets.assign(100, {0, 1, 2, 2});
    const Bvh same(soup.view());
    const auto hit = same.closest({Vec3(0.0), Vec3(0, 0, 1)});
    REQUIRE(hit);
    CHECK(hit->facet == 0); // the smallest of equals
    CHECK(hit->t == 1.0);
    CHECK(same.count({Vec3(0.0), Vec3(0, 0, 1)}) == 100);

    const double nan = std::numeric_limits<double>::quiet_NaN();
    soup.vertices[1].x = nan;
    const Bvh bad(soup.view());
    CHECK_FALSE(bad.closest({Vec3(0.0), Vec3(0, 0, 1)}));
    soup.vertices[1].x = 1;
    const Bvh good(soup.view());
    CHECK_FALSE(good.closest({Vec3(nan), Vec3(0, 0, 1)}));
    CHECK_FALSE(good.closest({Vec3(0.0), Vec3(nan)}));
    CHECK_FALSE(good.closest({Vec3(0.0), Vec3(0.0)}));
    CHECK(good.count({Vec3(0.0), Vec3(nan, 0, 1)}) == 0);
}

TEST_CASE("Sides, the starting facet and the target") {
    // Counter-clockwise seen from z > 1.
    const Soup soup{{{-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}}, {{0, 1, 2, 3}}};
    const Bvh bvh(soup.view());
    for (const double x : {-.5, .5}) { // both halves of the quad
        const auto behind = bvh.closest({{x, .1, 0}, {0, 0, 1}});
        REQUIRE(behind);
        CHECK_FALSE(behind->front);
        const auto ahead = bvh.closest({{x, .1, 2}, {0, 0, -1}});
        REQUIRE(ahead);
        CHECK(ahead->front);
        // The point from the barycentric coordinates.
        const Vec3 q = soup.vertices[ahead->second_half ? 2 : 1],
                   r = soup.vertices[ahead->second_half ? 3 : 2];
        const Vec3 at = (1 - ahead->u - ahead->v) * soup.vertices[0] + ahead->u * q + ahead->v * r;
        CHECK(at.x == Approx(x));
        CHECK(at.y == Approx(.1));
    }
    Ray ray{Vec3(0.0), Vec3(0, 0, 1)};
    CHECK(bvh.occluded(ray));
    CHECK_FALSE(bvh.occluded(ray, 0));
    ray.t_max = 1;
    CHECK(bvh.closest(ray)); // t_max belongs to the ray
    ray.t_max = .99;
    CHECK_FALSE(bvh.closest(ray));
    ray.t_max = 2;
    ray.from = 0;
    CHECK_FALSE(bvh.closest(ray));
}

TEST_CASE("Each box of the tree holds the facets below it, and each facet is in one leaf") {
    const Soup soup = random_soup(500, 7);
    const Bvh bvh(soup.view());
    std::vector<int> leaves(soup.facets.size());
    const auto check_child = [&](const Bvh::Child& child, const Box& box, std::size_t parent,
                                 const auto& check_below) -> void {
        if (child.count != none) {
            for (const std::uint32_t facet : bvh.facets_of(child)) {
                ++leaves[facet];
                for (const std::uint32_t v : soup.facets[facet]) {
                    CHECK(glm::all(glm::greaterThanEqual(soup.vertices[v], box.low)));
                    CHECK(glm::all(glm::lessThanEqual(soup.vertices[v], box.high)));
                }
            }
            return;
        }
        CHECK((parent == none || child.first > parent));
        const Bvh::Node& node = bvh.nodes()[child.first];
        for (std::size_t c = 0; c < 2; ++c) {
            Box smaller;
            smaller.low = {node.low[0][c], node.low[1][c], node.low[2][c]};
            smaller.high = {node.high[0][c], node.high[1][c], node.high[2][c]};
            check_below(node.child[c], smaller, child.first, check_below);
        }
    };
    check_child(bvh.root(), bvh.bounds(), none, check_child);
    CHECK(std::ranges::count(leaves, 1) == std::ssize(leaves));
    CHECK(bvh.nodes().size() < soup.facets.size());
}
