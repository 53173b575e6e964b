#pragma once
// Preprocessing of the paper (section 5a): it counts how many surfaces a patch has in each
// direction, and keeps the counts in bytes.
//
// The counts at the vertices determine the mean of every triangle, and whether a triangle is
// divided follows from its mean and the threshold. So a patch keeps one byte per vertex of the
// triangles that exist, and no flags. That is 5 bytes if nothing is divided, and 41 at most at
// depth 2, where the paper's one byte per triangle would be 84 (docs/paper/decisions.md, D8).

#include "bvh/tracer.h"
#include "radiosity/paper/hemisphere/hemisphere.h"
#include "radiosity/paper/scene/needs.h"

#include <cstdint>
#include <vector>

namespace hemilux {

class Mesh;
class Workers;
struct Monitor;

/// The vertices that are counted and kept: those of triangles that exist, or those of a full tree.
enum class DensityStore { divided_only, everything };

/// A triangle that is not divided, with the mean of its three vertex counts [surfaces per ray].
struct DensityLeaf {
    std::uint16_t cell; ///< index of Hemisphere::cells()
    double density;
};

/// Returns whether a triangle with this mean count [surfaces per ray] is divided, above the last
/// level. This is the rule of the paper's procedure Preprocessing.
[[nodiscard]] constexpr bool is_divided(double mean, double threshold) { return mean > threshold; }

/// The result of a density ray.
struct DensityCount {
    std::uint16_t vertex;  ///< index of Hemisphere::vertices()
    std::uint8_t surfaces; ///< 255: or more
};

/// This is what a strategy needs to know of the densities of patches, however they were found.
class LeafDensities {
  public:
    virtual ~LeafDensities() = default;
    /// Lists the triangles of a patch that are not divided, in the table's depth-first order.
    virtual void leaves(std::uint32_t patch, std::vector<DensityLeaf>& result) const = 0;
    /// Returns the memory of what is kept [bytes].
    [[nodiscard]] virtual std::uint64_t bytes() const = 0;
    /// Returns the number of rays traced to find the densities.
    [[nodiscard]] virtual std::uint64_t rays() const { return 0; }
    /// Returns how many more rays there would be if all triangles were divided.
    [[nodiscard]] virtual std::uint64_t rays_spared() const { return 0; }
};

class DensityMap final : public LeafDensities {
  public:
    /// Shoots the density rays from every patch centre. A triangle whose mean exceeds the threshold
    /// is divided, down to the hemisphere's depth. Counts saturate at 255. Patches that never hold
    /// power have no hemisphere: they must not be asked for.
    DensityMap(const Mesh& mesh, const Tracer& tracer, const Hemisphere& hemisphere,
               double threshold, const Workers& workers, Monitor& monitor,
               const Needs& needs = everything_needed,
               DensityStore kept = DensityStore::divided_only);

    void leaves(std::uint32_t patch, std::vector<DensityLeaf>& result) const override;
    /// Lists the data stored of a patch: the counts at the vertices of all triangles that exist.
    void counts(std::uint32_t patch, std::vector<DensityCount>& result) const;

    [[nodiscard]] std::uint64_t rays() const override { return rays_; }
    [[nodiscard]] std::uint64_t rays_spared() const override { return rays_spared_; }
    /// Returns the memory of all that is kept [bytes]: counts, and the index to find them.
    [[nodiscard]] std::uint64_t bytes() const override {
        return counts_.size() + block_start_.size() * sizeof(block_start_[0]);
    }

  private:
    /// Patches have different lengths. Only the start of each block is kept, and within a block the
    /// trees are walked to find the next.
    static constexpr std::size_t block_size = 8;

    /// The counts of the patches of one block and how many each patch has.
    struct Block {
        std::vector<std::uint8_t> counts;
        std::vector<std::uint16_t> lengths;
    };
    using Blocks = std::vector<Block>;

    void store(const Blocks& blocks, std::size_t patches);
    /// Walks a patch's tree through its bytes: count_read(vertex, count), leaf(cell, mean).
    template <class CountRead, class Leaf>
    const std::uint8_t* walk(const std::uint8_t* bytes, CountRead&& count_read, Leaf&& leaf) const;
    [[nodiscard]] const std::uint8_t* counts_of(std::uint32_t patch) const;

    const Hemisphere& hemisphere_;
    double threshold_;
    const Needs& needs_;
    DensityStore kept_;
    std::vector<std::uint8_t> counts_;
    std::vector<std::uint64_t> block_start_; ///< empty where stride_ is used
    std::size_t stride_ = 0;                 ///< bytes of each patch; 0 where the index is used
    std::uint64_t rays_ = 0, rays_spared_ = 0;
};

} // namespace hemilux
