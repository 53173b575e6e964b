#pragma once
// What the irradiance on surfaces has beyond that of a solution on patches, found by walks and kept
// in small cells of the patches (irradiance caching: Ward, Rubinstein and Clear 1988).
//
// Each walk that lands on a patch gives a sample of the residual there: the irradiance that it
// finds less that of the patch. A patch is a square cell, which is divided in four where many walks
// land, and so on. The residual of a cell is the mean of its samples, shrunk to that of the next
// larger one by n / (n + k), where n is the number of samples. The cell of a patch shrinks to the
// share of the light that all patches near it lack that look the same way. The weights depend on
// counts alone: weights by the values would darken places where few walks find much light.

#include "geometry/vector.h"
#include "radiosity/light/cached_light/patch_light.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace hemilux {

class Mesh;

class IrradianceCells {
  public:
    /// `light` is what patches send. The mesh must outlive this object, and keep its patches.
    IrradianceCells(const Mesh& mesh, const PatchLight& light);

    /// A residual where a walk landed.
    struct Sample {
        std::uint32_t patch;
        Vec3 point;    ///< local frame
        Vec3 residual; ///< [W/m2 arriving]
    };
    /// Adds samples. They count once update() was called.
    void add(std::span<const Sample> samples);
    /// Finds the residuals of all cells from all samples so far.
    void update();

    /// What is known at a place: the residual [W/m2 arriving], and the side of the square for which
    /// it is the mean (local units); that of a patch is the root of its area.
    struct Known {
        Vec3 residual{0.0};
        double side;
    };
    /// Returns what is known at a point (local frame) of a patch: 0 for the whole patch where few
    /// walks have landed on it.
    [[nodiscard]] Known at(std::uint32_t patch, const Vec3& point) const;

    [[nodiscard]] std::size_t bytes() const;

  private:
    struct Cell {
        Vec3 sum{0.0};           ///< of residuals
        Vec3 residual{0.0};      ///< as it is read
        std::uint32_t count = 0; ///< samples
        std::uint32_t parts;     ///< first of four cells, or none
    };
    /// Where a point lies in the square of its patch: both from 0 to 1.
    [[nodiscard]] Vec2 place_of(std::uint32_t patch, const Vec3& point) const;
    void update_parts(const Cell& larger);

    /// What patches lack that lie near each other and look the same way.
    struct Region {
        Vec3 residual{0.0}, irradiance{0.0}; ///< sums over samples
        double count = 0;
        [[nodiscard]] Vec3 share() const;
    };
    [[nodiscard]] std::uint32_t region_of(std::uint32_t patch) const;

    const Mesh& mesh_;
    std::vector<Vec3> irradiance_;        ///< by patch [W/m2]
    std::vector<std::uint32_t> of_patch_; ///< cells, or none
    std::vector<Cell> cells_;
    std::vector<Region> regions_; ///< by place and direction
    double samples_ = 0;
    double prior_ = 0; ///< number of samples for half of the weight, of parts of patches
};

} // namespace hemilux
