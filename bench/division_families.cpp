#include "division_families.h"

#include "geometry/vector.h"

#include <array>

namespace hemilux::bench {
namespace {

enum : std::uint32_t { wall, red, block, lamp, black };

struct Room {
    Scene scene;
    double scale;

    Room(double reflectance, double emission, double size) : scale(size) {
        const Vec3 rho(reflectance);
        scene.materials = {{"wall", rho, Vec3(0)},
                           {"red", rho * Vec3(1, .3, .2), Vec3(0)},
                           {"block", .8 * rho, Vec3(0)},
                           {"lamp", Vec3(0), emission * Vec3(1, .9, .7)},
                           {"black", Vec3(0), Vec3(0)}};
        scene.groups = {"default"};
    }
    /// Corners counter-clockwise from the front.
    void quad(const std::array<Vec3, 4>& corners, std::uint32_t material) {
        const auto first = static_cast<std::uint32_t>(scene.vertices.size());
        for (const Vec3& corner : corners)
            scene.vertices.push_back(scale * corner);
        scene.facets.push_back(
            {{first, first + 1, first + 2, first + 3}, scene.faces++, material, 0});
    }
    void quad(const Vec3& p, const Vec3& u, const Vec3& v, std::uint32_t material) {
        quad({p, p + u, p + u + v, p + v}, material);
    }
    /// One quad a side; from within, or from outside.
    void box(const Vec3& low, const Vec3& high, std::uint32_t material, bool inside,
             unsigned sides = 63) {
        const Vec3 d = high - low, x(d.x, 0, 0), y(0, d.y, 0), z(0, 0, d.z);
        const std::array<std::array<Vec3, 3>, 6> of{{{low, z, x},
                                                     {low + y, x, z},
                                                     {low, y, z},
                                                     {low + x, z, y},
                                                     {low, x, y},
                                                     {low + z, y, x}}};
        for (unsigned s = 0; s < 6; ++s)
            if (sides >> s & 1)
                inside ? quad(of[s][0], of[s][1], of[s][2], s == 2 ? red : material)
                       : quad(of[s][0], of[s][2], of[s][1], material);
    }
    /// Boxes that stand on the floor: what is under them sees nothing.
    void furnish() {
        box({.5, 0, .6}, {1.2, .8, 1.5}, block, false);
        box({2.1, 0, 1.1}, {2.9, 1.6, 1.9}, block, false);
    }
    void lamp_at(const Vec3& corner, double width, double depth) {
        quad(corner, {width, 0, 0}, {0, 0, depth}, lamp);
    }
};

constexpr unsigned no_floor = 63 - 1, no_ceiling = 63 - 2, no_left = 63 - 4, no_ends = 63 - 3;
const Vec3 low(0), high(4, 2.5, 3);

Scene furnished(double reflectance, double emission, double size) {
    Room room(reflectance, emission, size);
    room.box(low, high, wall, true);
    room.furnish();
    room.lamp_at({1.6, 2.49, 1.2}, .6, .4);
    return room.scene;
}

/// A bright wall outside, seen through the opening of the left wall.
Scene window() {
    Room room(.6, 10, 1);
    room.box(low, high, wall, true, no_left);
    room.furnish();
    const double y0 = 1, y1 = 2, z0 = 1, z1 = 2;
    room.quad({0, 0, 0}, {0, y0, 0}, {0, 0, high.z}, wall);
    room.quad({0, y1, 0}, {0, high.y - y1, 0}, {0, 0, high.z}, wall);
    room.quad({0, y0, 0}, {0, y1 - y0, 0}, {0, 0, z0}, wall);
    room.quad({0, y0, z1}, {0, y1 - y0, 0}, {0, 0, high.z - z1}, wall);
    room.quad({-3, -4, -4}, {0, 12, 0}, {0, 0, 12}, lamp);
    return room.scene;
}

/// A small far emitter throws sharp shadows through the open ceiling.
Scene sunlit() {
    Room room(.5, 1e6, 1);
    room.box(low, high, wall, true, no_ceiling);
    room.furnish();
    room.quad({30, 60, 20}, {.6, -.3, 0}, {0, -.2, .6}, lamp);
    return room.scene;
}

Scene many_lamps() {
    Room room(.6, 50, 1);
    room.box(low, high, wall, true);
    room.furnish();
    for (int i = 0; i < 8; ++i)
        for (int k = 0; k < 6; ++k)
            room.lamp_at({.2 + .5 * i, 2.48, .2 + .5 * k}, .05, .05);
    return room.scene;
}

/// Walls of faces that do not meet vertex to vertex.
Scene t_junctions() {
    Room room(.7, 20, 1);
    room.box(low, high, wall, true, 63 - 1 - 8);
    for (int i = 0; i < 5; ++i)
        for (int k = 0; k < 3 + i; ++k)
            room.quad({.8 * i, 0, 3.0 * k / (3 + i)}, {0, 0, 3.0 / (3 + i)}, {.8, 0, 0}, wall);
    for (int k = 0; k < 7; ++k)
        room.quad({4, 0, 3.0 * k / 7}, {0, 0, 3.0 / 7}, {0, 2.5, 0}, wall);
    room.furnish();
    room.lamp_at({1.6, 2.49, 1.2}, .6, .4);
    return room.scene;
}

/// Thin screens that receive on both sides.
Scene screens() {
    Room room(.6, 20, 1);
    room.box(low, high, wall, true);
    room.quad({1, 0, .5}, {0, 1.8, 0}, {.3, 0, 1.5}, block);
    room.quad({2.6, .7, .4}, {.8, .2, 0}, {0, 0, 1.4}, block);
    room.lamp_at({1.6, 2.2, 1.2}, .6, .4);
    return room.scene;
}

/// Around a corner, lit at one end.
Scene corridor() {
    Room room(.7, 20, 1);
    const Vec3 up(0, 2.5, 0);
    const std::array<Vec3, 6> corners{
        {{0, 0, 0}, {8, 0, 0}, {8, 0, 8}, {6, 0, 8}, {6, 0, 2}, {0, 0, 2}}};
    for (std::size_t k = 0; k < corners.size(); ++k) {
        const Vec3 &from = corners[k], &to = corners[(k + 1) % corners.size()];
        room.quad(from, to - from, up, k % 2 ? wall : red);
    }
    const auto floor_and_ceiling = [&](const Vec3& corner, double width, double depth) {
        room.quad(corner, {0, 0, depth}, {width, 0, 0}, block);
        room.quad(corner + up, {width, 0, 0}, {0, 0, depth}, wall);
    };
    floor_and_ceiling({0, 0, 0}, 6, 2);
    floor_and_ceiling({6, 0, 0}, 2, 2);
    floor_and_ceiling({6, 0, 2}, 2, 6);
    room.lamp_at({.8, 2.4, .8}, .4, .4);
    return room.scene;
}

Scene columns() {
    Room room(.6, 20, 1);
    room.box(low, {9, 3, 6}, wall, true);
    for (int i = 0; i < 4; ++i)
        for (int k = 0; k < 3; ++k) {
            const Vec3 corner(1.35 + 2 * i, 0, .85 + 2 * k);
            room.box(corner, corner + Vec3(.3, 3, .3), block, false, no_ends);
        }
    room.lamp_at({.5, 2.95, 2.7}, .6, .6);
    room.lamp_at({7.85, 2.5, .45}, .3, .3);
    return room.scene;
}

Scene stairs() {
    Room room(.7, 20, 1);
    room.box(low, {5, 4, 2}, wall, true);
    for (int i = 0; i < 10; ++i)
        room.box({.8 + .35 * i, 0, .2}, {1.15 + .35 * i, .18 * (i + 1), 1.8}, i % 2 ? block : red,
                 false, no_floor);
    room.lamp_at({.8, 3.9, .8}, .4, .4);
    return room.scene;
}

/// A lamp that is seen from the ceiling alone.
Scene cove() {
    Room room(.7, 20, 1);
    room.box(low, {5, 2.8, 4}, wall, true);
    room.box({.02, 2.3, .02}, {.4, 2.34, 3.98}, block, false);
    room.box({.36, 2.35, .02}, {.4, 2.5, 3.98}, block, false);
    room.quad({.1, 2.36, .2}, {0, 0, 3.6}, {.2, 0, 0}, lamp);
    room.box({2, 0, 1.5}, {3.2, .75, 2.5}, red, false, no_floor);
    return room.scene;
}

/// Small and bright, a hand from a wall.
Scene spot() {
    Room room(.7, 400, 1);
    room.box(low, high, wall, true);
    room.furnish();
    room.box({.1, 1.55, 2.2}, {.2, 1.65, 2.3}, lamp, false);
    return room.scene;
}

} // namespace

const std::vector<DivisionFamily>& division_families() {
    static const std::vector<DivisionFamily> all{
        {"furnished", false, [] { return furnished(.6, 20, 1); }},
        {"bright", false, [] { return furnished(.95, 20, 1); }},
        {"dark", false, [] { return furnished(.1, 20, 1); }},
        {"faint", false, [] { return furnished(.6, 1e-9, 1); }},
        {"tiny", false, [] { return furnished(.6, 20, 1e-3); }},
        {"huge", false, [] { return furnished(.6, 20, 1e4); }},
        {"window", false, window},
        {"sunlit", false, sunlit},
        {"many-lamps", false, many_lamps},
        {"t-junctions", false, t_junctions},
        {"screens", true, screens},
        {"corridor", false, corridor},
        {"columns", false, columns},
        {"stairs", false, stairs},
        {"cove", false, cove},
        {"spot", false, spot}};
    return all;
}

} // namespace hemilux::bench
