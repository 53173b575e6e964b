#pragma once
// The pyramidal hemisphere subdivision (Jolivet, Plemenos and Sbert, WSCG 2000, of which the
// abstract is public). It counts the patches in the pyramid over each triangle of a patch's
// hemisphere. The apex of the pyramids is the centre of the patch.
//
// Three rays along the edges of a pyramid, as the paper's density has them, may all miss what
// stands between them. A pyramid misses nothing. A patch counts in it if some of it lies within the
// three planes, whether it is hidden or not, and whichever side it shows. The abstract does not say
// how the rays per triangle depend on that number (docs/paper/decisions.md, D60).
//
// Patches are found from a tree of boxes. A box beyond one of the planes is left out, one within
// all three counts as a whole, and a single patch is clipped. What a triangle's pyramid holds is
// passed on to its four children.

#include "geometry/polygon.h"
#include "radiosity/engine/densities/density.h"
#include "radiosity/research/guiding/patch_boxes.h"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace hemilux {

class Mesh;
class Workers;
struct Monitor;

/// All points p with dot(normal, p - apex) > min_distance for each of three unit normals.
struct Pyramid {
    /// Neighbours in the plane of the apex's patch, and others that only touch the pyramid, are not
    /// in it [local units: the scene lies within [-1,1]^3].
    static constexpr double min_distance = 1e-9;

    Vec3 apex; ///< local units
    std::array<Vec3, 3> normal;

    enum class Place { outside, across, inside };
    /// Returns where a box lies; `across` may also be returned for a box that is outside.
    [[nodiscard]] Place place_of(const Box& box) const;
    /// Returns a point of a convex polygon that lies in the pyramid, if there is one; this is exact
    /// except for rounding.
    [[nodiscard]] std::optional<Vec3> point_of(const Polygon& polygon) const;
};

/// The numbers of patches in the pyramids of all triangles that exist.
class PyramidMap final : public LeafDensities {
  public:
    /// A triangle whose pyramid holds more patches than `threshold` is divided, down to the
    /// hemisphere's depth. Patches that never hold power have no hemisphere: they must not be asked
    /// for.
    PyramidMap(const Mesh& mesh, const Hemisphere& hemisphere, double threshold,
               const Workers& workers, Monitor& monitor, const Needs& needs = everything_needed);

    /// The density of a leaf is the root of the number of patches in its pyramid, for the solid
    /// angle of a mean triangle of the last level. K patches that fill the pyramid have areas of 1
    /// / K. So a ray that hits one of them adds K times the variance (visibility_guide.h), and the
    /// best number of rays goes with the root of that.
    void leaves(std::uint32_t patch, std::vector<DensityLeaf>& result) const override;
    /// Returns how many patches lie in the pyramid of a triangle that exists, within 4.5 %.
    [[nodiscard]] double patches_in(std::uint32_t patch, std::size_t cell) const;
    /// Returns one byte for each triangle, as in section 6 of the paper.
    [[nodiscard]] std::uint64_t bytes() const override { return counts_.size(); }

  private:
    class Count;
    void add_leaves(std::uint32_t patch, std::size_t cell, std::vector<DensityLeaf>& result) const;

    const Hemisphere& hemisphere_;
    double threshold_;
    std::vector<std::uint8_t> counts_; ///< counts by patch and cell (log_byte.h)
};

} // namespace hemilux
