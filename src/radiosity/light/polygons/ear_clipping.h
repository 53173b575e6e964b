#pragma once
// This cuts a simple polygon of the plane into triangles by clipping ears (Meisters 1975, "Polygons
// have ears"). An ear is a convex corner whose triangle with its neighbours holds no other corner.
//
// When an ear is cut, only its two neighbours can change, and a tree finds corners in a triangle.
// So n corners take O(n log n) time, except where triangles are long and thin. A cut corner's
// neighbours go to the end of the queue. Cutting every other corner in turn gives compact
// triangles, where cutting in order would give a fan of slivers.

#include "geometry/vector.h"
#include "radiosity/light/polygons/corner_tree.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace hemilux {

class EarClipper {
  public:
    using Triangle = std::array<std::uint32_t, 3>; ///< indices of corners, counter-clockwise

    /// Returns the triangles of a polygon that is counter-clockwise on the whole; they are valid
    /// until the next call. Corners are within [-1,1]^2 and may be wrong by `rounding`. Straight
    /// corners become corners of triangles too, wherever possible. Their signed areas sum to the
    /// polygon's. Visits are taken from `work`. When it is 0, the search for ears ends, and
    /// triangles may overlap.
    [[nodiscard]] std::span<const Triangle> clip(std::span<const Vec2> corners, double rounding,
                                                 std::uint64_t& work);
    /// Returns whether the last polygon ran out of ears, as one that crosses itself does; its
    /// triangles then overlap.
    [[nodiscard]] bool ran_out_of_ears() const { return ran_out_; }

  private:
    enum class Turn : std::uint8_t { left, straight, right, back };
    struct Node {
        std::uint32_t previous, next;
        std::uint32_t version = 0; ///< version of its triangle; the queue may hold void ones
        Turn turn = Turn::straight;
        bool cut = false;
    };
    struct Candidate {
        std::uint32_t corner, version;
    };

    void start(std::span<const Vec2> corners, double rounding);
    void find_turn(std::uint32_t i);
    [[nodiscard]] bool has_corner_inside(std::uint32_t i);
    void enqueue_if_ear(std::uint32_t i);
    void emit(std::uint32_t i);
    void remove(std::uint32_t i);
    std::array<std::uint32_t, 2> unlink(std::uint32_t i);
    void force_one();
    [[nodiscard]] std::optional<std::uint32_t> find(Turn turn);
    [[nodiscard]] bool is_at(std::uint32_t i, Turn turn) const {
        return !node_[i].cut && node_[i].turn == turn;
    }

    std::span<const Vec2> corner_;
    double rounding_ = 0;
    std::vector<Node> node_;
    CornerTree blockers_; ///< corners that are not convex
    /// Corners found to be straight, or convex: where no ear is left, one that still is so is cut.
    std::vector<std::uint32_t> straight_, left_turns_;
    std::uint64_t* work_ = nullptr;
    std::vector<Candidate> queue_;
    std::vector<Triangle> triangles_;
    std::uint32_t some_ = 0; ///< a corner that is not cut
    std::size_t left_ = 0;
    bool ran_out_ = false;
};

} // namespace hemilux
