// One ray.
//
// Shows: the two questions that everything else is built on. A scene of two facets, a quad and
// behind it a triangle; a ray that pierces both: which facet is the nearest, and how many are
// there. Prints: the nearest hit (facet, distance, side) and the count. The answers are 0, at
// distance 1, and 2.

#include "bvh/bvh.h"

#include <cstdio>
#include <vector>

int main() {
    using namespace hemilux;
    const std::vector<Vec3> vertices{
        {-1, -1, 0},  {1, -1, 0},  {1, 1, 0},  {-1, 1, 0}, // a square that faces +z
        {-1, -1, -2}, {1, -1, -2}, {0, 1, -2},             // a triangle two metres behind it
    };
    const std::vector<FacetCorners> facets{{0, 1, 2, 3}, {4, 5, 6, 6}};
    const Bvh bvh(FacetSoup{vertices, facets});

    const Ray ray{.origin = {0.1, 0.2, 1}, .direction = {0, 0, -1}};
    const std::optional<Hit> hit = bvh.closest(ray);
    if (!hit) {
        std::printf("the ray misses\n");
        return 1;
    }
    const std::uint32_t count = bvh.count(ray);
    std::printf("nearest: facet %u at distance %g, %s side\n", hit->facet, hit->t,
                hit->front ? "front" : "back");
    std::printf("facets on the ray: %u\n", count);
    return hit->facet == 0 && hit->t == 1 && hit->front && count == 2 ? 0 : 1;
}
