// Spheres of triangles with a small port, bright inside: light meets the wall hundreds of times
// before it gets out. The port is a missing triangle, or a small similar one inside of a triangle.

#include "support/families/builders.h"
#include "support/families/families.h"
#include "support/scenes.h"

#include <sstream>

namespace hemilux::test {
namespace {

constexpr std::uint32_t wall = 0, lamp = 1;

struct SphereOptions {
    double reflectance;
    double port;    ///< edge of the missing triangle over that of a triangle of the mesh
    bool all_emits; ///< else one triangle
    int level = 2;  ///< 8 * 4^level triangles
};

/// The mesh is convex: all triangles see each other fully but for those around the port, which lie
/// in one plane.
HardScene sphere_with_port(const SphereOptions& options) {
    const Scene whole = sphere(options.level, 1, options.reflectance, 0);
    Scene scene = with_materials({grey("wall", options.reflectance, options.all_emits ? 1 : 0),
                                  grey("lamp", options.reflectance, 1)});
    BuiltBox box;
    const std::size_t n = whole.facets.size(), port = 0, lit = n / 2 + 3;
    for (std::size_t f = 0; f < n; ++f) {
        const Polygon triangle = polygon_of(whole, f);
        if (f == port)
            box.openings.push_back(
                add_with_inset(scene, triangle, wall, {Vec2(options.port), std::nullopt}));
        else
            add_polygon(scene, triangle, f == lit && !options.all_emits ? lamp : wall);
    }
    box.patches = {0, facets_of(scene)};
    DenseSystem system(scene);
    static ExchangeTable table; // for all spheres
    add_convex(system, box, table);
    return solved(std::move(scene), system, 1e-6, {box.patches.indices()});
}

} // namespace

Entries spheres() {
    Entries entries;
    for (const double reflectance : {.9, .99, .9999})
        for (const double port : {1.0, .1, .01}) {
            std::ostringstream name;
            name << "reflectance " << reflectance << ", port " << port << " of a triangle's edge";
            for (const bool all : {true, false})
                entries.push_back(
                    {"sphere", name.str() + (all ? ", all emits" : ", one emits"), [=] {
                         return sphere_with_port({reflectance, port, all});
                     }});
        }
    return entries;
}

} // namespace hemilux::test
