#include "geometry/plane_cuts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace hemilux {
namespace {

/// The distance from a line, in the polygon's units, within which a point touches it.
constexpr double rounding = 0x1p-44;

struct Sides {
    bool left = false, right = false;
};

Sides sides_of(const FlatPolygon& outline, const Line& line) {
    const double limit = rounding * (std::abs(line.along.x) + std::abs(line.along.y));
    Sides sides;
    for (std::size_t i = 0; i < outline.size; ++i) {
        const double distance = line.left_distance(outline.corner[i]);
        sides.left |= distance > limit;
        sides.right |= distance < -limit;
    }
    sides.left |= !sides.right; // in the line, or the line is none
    return sides;
}

/// Returns how many pieces of a sample are on the side that has more of them.
std::size_t larger_side(const std::vector<PlanePiece>& pieces, const Line& line) {
    constexpr std::size_t sample = 64;
    const std::size_t step = std::max<std::size_t>(pieces.size() / sample, 1);
    std::size_t left = 0, right = 0;
    for (std::size_t i = 0; i < pieces.size(); i += step) {
        const Sides sides = sides_of(pieces[i].outline, line);
        left += sides.left;
        right += sides.right;
    }
    return std::max(left, right);
}

/// Returns the line along an edge that divides best among a few edges.
Line choose_line(const std::vector<PlanePiece>& pieces) {
    constexpr int tries = 16;
    Line best;
    std::size_t least = std::numeric_limits<std::size_t>::max();
    std::mt19937_64 next_random(pieces.size());
    for (int k = 0; k < tries; ++k) {
        const std::uint64_t random = next_random();
        const FlatPolygon& outline = pieces[random % pieces.size()].outline;
        const Line line = outline.edge((random >> 32) % outline.size);
        if (const std::size_t larger = larger_side(pieces, line); larger < least) {
            least = larger;
            best = line;
        }
    }
    return best;
}

/// Returns the part of a piece left of a line. A polygon without room for the corner that a cut may
/// add stays whole.
PlanePiece part_of(const PlanePiece& piece, const Line& line) {
    const FlatPolygon& outline = piece.outline;
    return {piece.facet, outline.size < outline.corner.size() ? left_part(outline, line) : outline};
}

} // namespace

std::optional<std::array<std::vector<PlanePiece>, 2>>
cut_in_two(const std::vector<PlanePiece>& pieces) {
    constexpr double enough = .9; // of all on a side
    const Line line = choose_line(pieces);
    std::array<std::vector<PlanePiece>, 2> halves;
    for (const PlanePiece& piece : pieces) {
        const auto [left, right] = sides_of(piece.outline, line);
        if (left)
            halves[0].push_back(right ? part_of(piece, line) : piece);
        if (right)
            halves[1].push_back(left ? part_of(piece, line.reversed()) : piece);
    }
    const auto most = static_cast<std::size_t>(enough * static_cast<double>(pieces.size()));
    if (std::max(halves[0].size(), halves[1].size()) > most)
        return std::nullopt;
    return halves;
}

} // namespace hemilux
