#pragma once
// Random directions into cells of the hemisphere, cosine distributed within each, and points to
// start from, drawn many at once. Each sample has random numbers of its own, found by the key of
// its stream and its number there. So no sample depends on which others are drawn with it.

#include "radiosity/engine/sampling/sampling_kernels.h"
#include "radiosity/paper/hemisphere/hemisphere.h"

#include <array>
#include <cstdint>
#include <numbers>
#include <span>
#include <vector>

namespace hemilux {

inline constexpr std::uint16_t whole_hemisphere = 0xffff;

/// The meaning of A in A_tr / A_hemi of the paper.
enum class CellArea {
    projected_solid_angle, ///< this keeps Lambert's law
    solid_angle            ///< the print's; biased (docs/paper/decisions.md, D1)
};

/// Returns A_tr / A_hemi of the paper [-]: the share of a diffuse patch's power that a cell of the
/// table gets.
[[nodiscard]] inline double power_share(const Hemisphere& hemisphere, std::uint16_t cell,
                                        CellArea area) {
    if (cell == whole_hemisphere)
        return 1;
    const Hemisphere::Cell& its = hemisphere.cells()[cell];
    return area == CellArea::solid_angle ? its.solid_angle / (2 * std::numbers::pi)
                                         : its.projected_solid_angle / std::numbers::pi;
}

/// The samples that are drawn together, as many as the nearer caches hold. Each has one place in
/// every array.
struct DirectionBatch {
    static constexpr std::size_t room = 512;
    std::size_t size = 0;

    std::array<std::uint32_t, room> key_low, key_high, number;
    std::array<std::uint16_t, room> cell; ///< index of Hemisphere::cells(), or whole_hemisphere
    // These are drawn.
    alignas(64) std::array<double, room> u, v;    ///< uniform in (0,1): where to start
    alignas(64) std::array<double, room> x, y, z; ///< unit, z along the normal

    [[nodiscard]] bool full() const { return size == room; }
    void add(std::uint64_t key_, std::uint32_t number_, std::uint16_t cell_) {
        key_low[size] = static_cast<std::uint32_t>(key_);
        key_high[size] = static_cast<std::uint32_t>(key_ >> 32);
        number[size] = number_;
        cell[size++] = cell_;
    }
};

class CellDirections {
  public:
    /// `area` defines the shares of power.
    CellDirections(const Hemisphere& hemisphere, CellArea area);
    CellDirections(const CellDirections&) = delete;
    CellDirections& operator=(const CellDirections&) = delete;

    /// Returns the share of power of a cell of the constructor's hemisphere, by its area [-].
    [[nodiscard]] double power_share(std::uint16_t cell) const {
        return cell == whole_hemisphere ? 1 : power_shares_[cell];
    }

    /// Draws all samples of the batch: fills in u, v, x, y and z.
    void draw(DirectionBatch& batch) const;

  private:
    void add(const SphericalTriangle& triangle);
    void try_again(DirectionBatch& batch, std::span<std::uint32_t> missed) const;

    std::array<std::vector<double>, CellShapes::parts> parts_; ///< see there
    CellShapes shapes_{};
    std::vector<double> power_shares_;
};

} // namespace hemilux
