// Rooms that know nothing of each other, in one scene, with lamps up to 1e12 apart: an error that
// is measured over all of them is that of the brightest one. And one room with lamps of different
// colours as far apart: the same for channels.

#include "support/families/builders.h"
#include "support/families/families.h"

#include <sstream>

namespace hemilux::test {
namespace {

constexpr std::uint32_t cells = 4;

/// Unit cubes beside each other at distances of 0.5 m, each with a lamp in its ceiling.
HardScene rooms_with_lamps(const std::vector<double>& emissions, double reflectance) {
    Scene scene = with_materials({grey("wall", reflectance, 0)});
    std::vector<BuiltBox> rooms;
    for (const double emission : emissions) {
        const auto lamp = static_cast<std::uint32_t>(scene.materials.size());
        scene.materials.push_back(grey("lamp", reflectance, emission));
        const Vec3 low(1.5 * double(rooms.size()), 0, 0);
        rooms.push_back(
            add_box(scene, low, low + Vec3(1.0), cells, 0, {{ceiling, 1, 2, {Vec2(.2), lamp}}}));
    }
    DenseSystem system(scene);
    ExchangeTable table;
    std::vector<std::vector<std::uint32_t>> parts;
    for (const BuiltBox& room : rooms) {
        add_convex(system, room, table);
        parts.push_back(room.patches.indices());
    }
    return solved(std::move(scene), system, 1e-6, std::move(parts));
}

/// A lamp for each channel, in different cells of the ceiling and the left wall.
HardScene coloured_lamps(const Vec3& emission, double reflectance) {
    Scene scene = with_materials({grey("wall", reflectance, 0),
                                  {"red", Vec3(reflectance), Vec3(emission.x, 0, 0)},
                                  {"green", Vec3(reflectance), Vec3(0, emission.y, 0)},
                                  {"blue", Vec3(reflectance), Vec3(0, 0, emission.z)}});
    const BuiltBox room = add_box(scene, Vec3(0.0), Vec3(1.0), cells, 0,
                                  {{ceiling, 0, 0, {Vec2(.2), 1}},
                                   {ceiling, 2, 2, {Vec2(.2), 2}},
                                   {left, 1, 2, {Vec2(.2), 3}}});
    DenseSystem system(scene);
    ExchangeTable table;
    add_convex(system, room, table);
    return solved(std::move(scene), system, 1e-6, {room.patches.indices()});
}

} // namespace

Entries sealed_rooms() {
    Entries entries;
    for (const double faint : {1e-2, 1e-4, 1e-6, 1e-12}) {
        std::ostringstream name;
        name << "two rooms, 1 and " << faint;
        entries.push_back({"sealed", name.str(), [=] { return rooms_with_lamps({1, faint}, .5); }});
    }
    entries.push_back({"sealed", "two bright rooms, 1 and 1e-06", [] {
                           return rooms_with_lamps({1, 1e-6}, .9);
                       }});
    entries.push_back({"sealed", "five rooms, 1 to 1e-12", [] {
                           return rooms_with_lamps({1e-6, 1, 1e-12, 1e-3, 1e-9}, .5);
                       }});
    return entries;
}

Entries channels() {
    return {
        {"channel", "1, 1, 1",
         [] {
             return coloured_lamps({1, 1, 1}, .5);
         }},
        {"channel", "1, 1e-4, 0",
         [] {
             return coloured_lamps({1, 1e-4, 0}, .5);
         }},
        {"channel", "1, 1e-6, 1e-4",
         [] {
             return coloured_lamps({1, 1e-6, 1e-4}, .5);
         }},
        {"channel", "1e-6, 1, 1e-12, bright",
         [] {
             return coloured_lamps({1e-6, 1, 1e-12}, .9);
         }},
    };
}

} // namespace hemilux::test
