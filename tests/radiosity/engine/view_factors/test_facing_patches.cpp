// The tree of groups leaves out no patch that counts, and most of those that do not.
#include "radiosity/engine/view_factors/facing_patches.h"
#include "radiosity/paper/sampling/rng.h"
#include "support/catch.h"

using namespace hemilux;

TEST_CASE("Groups of patches hold all that rise above a patch and are large and near enough") {
    Rng random(3);
    const auto in_box = [&] {
        return Vec3(random.uniform(), random.uniform(), random.uniform()) - .5;
    };
    std::vector<FacePlane> faces;
    for (int k = 0; k < 700; ++k) {
        const Vec3 at = 2.0 * in_box(), u = .1 * random.uniform() * in_box(),
                   v = glm::cross(u, 2.0 * in_box());
        faces.push_back(face_plane(Polygon{{at - u - v, at + u - v, at + u + v, at - u + v}}));
    }
    faces.push_back(faces.front()); // two of the same place
    const FacingPatches groups(faces);
    std::size_t visits = 0, counting = 0, all = 0;
    for (const double share : {0.0, 1e-5, 1e-3})
        for (std::uint32_t i = 0; i < faces.size(); i += 7) {
            std::vector<bool> is_visited(faces.size());
            groups.for_each(i, share, [&](std::uint32_t j) {
                CHECK((j > i && !is_visited[j]));
                is_visited[j] = true;
                ++visits;
            });
            for (std::uint32_t j = i + 1; j < faces.size(); ++j) {
                ++all;
                const bool counts = facing(faces[i], faces[j], 1e-9) != Facing::never &&
                                    rough_exchange(faces[i], faces[j]) >
                                        share * std::min(faces[i].area, faces[j].area);
                counting += counts ? 1 : 0;
                if (counts)
                    CHECK(is_visited[j]);
            }
        }
    CHECK(counting > 1000);
    CHECK(visits < all * 3 / 4);
}
