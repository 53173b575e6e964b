#pragma once
// The hemispheres of the technique of 1997 (paper section 4; Jolivet and Plemenos, GraphiCon 1997).
//
// A patch is cut, in thought, into parts with a hemisphere over the centre of each. Level by level,
// all triangles are divided into four at new directions on their edges. These lie nearer to the end
// where more surfaces were counted (edge_division.h). Triangles share directions as in the regular
// subdivision (hemisphere.h); only the directions differ, so they are stored, in 13 bytes each.

#include "bvh/tracer.h"
#include "radiosity/paper/hemisphere/edge_division.h"
#include "radiosity/paper/hemisphere/hemisphere.h"
#include "radiosity/paper/hemisphere/subdivision_1997_options.h"
#include "radiosity/paper/solving/solver.h"

#include <array>
#include <cstdint>
#include <vector>

namespace hemilux {

class Mesh;
struct Needs;
class Workers;

class Subdivision1997 {
  public:
    /// A patch may have at most this many triangles, over all its parts.
    static constexpr std::uint64_t max_triangles = 1 << 14;
    /// Throws std::invalid_argument, with what was expected, unless the numbers of steps and parts
    /// are among the choices and give no more triangles than that.
    static void check(const Subdivision1997Options& options);
    static constexpr std::array<std::uint32_t, 6> stored_choices{0, 1, 2, 3, 4, 5};
    static constexpr std::array<std::uint32_t, 7> estimated_choices{0, 1, 2, 3, 4, 5, 6};
    static constexpr std::array<std::uint32_t, 4> part_choices{1, 4, 16, 64};

    /// Checks the options. Nothing is counted yet.
    Subdivision1997(const Mesh& mesh, const Needs& needs, const Subdivision1997Options& options);

    /// Finds the directions of all triangles up to this level, as far as they are to be stored, and
    /// counts the surfaces along them. Where the needs say that all counts are 1, and for patches
    /// that never hold power, no ray is traced: they share hemispheres in which all counts are 1.
    void find(int level, const Tracer& tracer, const Workers& workers, Monitor& monitor);

    [[nodiscard]] std::size_t parts() const { return options_.parts; }
    /// Returns the number of triangles of one part; those of level 0 are the octants.
    [[nodiscard]] static std::size_t triangles(int level) { return std::size_t{4} << (2 * level); }
    /// Returns triangle `index` of a level: a stored one, or what becomes of it by estimation.
    [[nodiscard]] CountedTriangle triangle(std::uint32_t patch, std::size_t part, int level,
                                           std::size_t index) const;
    /// Returns which of its corners were found with this level; those of level 0 count as found
    /// with level 1.
    [[nodiscard]] std::vector<std::size_t> corners_found(int level, std::size_t index) const;

    /// Returns the directions of a part that were counted, once all that are to be stored have been
    /// found.
    [[nodiscard]] std::vector<CountedDirection> counted(std::uint32_t patch,
                                                        std::size_t part) const;

    /// Returns the memory that a patch takes [bytes], for valid options.
    [[nodiscard]] static double bytes_of_patch(const Subdivision1997Options& options);
    [[nodiscard]] std::uint64_t rays() const { return rays_; }
    [[nodiscard]] std::uint64_t bytes() const {
        return direction_.size() * sizeof(direction_[0]) + count_.size();
    }

  private:
    [[nodiscard]] int stored_levels() const { return static_cast<int>(options_.stored_steps); }
    /// Returns where the directions of a part begin.
    [[nodiscard]] std::size_t place(std::uint32_t patch, std::size_t part) const {
        return place_of_hemispheres(hemispheres_of_.empty() ? patch : hemispheres_of_[patch], part);
    }
    [[nodiscard]] std::size_t place_of_hemispheres(std::size_t index, std::size_t part) const {
        return (index * parts() + part) * topology_.vertices().size();
    }
    [[nodiscard]] CountedDirection stored(std::size_t at) const;
    /// Finds the directions that a level adds to a part of hemispheres `index`, in the patch's
    /// order of vertices. Returns the number of rays that were counted.
    std::size_t find_level(int level, std::size_t index, std::size_t part, const Tracer& tracer);

    const Mesh& mesh_;
    Subdivision1997Options options_;
    Hemisphere topology_;
    int found_ = -1; ///< the last level that was
    std::uint64_t rays_ = 0;
    /// The patch of each hemispheres; `none` has those of all patches that need no counts. Both are
    /// empty where each patch has its own, in the order of patches.
    std::vector<std::uint32_t> patch_of_;
    std::vector<std::uint32_t> hemispheres_of_; ///< by patch
    // These are by hemispheres, part and vertex of the topology, in the patch's own frame.
    std::vector<std::array<float, 3>> direction_;
    std::vector<std::uint8_t> count_;
};

} // namespace hemilux
