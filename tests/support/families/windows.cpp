// Cube rooms of 7 x 7 cells a side with a small lamp in the ceiling and a window of missing cells,
// through which all light gets out that nothing absorbs. All pairs of patches see each other.

#include "support/families/builders.h"
#include "support/families/families.h"

#include <sstream>

namespace hemilux::test {
namespace {

constexpr std::uint32_t cells = 7, lamp = 1;

/// The missing cells are taken row by row from the right wall.
HardScene room_with_window(double reflectance, std::uint32_t missing) {
    Scene scene = with_materials({grey("wall", reflectance, 0), grey("lamp", reflectance, 1000)});
    std::vector<OddCell> odd{{ceiling, 2, 3, {Vec2(.2), lamp}}};
    for (std::uint32_t k = 0; k < missing; ++k)
        odd.push_back({right, 1 + k % 5, 2 + k / 5, missing_cell});
    const BuiltBox room = add_box(scene, Vec3(0.0), Vec3(1.0), cells, 0, odd);
    DenseSystem system(scene);
    static ExchangeTable table; // for all rooms of the family
    add_convex(system, room, table);
    return solved(std::move(scene), system, 1e-6, {room.patches.indices()});
}

} // namespace

Entries windows() {
    Entries entries;
    for (const double reflectance : {.5, .8, .95})
        for (const std::uint32_t missing : {1u, 5u, 20u}) {
            std::ostringstream name;
            name << "reflectance " << reflectance << ", " << missing << " cells open";
            entries.push_back(
                {"window", name.str(), [=] { return room_with_window(reflectance, missing); }});
        }
    return entries;
}

} // namespace hemilux::test
