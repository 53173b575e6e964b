#pragma once
// The light itself at points of the surfaces, to measure solutions on patches against.
//
// One accurate solution is gathered twice, independently, at points of the surfaces: g1(x), g2(x).
// Of any other solution B on the same patches, the mean over the area of (g1 - B)(g2 - B) is the
// squared error of B as a function on the surfaces: its own noise, and that patches hold one value
// each. The gathers' noise is in neither product. What the accurate solution lacks in detail has
// been reflected once before it is gathered, and is not seen (division_error.h).

#include "bvh/tracer.h"
#include "geometry/vector.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace hemilux {

class Mesh;
class StopFlag;
class Workers;

class KnownLight {
  public:
    /// `accurate`: radiosity by patch [W/m2]. Where it was interrupted nothing is known. The mesh
    /// outlives this.
    KnownLight(const Mesh& mesh, const Tracer& tracer, std::span<const Vec3> accurate,
               std::size_t points, std::uint64_t seed, const Workers& workers,
               const StopFlag& interrupted);

    /// RMS over area and channels of what `radiosity` (by patch, W/m2) is off from the light,
    /// relative to the reflected light. NaN where it is not known, or too small to be measured.
    [[nodiscard]] double error(std::span<const Vec3> radiosity) const;

  private:
    struct Point {
        std::uint32_t patch;
        double area;                 ///< that it stands for
        Vec3 reflected1, reflected2; ///< by either gather [W/m2]
    };
    const Mesh& mesh_;
    std::vector<Point> points_;
};

} // namespace hemilux
