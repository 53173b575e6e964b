#include "radiosity/engine/factors/points/seen_part.h"

#include <algorithm>
#include <array>

namespace hemilux {
namespace {

/// Corners so near a plane, in the lengths of the vectors, lie in it.
constexpr double in_plane = 1e-12;

struct Depths {
    std::array<double, std::tuple_size_v<decltype(ConvexPart::corner)>> of;
    bool any_inside = false, any_outside = false;
};

Depths depths_of(const ConvexPart& piece, const Vec3& inwards) {
    Depths depths;
    for (std::size_t k = 0; k < piece.size; ++k) {
        const double depth = glm::dot(inwards, piece.corner[k]);
        const bool is_in_plane = std::abs(depth) <= in_plane * glm::length(piece.corner[k]);
        depths.of[k] = is_in_plane ? 0 : depth;
        depths.any_inside |= depths.of[k] > 0;
        depths.any_outside |= depths.of[k] < 0;
    }
    return depths;
}

/// Keeps what has depths of a sign (Sutherland and Hodgman 1974).
ConvexPart kept(const ConvexPart& piece, const Depths& depths, double sign) {
    ConvexPart part;
    for (std::size_t k = 0; k < piece.size; ++k) {
        const std::size_t next = k + 1 < piece.size ? k + 1 : 0;
        const double here = sign * depths.of[k], there = sign * depths.of[next];
        if (here >= 0)
            part.add(piece.corner[k]);
        if ((here < 0 && there > 0) || (here > 0 && there < 0))
            part.add(glm::mix(piece.corner[k], piece.corner[next], here / (here - there)));
    }
    return part;
}

} // namespace

ConvexPart cut_by_plane(const ConvexPart& piece, const Vec3& inwards) {
    const Depths depths = depths_of(piece, inwards);
    if (!depths.any_inside)
        return {};
    return depths.any_outside ? kept(piece, depths, 1) : piece;
}

void SeenPart::begin(const ConvexPart& whole) {
    pieces_.clear();
    if (whole.size >= 3)
        pieces_.push_back(whole);
}

/// Whatever rounding does to the planes, the pieces outside of one and what is inside of all of
/// them make up the piece that was there.
bool SeenPart::hide(const ConvexPart& cover) {
    Vec3 middle(0.0), around(0.0);
    double reach = 0;
    for (std::size_t k = 0; k < cover.size; ++k) {
        middle += cover.corner[k];
        around += glm::cross(cover.corner[k], cover.next(k));
        reach = std::max(reach, glm::length(cover.corner[k]));
    }
    const double turn = glm::dot(around, middle);
    if (!(std::abs(turn) > in_plane * reach * reach * reach))
        return true; // seen edge-on
    sides_.clear();
    for (std::size_t k = 0; k < cover.size; ++k) {
        const Vec3 normal = glm::cross(cover.corner[k], cover.next(k) - cover.corner[k]);
        const double length = glm::length(normal);
        if (length > 0)
            sides_.push_back(normal / (turn > 0 ? length : -length));
    }
    next_.clear();
    for (const ConvexPart& piece : pieces_) {
        const bool is_apart = std::ranges::any_of(sides_, [&piece](const Vec3& inwards) {
            return !depths_of(piece, inwards).any_inside;
        });
        if (is_apart) {
            next_.push_back(piece);
            continue;
        }
        ConvexPart left = piece;
        for (const Vec3& inwards : sides_) {
            const Depths depths = depths_of(left, inwards);
            if (depths.any_outside)
                next_.push_back(kept(left, depths, -1));
            left = depths.any_inside ? kept(left, depths, 1) : ConvexPart{};
            if (left.empty())
                break;
        }
    }
    pieces_.swap(next_);
    return pieces_.size() <= max_pieces &&
           std::ranges::all_of(
               pieces_, [](const ConvexPart& piece) { return piece.size < piece.corner.size(); });
}

} // namespace hemilux
