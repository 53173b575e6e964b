// The allowance for light that no ray has met: by hand, in scenes of few patches.
#include "radiosity/paper/solution/missed_light.h"
#include "support/catch.h"

#include <vector>

using namespace hemilux;

namespace {

/// One lamp, which leaves 10, and dark patches of area 2 and reflectance .5, each with as many
/// rays.
struct DarkRoom {
    explicit DarkRoom(std::size_t dark, double rays_of_each) {
        area.assign(dark + 1, 2.0);
        area[0] = 4;
        reflectance.assign(dark + 1, Vec3(.5));
        incident.assign(dark + 1, Vec3(0.0));
        leaving.assign(dark + 1, Vec3(0.0));
        leaving[0] = Vec3(10, 5, 0);
        rays.assign(dark + 1, rays_of_each);
    }
    [[nodiscard]] std::vector<Vec3> missed() const {
        return missed_by_rays({area, reflectance, incident, leaving, rays});
    }
    std::vector<double> area;
    std::vector<Vec3> reflectance, incident, leaving;
    std::vector<double> rays;
};

} // namespace

TEST_CASE("The brightness of most light is the mean radiosity weighted by itself") {
    DarkRoom room(1, 1);
    CHECK(bright_radiosity({room.area, room.reflectance, room.incident, room.leaving, room.rays}) ==
          Vec3(10, 5, 0));
    room.leaving[1] = Vec3(2, 0, 0); // (4 100 + 2 4) / (4 10 + 2 2)
    const Vec3 bright =
        bright_radiosity({room.area, room.reflectance, room.incident, room.leaving, room.rays});
    CHECK(bright.x == Approx(408.0 / 44));
    CHECK(bright.z == 0);
}

TEST_CASE("Three rays that met nothing stand for light that was missed") {
    // All patches are dark alike: 8 times 6 rays and those of the lamp, and half as many rays by
    // which the lamp looks at an area of half its own.
    const DarkRoom room(7, 6);
    for (const Vec3& missed : room.missed())
        CHECK(missed.x > 0);
    const Vec3 last = room.missed().back();
    CHECK(last.x == Approx(.5 * 10 * rule_of_three / (8 * 6 + 6 * 2 / 4.0)));
    CHECK(last.y == Approx(last.x / 2));
    CHECK(last.z == 0);
    // Ten times the rays, a tenth of the light.
    CHECK(DarkRoom(7, 60).missed().back().x == Approx(last.x / 10));
}

TEST_CASE("Rays of patches that are much brighter say nothing of a dark one") {
    DarkRoom room(4, 6);
    room.incident[0] = room.incident[1] = room.incident[2] = Vec3(1.0); // the other two are dark
    const std::vector<Vec3> missed = room.missed();
    CHECK(missed[4].x == Approx(.5 * 10 * rule_of_three / (2 * 6 + 6 * 2 / 4.0)));
    CHECK(missed[2].x == Approx(.5 * 10 * rule_of_three / (3 * 6 + 6 * 2 / 4.0)));
}
