// The wide tree answers as brute force does, bit for bit, in every form and with every instruction
// set.
#include "bvh/brute_force.h"
#include "bvh/wide/wide_bvh.h"
#include "support/catch.h"
#include "support/soups.h"

#include <array>
#include <cstring>
#include <limits>
#include <stdexcept>

using namespace hemilux;
using test::point_within;
using test::Soup;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Rays of all kinds: short, long, along axes, from far away, from facets, towards vertices.
std::vector<Ray> rays_for(const Soup& soup, std::size_t count, std::uint64_t seed) {
    Rng rng(seed);
    std::vector<Ray> rays;
    const auto pick = [&](std::size_t n) {
        return static_cast<std::uint32_t>(rng.uniform() * double(n));
    };
    for (std::size_t k = 0; k < count; ++k) {
        Ray ray{point_within(rng, 1.2), point_within(rng, 1)};
        if (k % 3 == 0)
            ray.t_max = rng.uniform();
        if (k % 5 == 0)
            ray.from = pick(soup.facets.size());
        if (k % 7 == 0)
            ray.direction[int(k % 3)] = 0;
        if (k % 11 == 0)
            ray.origin *= 1000.0;
        if (k % 13 == 0)
            ray.direction = soup.vertices[pick(soup.vertices.size())] - ray.origin;
        if (k % 17 == 0)
            ray.direction *= 1e5;
        if (k % 19 == 0) { // between two vertices: along an edge perhaps
            ray.origin = soup.vertices[pick(soup.vertices.size())];
            ray.direction = soup.vertices[pick(soup.vertices.size())] - ray.origin;
        }
        if (k % 23 == 0)
            ray.origin *= 1e9;
        if (k % 33 == 0)
            ray.direction = -ray.origin;
        rays.push_back(ray);
    }
    return rays;
}

bool same(const std::optional<Hit>& a, const std::optional<Hit>& b) {
    if (!a || !b)
        return a.has_value() == b.has_value();
    return a->facet == b->facet && a->t == b->t && a->u == b->u && a->v == b->v &&
           a->second_half == b->second_half && a->front == b->front;
}

/// What a tracer answers.
struct Answers {
    std::vector<std::optional<Hit>> closest;
    std::vector<int> count;
    std::vector<bool> occluded;

    Answers(const Tracer& tracer, const std::vector<Ray>& rays) {
        for (const Ray& ray : rays) {
            closest.push_back(tracer.closest(ray));
            count.push_back(int(tracer.count(ray)));
            occluded.push_back(tracer.occluded(ray, 3));
        }
    }
};

/// How many rays are answered differently.
struct Differences {
    int closest = 0, count = 0, occluded = 0;

    Differences(const Answers& a, const Answers& b) {
        for (std::size_t k = 0; k < a.closest.size(); ++k) {
            closest += !same(a.closest[k], b.closest[k]);
            count += a.count[k] != b.count[k];
            occluded += a.occluded[k] != b.occluded[k];
        }
    }
};

/// Rays that meet both halves of quads which are not planar.
std::vector<Ray> rays_through_both_halves(const Soup& soup, std::size_t each, std::uint64_t seed) {
    Rng rng(seed);
    const auto within = [&](const Vec3& a, const Vec3& b, const Vec3& c) {
        const double s = std::sqrt(rng.uniform()), t = rng.uniform();
        return a + s * (b - a) + s * t * (c - b);
    };
    std::vector<Ray> rays;
    for (const FacetCorners& corners : soup.facets)
        for (std::size_t k = 0; k < each; ++k) {
            const auto corner = [&](std::size_t i) { return soup.vertices[corners[i]]; };
            Vec3 first = within(corner(0), corner(1), corner(2));
            Vec3 second = within(corner(0), corner(2), corner(3));
            if (k % 2 == 0)
                std::swap(first, second);
            const Vec3 way = second - first;
            Ray ray{first - 3 * rng.uniform() * way, glm::normalize(way)};
            if (k % 3 == 0) // just no longer both
                ray.origin += 1e-7 * point_within(rng, glm::length(way));
            rays.push_back(ray);
        }
    return rays;
}

