// A chain of rooms joined by doors, light in the first: each room gets its light from the one
// before, and the last one is thousands of times darker.

#include "support/families/builders.h"
#include "support/families/families.h"

#include <array>
#include <map>
#include <string>

namespace hemilux::test {
namespace {

// A room is a unit cube of 3 x 3 cells a side, known by their places: 9 side + 3 row + column. The
// doors are the middle cells of the walls left and right.
constexpr std::uint32_t cells = 3, places = 6 * cells * cells;
constexpr std::uint32_t middle = 4, left_door = 9 * left + middle, right_door = 9 * right + middle;

/// All cells of the room that begins at x = 0.
const std::array<Polygon, places>& cells_of_room() {
    static const std::array<Polygon, places> all = [] {
        Scene scene = with_materials({grey("wall", .5, 0)});
        add_box(scene, Vec3(0.0), Vec3(1.0), cells, 0, {});
        std::array<Polygon, places> result;
        for (std::size_t place = 0; place < places; ++place)
            result.at(place) = polygon_of(scene, place);
        return result;
    }();
    return all;
}

Polygon moved(Polygon polygon, double x) {
    for (Vec3& corner : polygon.corner)
        corner.x += x;
    return polygon;
}

/// A F from a place of one room to a place of another, so many rooms further right. A line that
/// crosses the first and the last door between them crosses all others, which stand in a row.
double exchange_of_rooms(std::uint32_t from, std::uint32_t to, std::uint32_t rooms) {
    const auto& cell = cells_of_room();
    const std::array<Aperture, 2> apertures{
        {{moved(cell.at(right_door), double(rooms) - 1), Side::same},
         {cell.at(from), Side::opposite}}};
    const int points = rooms < 3 ? 8 : 4;
    return exchange_through(cell.at(right_door), moved(cell.at(to), rooms),
                            std::span(apertures).subspan(rooms > 1 ? 0 : 1), points);
}

using Block = std::vector<double>; ///< by places of both rooms
const Block& block(std::uint32_t rooms) {
    static std::map<std::uint32_t, Block> known;
    Block& b = known[rooms];
    if (b.empty())
        for (std::uint32_t from = 0; from < places; ++from)
            for (std::uint32_t to = 0; to < places; ++to)
                // Walls in the plane of a door see nothing through it.
                b.push_back(
                    from / 9 == right || to / 9 == left ? 0 : exchange_of_rooms(from, to, rooms));
    return b;
}

struct Room {
    BuiltBox box;
    std::vector<std::uint32_t> place; ///< of each patch
};

Room add_room(Scene& scene, std::uint32_t index, std::uint32_t rooms) {
    std::vector<OddCell> odd;
    Room room;
    for (std::uint32_t place = 0; place < places; ++place) {
        const bool door =
            (place == left_door && index > 0) || (place == right_door && index + 1 < rooms);
        if (door)
            odd.push_back({place / 9, 1, 1, missing_cell});
        else
            room.place.push_back(place);
    }
    if (index == 0)
        odd.push_back({ceiling, 1, 1, {Vec2(1.0), 1}});
    const Vec3 low(index, 0, 0);
    room.box = add_box(scene, low, low + Vec3(1.0), cells, 0, odd);
    return room;
}

void join(DenseSystem& system, const Room& first, const Room& second, std::uint32_t distance) {
    const Block& factors = block(distance);
    for (std::uint32_t i = 0; i < first.place.size(); ++i)
        for (std::uint32_t j = 0; j < second.place.size(); ++j)
            system.set(first.box.patches.begin + i, second.box.patches.begin + j,
                       factors[first.place[i] * places + second.place[j]]);
}

HardScene corridor(std::uint32_t count, double reflectance) {
    Scene scene = with_materials({grey("wall", reflectance, 0), grey("lamp", reflectance, 10)});
    std::vector<Room> rooms;
    for (std::uint32_t k = 0; k < count; ++k)
        rooms.push_back(add_room(scene, k, count));
    DenseSystem system(scene);
    ExchangeTable table;
    std::vector<std::vector<std::uint32_t>> parts;
    for (const Room& room : rooms) {
        add_convex(system, room.box, table);
        parts.push_back(room.box.patches.indices());
    }
    for (std::uint32_t a = 0; a < count; ++a)
        for (std::uint32_t b = a + 1; b < count; ++b)
            join(system, rooms[a], rooms[b], b - a);
    system.close_rows({0, facets_of(scene)});
    return solved(std::move(scene), system, 3e-3, std::move(parts));
}

} // namespace

Entries corridors() {
    return {{"corridor", "5 rooms", [] { return corridor(5, .5); }},
            {"corridor", "5 bright rooms", [] { return corridor(5, .9); }},
            {"corridor", "30 rooms", [] { return corridor(30, .5); }}};
}

} // namespace hemilux::test
