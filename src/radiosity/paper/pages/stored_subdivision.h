#pragma once
// One divided hemisphere of the technique of 1997 (paper section 4): the directions that were
// counted are stored, and triangles of later levels are estimated from them (edge_division.h).
//
// Triangles share directions as in the regular subdivision, whose vertices are numbered in the
// order in which its triangles need them.

#include "radiosity/paper/hemisphere/density_direction.h"
#include "radiosity/paper/hemisphere/edge_division.h"
#include "radiosity/paper/hemisphere/hemisphere.h"

#include <array>
#include <cstdint>
#include <vector>

namespace hemilux::plain {

class StoredSubdivision {
  public:
    /// Finds the directions that a level adds, where level 0 adds those of the octants. Stores them
    /// with what `count` returns: the surfaces along a direction, in the patch's frame.
    template <class Count>
    void divide_to(int level, const Hemisphere& tree, const Count& count) {
        const auto store = [&](const Vec3& v) {
            stored_.push_back({{float(v.x), float(v.y), float(v.z)}, count(v)});
        };
        for (std::size_t v = 0; level == 0 && v < Hemisphere(0).vertices().size(); ++v)
            store(tree.vertices()[v]);
        for (const Hemisphere::Cell& tr : tree.cells())
            for (std::size_t edge = 0; tr.level == level - 1 && edge < 3; ++edge)
                if (tr.midpoint[edge] == stored_.size()) {
                    const auto a = at(tr.vertex[edge]), b = at(tr.vertex[(edge + 1) % 3]);
                    store(estimated_point(a, b).direction);
                }
    }

    /// Returns triangle `index` of a level: a stored one, or one of the four that its parent is
    /// divided into.
    [[nodiscard]] CountedTriangle triangle(int level, std::size_t index,
                                           const Hemisphere& tree) const {
        if (level > tree.depth())
            return estimated_child(triangle(level - 1, index / 4, tree), index % 4);
        const auto& v = tree.cells()[Hemisphere::cells_up_to(level - 1) + index].vertex;
        return {at(v[0]), at(v[1]), at(v[2])};
    }

    [[nodiscard]] std::size_t bytes() const { return stored_.size() * sizeof(stored_[0]); }

  private:
    [[nodiscard]] CountedDirection at(std::size_t k) const {
        const auto& [x, y, z] = stored_[k].to;
        return {glm::normalize(Vec3(x, y, z)), double(stored_[k].ns)};
    }

    /// A direction that is rounded by being stored: in one expression g++ 12.2 -O2 leaves out the
    /// rounding to floats.
    struct Stored {
        std::array<float, 3> to;
        std::uint8_t ns;
    };
    std::vector<Stored> stored_; ///< directions, by vertex of the tree
};

/// Returns the corners of a triangle that were counted with its own level: a child at a corner of
/// its parent has two of them, the middle one three.
[[nodiscard]] inline std::vector<Vec3> counted_directions(const CountedTriangle& abc, int level,
                                                          std::size_t index) {
    std::vector<Vec3> directions;
    for (std::size_t corner = 0; corner < 3; ++corner)
        if (level == 1 || index % 4 != corner)
            directions.push_back(density_direction(abc[corner].direction));
    return directions;
}

} // namespace hemilux::plain