void check_answers(const WideBvh& wide_bvh, const Answers& right, const std::vector<Ray>& rays) {
    const Differences found({wide_bvh, rays}, right);
    CHECK(found.closest == 0);
    CHECK(found.count == 0);
    CHECK(found.occluded == 0);
}

bool same(const std::optional<Hit>& a, const FacetHit& b) {
    return a ? a->facet == b.facet && a->front == b.front : b.facet == none;
}

/// How many rays are answered differently when many are asked at once.
void check_streams(const WideBvh& bvh, const std::vector<Ray>& rays) {
    std::vector<FacetHit> hits(rays.size());
    std::vector<std::uint8_t> occluded(rays.size());
    std::vector<std::uint32_t> targets, counts(rays.size());
    for (std::size_t k = 0; k < rays.size(); ++k)
        targets.push_back(static_cast<std::uint32_t>(k % 7));
    bvh.closest_stream(rays, hits);
    bvh.occluded_stream(rays, targets, occluded);
    bvh.count_stream(rays, counts);
    int closest_differ = 0, occluded_differ = 0, count_differ = 0;
    for (std::size_t k = 0; k < rays.size(); ++k) {
        const auto hit = bvh.closest(rays[k]);
        closest_differ += !same(hit, hits[k]);
        if (hit)
            CHECK(bvh.locate(rays[k], hits[k].facet).t == hit->t);
        occluded_differ += bvh.occluded(rays[k], targets[k]) != (occluded[k] != 0);
        count_differ += bvh.count(rays[k]) != counts[k];
    }
    CHECK(closest_differ == 0);
    CHECK(occluded_differ == 0);
    CHECK(count_differ == 0);
}

/// The soup, three hundred times smaller, in the middle of a box: as a scene lies under its sky.
Soup under_sky(Soup soup) {
    for (Vec3& v : soup.vertices)
        v = v / 300.0 + Vec3(2e-4, -1e-4, 0);
    const auto corner = [](unsigned k) {
        return Vec3(k & 1 ? .9 : -.9, k & 2 ? .9 : -.9, k & 4 ? .9 : -.9);
    };
    for (const auto& [a, b, c, d] :
         {std::array{0u, 2u, 3u, 1u}, std::array{4u, 5u, 7u, 6u}, std::array{0u, 1u, 5u, 4u},
          std::array{2u, 6u, 7u, 3u}, std::array{0u, 4u, 6u, 2u}, std::array{1u, 3u, 7u, 5u}})
        soup.quad(corner(a), corner(b), corner(c), corner(d));
    return soup;
}

void check_soup(const Soup& soup, std::size_t rays) {
    const std::vector<Ray> alone = rays_for(soup, rays, 99),
                           together = rays_for(soup, rays / 2, 98);
    const Answers right(BruteForce(soup.view()), alone);
    for (const InstructionSet kernels : available_instruction_sets()) {
        const WideBvh wide_bvh(soup.view(), {.kernels = kernels});
        CAPTURE(name_of(kernels), soup.facets.size());
        check_answers(wide_bvh, right, alone);
        check_streams(wide_bvh, together);
    }
}

} // namespace

TEST_CASE("The wide tree answers as brute force does") {
    for (const std::size_t facets : {1u, 2u, 9u, 70u, 1000u})
        check_soup(test::random_soup(facets, facets), 2000);
}

