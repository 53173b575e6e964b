// Two boxes joined by a small hole in their common wall, light in one of them: the pinhole. And a
// lamp in a shade with a slit: a small box with the lamp stands on a room, or hangs over open
// ground.

#include "support/families/builders.h"
#include "support/families/families.h"
#include "support/scenes.h"

#include <array>
#include <sstream>

namespace hemilux::test {
namespace {

constexpr std::uint32_t wall = 0, shade = 1, lamp = 2;

/// Light between the patches of two convex boxes through their common opening, by quadrature over
/// it (exchange_through). A patch that lies in the opening's plane takes no part.
void join(DenseSystem& system, const BuiltBox& first, const BuiltBox& second, int points) {
    const Polygon& hole = first.openings[0];
    for (std::size_t i = first.patches.begin; i < first.patches.end; ++i) {
        const std::array<Aperture, 1> behind{{{system.shape(i), Side::opposite}}};
        for (std::size_t j = second.patches.begin; j < second.patches.end; ++j)
            system.set(i, j, exchange_through(hole, system.shape(j), behind, points));
    }
}

/// The rows within each box are closed up to its opening, exactly, and then the light through the
/// opening is scaled to what the opening takes.
HardScene joined(Scene scene, const BuiltBox& lit, const BuiltBox& dark, int points,
                 double relative_error) {
    DenseSystem system(scene);
    ExchangeTable table;
    add_convex(system, lit, table);
    add_convex(system, dark, table);
    join(system, lit, dark, points);
    system.close_rows({0, facets_of(scene)});
    return solved(std::move(scene), system, relative_error,
                  {lit.patches.indices(), dark.patches.indices()});
}

/// Unit cubes whose common wall has a square hole with an edge of so much of the wall's.
HardScene pinhole(double edge, double reflectance) {
    constexpr std::uint32_t n = 3;
    Scene scene = with_materials(
        {grey("wall", reflectance, 0), grey("unused", 0, 0), grey("lamp", reflectance, 100)});
    const Inset hole{Vec2(n * edge), std::nullopt};
    const BuiltBox lit = add_box(scene, Vec3(0.0), Vec3(1.0), n, wall,
                                 {{right, 1, 1, hole}, {ceiling, 1, 1, {Vec2(.2), lamp}}});
    const BuiltBox dark = add_box(scene, {1, 0, 0}, {2, 1, 1}, n, wall, {{left, 1, 1, hole}});
    return joined(std::move(scene), lit, dark, 4, 1e-4);
}

/// A box of 0.2 m with a lamp at its top, on the ceiling of a unit cube; between them a slit of
/// half its length and so much of its width.
HardScene shaded_lamp(double width, double shade_reflectance) {
    Scene scene = with_materials(
        {grey("wall", .5, 0), grey("shade", shade_reflectance, 0), grey("lamp", .5, 100)});
    const BuiltBox lit = add_box(
        scene, {.4, 1, .4}, {.6, 1.2, .6}, 1, shade,
        {{floor_side, 0, 0, {{.5, width}, std::nullopt}}, {ceiling, 0, 0, {Vec2(.5), lamp}}});
    const BuiltBox dark = add_box(scene, Vec3(0.0), Vec3(1.0), 5, wall,
                                  {{ceiling, 2, 2, {{width, .5}, std::nullopt}}});
    return joined(std::move(scene), lit, dark, 16, 1e-3);
}

/// A box of 0.4 m with a lamp at its top, 3 m over open ground, with a slit in its floor. Outside
/// it is black, as it consists of the backs of its inner sides; the ground sees nothing but the
/// slit.
HardScene shade_over_ground(double width, double shade_reflectance) {
    Scene scene = with_materials(
        {grey("ground", .5, 0), grey("shade", shade_reflectance, 0), grey("lamp", .5, 1e4)});
    const BuiltBox lit = add_box(
        scene, {-.2, 3, -.2}, {.2, 3.4, .2}, 1, shade,
        {{floor_side, 0, 0, {{.5, width}, std::nullopt}}, {ceiling, 0, 0, {Vec2(.5), lamp}}});
    BuiltBox ground{{lit.patches.end, lit.patches.end}, {}};
    add_quad(scene, {-5, 0, -5}, {-5, 0, 5}, {5, 0, 5}, {5, 0, -5}, 10, 10, 0);
    ground.patches.end = facets_of(scene);
    DenseSystem system(scene);
    ExchangeTable table;
    add_convex(system, lit, table);
    join(system, lit, ground, 16);
    return solved(std::move(scene), system, 1e-3,
                  {lit.patches.indices(), ground.patches.indices()});
}

template <class Make>
HardSceneEntry entry(const char* family, const char* what, double size, double reflectance,
                     const Make& make) {
    std::ostringstream name;
    name << what << size << ", reflectance " << reflectance;
    return {family, name.str(), [=] { return make(size, reflectance); }};
}

} // namespace

Entries pinholes() {
    Entries entries;
    for (const double edge : {1e-2, 1e-3, 1e-4, 1e-5})
        entries.push_back(entry("pinhole", "", edge, .5, pinhole));
    entries.push_back(entry("pinhole", "", 1e-3, .9, pinhole));
    for (const double width : {.1, .01, .001})
        entries.push_back(entry("shade", "", width, .5, shaded_lamp));
    entries.push_back(entry("shade", "", .01, .9, shaded_lamp));
    for (const double width : {.1, .01, .001})
        entries.push_back(entry("shade", "over ground, ", width, .8, shade_over_ground));
    return entries;
}

} // namespace hemilux::test
