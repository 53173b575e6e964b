// What the tree costs where all triangles fit one of its leaves: nanoseconds a ray with the tree,
// without it (radiosity/paper/scene/needs.h leaves it out there), and by a loop over the facets one
// after the other. One thread.
//
//     few_facets
#include "bvh/brute_force.h"
#include "bvh/wide/wide_bvh.h"
#include "radiosity/paper/rays/shot.h"
#include "radiosity/paper/sampling/rng.h"
#include "timed_rounds.h"

#include <cstdio>

using namespace hemilux;

namespace {

struct Room {
    std::vector<Vec3> vertices;
    std::vector<FacetCorners> facets;

    void add_quad(const Vec3& corner, const Vec3& u, const Vec3& v) {
        const auto first = static_cast<std::uint32_t>(vertices.size());
        vertices.insert(vertices.end(), {corner, corner + u, corner + u + v, corner + v});
        facets.push_back({first, first + 1, first + 2, first + 3});
    }
    [[nodiscard]] FacetSoup soup() const { return {vertices, facets}; }
};

/// Sides of the unit cube, then small quads within.
Room make_room(unsigned facets) {
    Room room;
    const Vec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1), origin(0.0), far(1.0);
    for (const auto& [u, v] : {std::pair(x, z), std::pair(z, y), std::pair(y, x)}) {
        if (room.facets.size() < facets)
            room.add_quad(origin, u, v);
        if (room.facets.size() < facets)
            room.add_quad(far, -v, -u);
    }
    Rng rng(facets);
    const auto point = [&] { return Vec3(rng.uniform(), rng.uniform(), rng.uniform()); };
    while (room.facets.size() < facets) {
        const Vec3 u = .1 * (point() - .5), v = .1 * (point() - .5);
        room.add_quad(.1 + .7 * point(), u, v);
    }
    return room;
}

std::vector<Ray> make_rays(std::size_t count) {
    Rng rng(1);
    std::vector<Ray> rays(count);
    for (Ray& ray : rays) {
        ray.origin = {rng.uniform(), rng.uniform(), rng.uniform()};
        ray.direction = sample_cosine(rng);
    }
    return rays;
}

} // namespace

int main() {
    constexpr std::size_t count = 100'000;
    constexpr int rounds = 31;
    const std::vector<Ray> rays = make_rays(count);
    std::vector<FacetHit> hits(count);
    std::printf("quads  tree [ns]  without [ns]  loop [ns]\n");
    for (const unsigned facets : {1u, 2u, 3u, 4u, 5u, 6u}) {
        const Room room = make_room(facets);
        const WideBvh tree(room.soup(), {.threads = 1});
        const WideBvh without(room.soup(), {.threads = 1, .hierarchy = false});
        const BruteForce loop(room.soup());
        std::vector<std::function<void()>> variants;
        for (const Tracer* const tracer :
             {static_cast<const Tracer*>(&tree), static_cast<const Tracer*>(&without),
              static_cast<const Tracer*>(&loop)})
            variants.push_back([&, tracer] { tracer->closest_stream(rays, hits); });
        const auto seconds = bench::fastest_of_rounds(variants, rounds);
        std::printf("%5u  %9.0f  %12.0f  %9.0f\n", facets, 1e9 * seconds[0] / count,
                    1e9 * seconds[1] / count, 1e9 * seconds[2] / count);
    }
}