TEST_CASE("Trees too large for the cache answer the same") {
    const Soup soup = test::random_soup(20'000, 3);
    const std::vector<Ray> rays = rays_for(soup, 100, 97);
    const Answers right(BruteForce(soup.view()), rays);
    for (const InstructionSet kernels : available_instruction_sets()) {
        const WideBvh wide_bvh(soup.view(), {.kernels = kernels});
        REQUIRE(wide_bvh.quality().bytes > 1 << 20);
        CAPTURE(name_of(kernels));
        check_streams(wide_bvh, rays_for(soup, 2000, 98));
        check_answers(wide_bvh, right, rays);
    }
}

TEST_CASE("The wide tree and what breaks tracers") {
    SECTION("needles") { check_soup(test::needles(300, 1), 2000); }
    SECTION("thin walls") {
        for (const double gap : {1e-6, 1e-8, 1e-12})
            check_soup(test::thin_walls(8, gap, 4), 2000);
    }
    SECTION("odd quads") { check_soup(test::odd_quads(200, 1), 2000); }
    SECTION("quads that are not planar") {
        const Soup soup = test::warped_quads(300, 1);
        check_soup(soup, 2000);
        const std::vector<Ray> rays = rays_through_both_halves(soup, 20, 2);
        const Answers right(BruteForce(soup.view()), rays);
        for (const InstructionSet kernels : available_instruction_sets()) {
            const WideBvh wide_bvh(soup.view(), {.kernels = kernels});
            check_streams(wide_bvh, rays);
            check_answers(wide_bvh, right, rays);
        }
    }
    SECTION("deep trees") {
        for (const double shrink : {.99, .7, .3})
            check_soup(test::nested(300, shrink), 1000);
        CHECK(WideBvh(test::nested(3000, .9).view()).quality().depth <= int(wide::max_depth));
    }
    SECTION("copies") { check_soup(test::copies(200, 1), 2000); }
    SECTION("very small and very large scenes, and scenes far away") {
        for (const double size : {1e-30, 1e-3, 1e4, 1e30}) {
            Soup soup = test::random_soup(100, 5);
            for (Vec3& v : soup.vertices)
                v *= size;
            const BruteForce referee(soup.view());
            const WideBvh wide_bvh(soup.view());
            std::vector<Ray> rays = rays_for(test::random_soup(100, 5), 1000, 3);
            for (Ray& ray : rays) {
                ray.origin *= size;
                ray.t_max *= size;
                ray.t_min *= size;
            }
            const Differences found({wide_bvh, rays}, {referee, rays});
            CAPTURE(size);
            CHECK(found.closest == 0);
            CHECK(found.count == 0);
        }
        Soup away = test::random_soup(300, 6);
        for (Vec3& v : away.vertices)
            v += Vec3(1e3, 0, -1e3);
        std::vector<Ray> rays = rays_for(away, 1000, 4);
        for (std::size_t k = 0; k < rays.size(); k += 2)
            rays[k].origin += Vec3(1e3, 0, -1e3);
        const Differences found({WideBvh(away.view()), rays}, {BruteForce(away.view()), rays});
        CHECK(found.closest == 0);
        CHECK(found.count == 0);
    }
}

TEST_CASE("The wide tree and small scenes under a far sky") {
    for (const Soup& inner :
         {test::random_soup(300, 8), test::needles(100, 2), test::thin_walls(8, 1e-8, 5),
          test::odd_quads(100, 2), test::warped_quads(100, 2)}) {
        const Soup soup = under_sky(inner);
        check_soup(soup, 1000); // from outside of the scene, and from beyond the sky
        std::vector<Ray> rays = rays_for(soup, 1000, 12);
        for (Ray& ray : rays) {
            ray.origin /= 300.0;
            ray.t_max /= 300.0;
        }
        for (const Ray& ray : rays_through_both_halves(soup, 2, 3))
            rays.push_back(ray);
        const Answers right(BruteForce(soup.view()), rays);
        for (const InstructionSet kernels : available_instruction_sets()) {
            const WideBvh wide_bvh(soup.view(), {.kernels = kernels});
            check_streams(wide_bvh, rays);
            check_answers(wide_bvh, right, rays);
        }
    }
}

TEST_CASE("The wide tree over nothing, and over bad coordinates") {
    const WideBvh empty(FacetSoup{});
    const Ray up{Vec3(0.0), Vec3(0, 0, 1)};
    CHECK_FALSE(empty.closest(up));
    CHECK(empty.count(up) == 0);
    CHECK_FALSE(empty.occluded(up));
    CHECK(empty.quality().bytes == 0);
    FacetHit nearest{7, true};
    empty.closest_stream({&up, 1}, {&nearest, 1});
    CHECK(nearest.facet == none);
    std::uint8_t blocked = 1;
    empty.occluded_stream({&up, 1}, {&none, 1}, {&blocked, 1});
    CHECK(blocked == 0);
    std::uint32_t pierced = 7;
    empty.count_stream({&up, 1}, {&pierced, 1});
    CHECK(pierced == 0);
    CHECK(empty.triangles_around(Vec3(0.0)) == 0);

    const double nan = std::numeric_limits<double>::quiet_NaN();
    Soup soup{{{-1, -1, 1}, {1, -1, 1}, {0, 1, 1}, {nan, 0, 0}}, {{0, 1, 3, 3}}};
    const WideBvh bad(soup.view());
    CHECK_FALSE(bad.closest(up));
    soup.facets.push_back({0, 1, 2, 2});
    const WideBvh half(soup.view());
    REQUIRE(half.closest(up));
    CHECK(half.closest(up)->facet == 1);
    for (const Ray& ray :
         {Ray{Vec3(nan), Vec3(0, 0, 1)}, Ray{Vec3(0.0), Vec3(nan)}, Ray{Vec3(0.0), Vec3(0.0)},
          Ray{Vec3(0.0), Vec3(nan, 0, 1)}, Ray{Vec3(infinity), Vec3(0, 0, 1)},
          Ray{Vec3(0.0), Vec3(0, 0, infinity)}}) {
        CHECK_FALSE(half.closest(ray));
        CHECK_FALSE(half.occluded(ray));
        CHECK(half.count(ray) == 0);
    }
}

TEST_CASE("The wide tree does not depend on the number of threads") {
    const Soup soup = test::random_soup(60'000, 2);
    const auto one = wide::build(soup.view(), 1);
    for (const unsigned threads : {2u, 5u}) {
        const auto many = wide::build(soup.view(), threads);
        REQUIRE(one.nodes.size() == many.nodes.size());
        REQUIRE(one.leaves.size() == many.leaves.size());
        for (std::size_t i = 0; i < one.nodes.size(); ++i) {
            const wide::Node &a = one.nodes.data()[i], &b = many.nodes.data()[i];
            REQUIRE(std::memcmp(a.plane, b.plane, sizeof a.plane) == 0);
            REQUIRE(std::memcmp(a.child, b.child, sizeof a.child) == 0);
        }
        REQUIRE(std::memcmp(one.leaves.data(), many.leaves.data(), one.leaves.bytes()) == 0);
    }
}

TEST_CASE("The wide tree's own figures") {
    const Soup soup = test::random_soup(5000, 1);
    const BvhQuality q = WideBvh(soup.view()).quality();
    CHECK(q.leaves * 8 >= 7500); // halves of quads are triangles
    CHECK(q.nodes < q.leaves);
    CHECK(q.depth < 20);
    CHECK(q.bytes == q.nodes * sizeof(wide::Node) + q.leaves * sizeof(wide::Leaf));
}

// So a scene of triangles alone has no test of second halves.
TEST_CASE("Triangles that all pass through one point are counted around it, and not beside it") {
    Soup soup;
    constexpr int number = 500;
    for (int k = 0; k < number; ++k) {
        const double angle = .01 * k;
        const Vec3 along(std::cos(angle), std::sin(angle), .1 * std::sin(7 * angle));
        const Vec3 across = glm::normalize(glm::cross(along, Vec3(.3, .2, 1)));
        soup.triangle(along, -.5 * along + across, -.5 * along - across);
    }
    soup.triangle({10, 10, 10}, {11, 10, 10}, {10, 11, 10.5});
    const WideBvh bvh(soup.view());
    CHECK(bvh.triangles_around(Vec3(0)) == number);
    CHECK(bvh.triangles_around(Vec3(5)) == 0);
    CHECK(bvh.triangles_around(Vec3(10.3, 10.3, 10.1)) == 1);
}

TEST_CASE("A triangle takes one slot of a leaf, a quad two") {
    const auto slots = [](const wide::Built& built) {
        std::array<std::size_t, 2> found{}; // without and with the flag of second halves
        for (std::size_t i = 0; i < built.leaves.size(); ++i)
            for (const std::uint32_t slot : built.leaves.data()[i].slot)
                if (slot != wide::no_facet)
                    ++found[(slot & wide::flag) != 0];
        return found;
    };
    Soup soup = test::random_soup(1000, 3);
    std::size_t quads = 0;
    for (const FacetCorners& corners : soup.facets)
        quads += corners[2] != corners[3];
    REQUIRE(quads > 100);
    CHECK(slots(wide::build(soup.view(), 1)) == std::array{soup.facets.size(), quads});
    for (FacetCorners& corners : soup.facets)
        corners[3] = corners[2];
    CHECK(slots(wide::build(soup.view(), 1)) == std::array{soup.facets.size(), std::size_t{0}});
}
