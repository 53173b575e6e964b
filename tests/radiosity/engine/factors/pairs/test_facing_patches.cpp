// The tree of groups leaves out no patch that counts, and most of those that do not.
#include "radiosity/engine/factors/pairs/facing_patches.h"
#include "radiosity/paper/sampling/rng.h"
#include "support/catch.h"

using namespace hemilux;

namespace {

struct Count {
    std::size_t visits = 0, counting = 0, all = 0;
};

/// Checks that all that count are visited, and once.
Count check_visits(const std::vector<FacePlane>& faces, double share) {
    Count count;
    const FacingPatches groups(faces);
    for (std::uint32_t i = 0; i < faces.size(); i += 7) {
        std::vector<bool> is_visited(faces.size());
        groups.for_each(i, share, [&](std::uint32_t j) {
            CHECK((j > i && !is_visited[j]));
            is_visited[j] = true;
            ++count.visits;
        });
        for (std::uint32_t j = i + 1; j < faces.size(); ++j) {
            ++count.all;
            const bool counts =
                facing(faces[i], faces[j], 1e-9) != Facing::never &&
                exchange_bound(faces[i], faces[j]) > share * std::min(faces[i].area, faces[j].area);
            count.counting += counts ? 1 : 0;
            if (counts)
                CHECK(is_visited[j]);
        }
    }
    return count;
}

Vec3 in_box(Rng& random) { return Vec3(random.uniform(), random.uniform(), random.uniform()) - .5; }

FacePlane face_at(const Vec3& at, const Vec3& u, const Vec3& v) {
    return face_plane(Polygon{{at - u - v, at + u - v, at + u + v, at - u + v}});
}

} // namespace

TEST_CASE("No pair exchanges more than its bound, however long or near it is") {
    Rng random(2);
    int pairs = 0, near = 0;
    for (int k = 0; k < 4000; ++k) {
        const auto face = [&] {
            const double length = k % 2 == 0 ? 1 : 1e-3;
            const Vec3 u = random.uniform() * in_box(random);
            return face_at((k % 3 == 0 ? 6.0 : 1.0) * in_box(random), u,
                           length * glm::cross(u, in_box(random)));
        };
        const FacePlane a = face(), b = face();
        const Facing facing = hemilux::facing(a, b, 1e-9);
        if (facing == Facing::never)
            continue;
        const double exchange = free_exchange(a, b, facing, FreeAccuracy::exact, 1e-9),
                     bound = exchange_bound(a, b);
        CHECK(exchange <= bound * (1 + 1e-9));
        ++pairs;
        near += exchange > .05 * bound ? 1 : 0;
    }
    CHECK(pairs > 1000);
    CHECK(near > 100);
}

TEST_CASE("Groups of patches hold all that face a patch and are large and near enough") {
    Rng random(3);
    std::vector<FacePlane> faces;
    for (int k = 0; k < 700; ++k) {
        const Vec3 at = 2.0 * in_box(random), u = .1 * random.uniform() * in_box(random);
        faces.push_back(face_at(at, u, glm::cross(u, 2.0 * in_box(random))));
    }
    faces.push_back(faces.front()); // two of the same place
    for (const double share : {0.0, 1e-6, 1e-5, 1e-3})
        CHECK(check_visits(faces, share).counting > 500);
}

TEST_CASE("Groups of patches leave out most of a city that do not count") {
    Rng random(4);
    std::vector<FacePlane> faces;
    for (int k = 0; k < 4000; ++k) { // walls, roofs and floors within a flat space, nearly upright
        const Vec3 at = 2.0 * in_box(random) * Vec3(1, 1, .1);
        const int axis = k % 3;
        Vec3 u = .01 * in_box(random), v = .01 * in_box(random);
        u[(axis + 1) % 3] = .02 * random.uniform();
        v[(axis + 2) % 3] = k % 2 == 0 ? .02 : -.02;
        faces.push_back(face_at(at, u, v));
    }
    const Count count = check_visits(faces, 1e-3);
    CHECK(count.counting > 10000);
    CHECK(count.visits < count.all / 4);
}
