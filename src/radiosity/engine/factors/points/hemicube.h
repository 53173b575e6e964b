#pragma once
// Computes form factors by hemicubes (Cohen and Greenberg 1985, "The hemi-cube: a radiosity
// solution for complex environments").
//
// Half a cube stands over the centre of a patch. Each pixel of its faces shows the nearest patch
// along the ray through the pixel's centre: the item buffer. A pixel covers a known share of the
// hemisphere's projected solid angle, its delta factor. F_ij is the sum of the delta factors of the
// pixels that show j.
//
// There are two errors, neither of them random. A pixel belongs to one patch as a whole: what is
// smaller than a pixel is missed or counts too much (aliasing); more pixels make that less. And the
// centre stands for the whole patch, whatever the pixels: a factor between patches that are near to
// each other is off by that. Rows sum to 1 less what is lost, but A_i F_ij = A_j F_ji does not
// hold.
//
// The cube is turned about the normal by the patch's own angle (Mesh::hemisphere_frame). So its
// pixels do not run along the edges of a regular mesh. Nothing depends on a random number.

#include "bvh/tracer.h"
#include "radiosity/engine/factors/rows/escape_fraction.h"
#include "radiosity/engine/sparse/sparse_matrix.h"

#include <cstdint>
#include <vector>

namespace hemilux {

class Mesh;
class StopFlag;
struct Monitor;

class Hemicube {
  public:
    static constexpr std::uint32_t min_edge = 2, max_edge = 1024;
    /// Returns whether a number of pixels is even and from min_edge to max_edge.
    [[nodiscard]] static bool is_edge(std::uint64_t pixels) {
        return pixels >= min_edge && pixels <= max_edge && pixels % 2 == 0;
    }

    /// Makes a hemicube with `edge` pixels along an edge of the top face. Four half sides have edge
    /// x edge / 2 pixels each. Throws std::invalid_argument unless is_edge().
    explicit Hemicube(std::uint32_t edge);

    /// Returns 3 edge^2. The pixels of the top face come first, row by row, then those of the
    /// sides, from below to above.
    [[nodiscard]] std::size_t pixels() const { return std::size_t{3} * edge_ * edge_; }
    /// Returns the form factor from the cube's centre to the pixel [-], in closed form; all sum to
    /// 1.
    [[nodiscard]] double delta_factor(std::size_t pixel) const;
    /// Returns the direction to the centre of the pixel, in the frame of the patch, where z is its
    /// normal. It does not have unit length: the largest component is 1.
    [[nodiscard]] Vec3 direction(std::size_t pixel) const;

  private:
    /// The place of a pixel on its face; rows of sides are counted from the foot.
    struct Place {
        std::size_t face, row, column;
    };
    static constexpr std::size_t top = 4; ///< the face after the sides 0 to 3
    [[nodiscard]] Place place_of(std::size_t pixel) const;
    /// Returns how many rows or columns lie between this one and the middle.
    [[nodiscard]] std::size_t from_middle(std::size_t k) const {
        const std::size_t half = edge_ / 2;
        return k < half ? half - 1 - k : k - half;
    }

    std::uint32_t edge_;
    /// The delta factors [-] of a quarter of the top and of half a side, edge / 2 a row; the rest
    /// is symmetric.
    std::vector<double> top_, side_;
};

/// The patches that the hemicube of a patch shows.
struct HemicubeRow {
    struct Entry {
        std::uint32_t patch, pixels;
        double factor; ///< F_ij [-]
    };
    std::vector<Entry> entries; ///< ascending by patch
    EscapeFraction lost;        ///< sum of lost delta factors
};

/// Returns the row of a patch. The workers share the rays; one of them adds up. The row is void if
/// interrupted.
[[nodiscard]] HemicubeRow hemicube_row(const Hemicube& cube, const Mesh& mesh, const Tracer& tracer,
                                       std::uint32_t patch, const Workers& workers,
                                       const StopFlag& interrupted);

/// The rows of all patches.
struct HemicubeFormFactors {
    SparseMatrix matrix;
    std::vector<EscapeFraction> lost; ///< lost shares by patch
    std::uint64_t rays;
};

/// Computes the rows of all patches and adds to the rays of the monitor; void if it was
/// interrupted.
[[nodiscard]] HemicubeFormFactors hemicube_form_factors(const Hemicube& cube, const Mesh& mesh,
                                                        const Tracer& tracer,
                                                        const Workers& workers, Monitor& monitor);

} // namespace hemilux
