// Files whose vertices lie so far away that doubles hardly tell them apart.
#include "geometry/frame.h"
#include "io/files/error.h"
#include "io/scene_files/obj.h"
#include "support/catch.h"
#include "support/scenes.h"
#include "support/temporary_folder.h"

#include <iomanip>
#include <sstream>

using namespace hemilux;

namespace {

/// Oblique to all axes, so that no coordinate is exact; with furniture, so that rays are stopped.
Scene oblique_room() {
    Scene scene = test::room_with_block();
    const Frame frame = Frame::from_normal(glm::normalize(Vec3(.3, .5, .8))).turned(.7);
    for (Vec3& v : scene.vertices)
        v = frame.to_world(v);
    return scene;
}

Scene placed(Scene scene, double unit, const Vec3& shift) {
    for (Vec3& v : scene.vertices)
        v = unit * v + shift;
    return scene;
}

constexpr double room_size = 4.7; ///< the diagonal

/// The program's result without the folder's name.
std::string rounding_warning(const std::string& obj, std::size_t* facets = nullptr) {
    const test::TemporaryFolder folder;
    const std::string path = folder.write("s.obj", obj);
    try {
        const ReadResult read = read_obj(path);
        if (facets)
            *facets = read.scene.facets.size();
        std::string all;
        for (const std::string& warning : read.warnings)
            all += warning.substr(warning.find("s.obj")) + "\n";
        return all;
    } catch (const InputError& error) {
        return "error: " + std::string(error.what());
    }
}

std::string obj_of(const Scene& scene) {
    std::ostringstream text;
    text << std::setprecision(17);
    for (const Vec3& v : scene.vertices)
        text << "v " << v.x << ' ' << v.y << ' ' << v.z << '\n';
    for (const Facet& facet : scene.facets) {
        text << 'f';
        for (const std::uint32_t v : facet.vertex)
            text << ' ' << v + 1;
        text << '\n';
    }
    return text.str();
}

} // namespace

TEST_CASE("Where doubles no longer tell places apart it is said") {
    const Scene room = oblique_room();
    const auto at = [&](double sizes) {
        return obj_of(placed(room, 1, sizes * room_size * Vec3(.7, -1, .4)));
    };
    std::size_t facets = 0;
    CHECK(rounding_warning(at(1e8), &facets).empty());
    CHECK(facets == room.facets.size());
    // Distinct still, but no longer where they were.
    CHECK(rounding_warning(at(1e11)) ==
          "s.obj: all lies near 4.7e+11, where numbers are rounded to 0.0001, and "
          "is 4.5 wide; move it nearer to the origin\n");
    // Some have collapsed: how many is said too.
    const std::string some = rounding_warning(at(1e13), &facets);
    CHECK(some.find("move it nearer to the origin") != std::string::npos);
    CHECK(some.find("8 faces without area are left out") != std::string::npos);
    CHECK(facets > 0);
    const std::string all = rounding_warning(at(1e17));
    CHECK(all.starts_with("error: "));
    CHECK(all.find("none of the faces has an area: all lies near 4.7e+17, where numbers are "
                   "rounded to 1e+02") != std::string::npos);
}
