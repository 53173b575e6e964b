#pragma once
// The light itself at points of the surfaces, against which solutions on patches are measured.
//
// One accurate solution is gathered twice, independently, at points of the surfaces: g1(x), g2(x).
// For any other solution B on the same patches, the mean over the area of (g1 - B)(g2 - B) is the
// squared error of B as a function on the surfaces. This includes its own noise, and that patches
// hold one value each. The noise of the independent gathers adds nothing on average. What the
// accurate solution lacks in detail has been reflected once before it is gathered, and is not seen
// (division_error.h).

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
    /// `accurate` is the radiosity by patch [W/m2]. If it was interrupted, nothing is known.
    KnownLight(const Mesh& mesh, const Tracer& tracer, std::span<const Vec3> accurate,
               std::size_t points, std::uint64_t seed, const Workers& workers,
               const StopFlag& interrupted);

    /// Returns the RMS over area and channels of the error of `radiosity` (by patch, W/m2),
    /// relative to the reflected light. It is NaN if the light is not known, or the error is too
    /// small to be measured.
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
