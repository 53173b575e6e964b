// Thousands of tiny lamps. The room has no ceiling; black lamps hang in its plane and shine down,
// so that they hide nothing and get no light that would come back.

#include "support/families/builders.h"
#include "support/families/families.h"

#include <cmath>
#include <sstream>

namespace hemilux::test {
namespace {

/// A cube of 5 x 5 cells a side, its ceiling replaced by side x side lamps whose edges are such a
/// share of their distance. `spread`: the brightest emits so many times what the faintest does.
HardScene starry_room(std::uint32_t side, double share, double spread, double reflectance) {
    Scene scene = with_materials({grey("wall", reflectance, 0)});
    std::vector<OddCell> no_ceiling;
    constexpr std::uint32_t cells = 5;
    for (std::uint32_t k = 0; k < cells * cells; ++k)
        no_ceiling.push_back({ceiling, k % cells, k / cells, missing_cell});
    const BuiltBox room = add_box(scene, Vec3(0.0), Vec3(1.0), cells, 0, no_ceiling);
    constexpr std::uint32_t kinds = 5;
    for (std::uint32_t k = 0; k < kinds; ++k)
        scene.materials.push_back(grey("lamp", 0, std::pow(spread, double(k) / (kinds - 1))));
    DenseSystem system(scene); // without the lamps, which are black
    ExchangeTable table;
    add_convex(system, {room.patches, {parallelogram({0, 1, 0}, {1, 0, 0}, {0, 0, 1})}}, table);
    const double distance = 1.0 / side, edge = share * distance;
    for (std::uint32_t k = 0; k < side * side; ++k) {
        const Vec3 corner((k % side + .5) * distance - edge / 2, 1,
                          (k / side + .5) * distance - edge / 2);
        const Polygon shape = parallelogram(corner, {edge, 0, 0}, {0, 0, edge});
        const std::uint32_t material = 1 + (k * 7 + k / side) % kinds;
        add_polygon(scene, shape, material);
        for (std::size_t i = room.patches.begin; i < room.patches.end; ++i)
            system.add_irradiance(i, scene.materials[material].emission / system.area(i) *
                                         exchange_through(shape, system.shape(i), {}, 2));
    }
    std::vector<Vec3> reference = system.solve();
    for (std::size_t f = reference.size(); f < scene.facets.size(); ++f)
        reference.push_back(scene.materials[scene.facets[f].material].emission);
    return solved(std::move(scene), std::move(reference), 1e-4, {room.patches.indices()});
}

} // namespace

Entries tiny_emitters() {
    return {
        {"tiny", "900 equal lamps", [] { return starry_room(30, .1, 1, .5); }},
        {"tiny", "2500 lamps, emissions to 1e4 apart",
         [] { return starry_room(50, .02, 1e4, .5); }},
        {"tiny", "2500 lamps in a bright room", [] { return starry_room(50, .01, 100, .9); }},
    };
}

} // namespace hemilux::test
