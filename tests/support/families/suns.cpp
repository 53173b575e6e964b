// A sun: a quad 460 m wide 1e5 m away, or as large to the eye and nearer. It makes the scene so
// large that the ground is a point in it, and hardly any ray finds it.

#include "support/families/builders.h"
#include "support/families/families.h"
#include "support/scenes.h"

#include <array>
#include <numbers>

namespace hemilux::test {
namespace {

constexpr double sun_share = 460.0 / 1e5; ///< width over distance
constexpr std::uint32_t ground = 0, sun = 1, panel = 2, lamp = 3;

/// A square that faces the origin from a direction, and the emission that gives a surface facing it
/// an irradiance of 1.
struct Sun {
    Polygon shape;
    double emission;
};
Sun make_sun(const Vec3& toward, double distance) {
    const Vec3 d = glm::normalize(toward);
    const Vec3 first = glm::normalize(glm::cross(Vec3(0, 0, 1), d)) * (sun_share * distance);
    const Vec3 second = glm::cross(first, d); // first x second points down, to the origin
    return {parallelogram(distance * d - .5 * (first + second), first, second),
            std::numbers::pi / (sun_share * sun_share)};
}

struct GroundOptions {
    double distance = 1e5;
    bool with_panel =
        false; ///< 10 x 10 m at 5 m, an emission of 1, reflecting: light goes to and fro
    bool with_lamp = false; ///< .3 m wide at 3 m
    double sun_irradiance = 1;
};

/// The sun stands so low that its light passes below the panel: it rises less than 5 m over the
/// 10 m of ground. Nothing hides anything, so all factors are exchanges in the open.
HardScene sun_over_ground(const GroundOptions& options) {
    const Sun the_sun = make_sun({1, .4, 0}, options.distance);
    Scene scene = with_materials({grey("ground", .5, 0),
                                  grey("sun", 0, options.sun_irradiance * the_sun.emission),
                                  grey("panel", .5, 1), grey("lamp", 0, 300)});
    add_quad(scene, {-5, 0, -5}, {-5, 0, 5}, {5, 0, 5}, {5, 0, -5}, 10, 10, ground);
    const Range on_ground{0, facets_of(scene)};
    if (options.with_panel)
        add_quad(scene, {-5, 5, -5}, {5, 5, -5}, {5, 5, 5}, {-5, 5, 5}, 5, 5, panel);
    if (options.with_lamp)
        add_polygon(scene, parallelogram({-.15, 3, -.15}, {.3, 0, 0}, {0, 0, .3}), lamp);
    add_polygon(scene, the_sun.shape, sun);
    DenseSystem system(scene);
    system.add_open_pairs(on_ground, {on_ground.end, facets_of(scene)});
    return solved(std::move(scene), system, 1e-7, {on_ground.indices()});
}

/// A room of 4 x 4 m, 3 m high, one of whose 5 x 5 roof cells is missing: the sun shines in from
/// above, obliquely. The light that passes the opening is integrated from points of the sun, as
/// from each of them what the opening throws on a patch has a closed form.
HardScene sun_in_room(double distance, const Vec3& toward, double reflectance) {
    const Sun the_sun = make_sun(toward, distance);
    Scene scene = with_materials({grey("wall", reflectance, 0), grey("sun", 0, the_sun.emission)});
    const BuiltBox room =
        add_box(scene, {-2, 0, -2}, {2, 3, 2}, 5, 0, {{ceiling, 2, 2, missing_cell}});
    add_polygon(scene, the_sun.shape, sun);
    DenseSystem system(scene);
    ExchangeTable table;
    add_convex(system, room, table);
    constexpr int points = 64;
    for (std::size_t i = room.patches.begin; i < room.patches.end; ++i) {
        if (system.shape(i).normal().y < -.5)
            continue; // the roof, which lies in the plane of the opening
        const std::array<Aperture, 1> patch{{{system.shape(i), Side::same}}};
        const double area_factor = exchange_through(the_sun.shape, room.openings[0], patch, points);
        system.add_irradiance(i, Vec3(the_sun.emission * area_factor / system.area(i)));
    }
    return solved(std::move(scene), system, 1e-3, {room.patches.indices()});
}

} // namespace

Entries suns() {
    return {
        {"sun", "ground", [] { return sun_over_ground({}); }},
        {"sun", "ground, 1e4 m", [] { return sun_over_ground({.distance = 1e4}); }},
        {"sun", "ground and panel", [] { return sun_over_ground({.with_panel = true}); }},
        {"sun", "ground and panel, weak sun",
         [] { return sun_over_ground({.with_panel = true, .sun_irradiance = .03}); }},
        {"sun", "ground and panel, strong sun",
         [] { return sun_over_ground({.with_panel = true, .sun_irradiance = 100}); }},
        {"sun", "ground and lamp", [] { return sun_over_ground({.with_lamp = true}); }},
        {"sun", "room with roof opening",
         [] {
             return sun_in_room(1e5, {.3, 1, .2}, .5);
         }},
        {"sun", "room with roof opening, 1e4 m",
         [] {
             return sun_in_room(1e4, {.3, 1, .2}, .5);
         }},
        {"sun", "bright room with roof opening",
         [] {
             return sun_in_room(1e5, {.3, 1, .2}, .9);
         }},
    };
}

} // namespace hemilux::test
