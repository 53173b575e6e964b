#pragma once
// Draws points on the surfaces of a scene, where light is to be known.

#include "radiosity/engine/rays/surface_point.h"

#include <cstdint>
#include <initializer_list>
#include <span>
#include <vector>

namespace hemilux {

class Mesh;

/// A point of a patch, which stands for `area` of it.
struct PatchPoint {
    SurfacePoint at;
    std::uint32_t patch;
    double area; ///< local units
};

/// Draws points over the area of the patches that reflect.
class PointsOverSurface {
  public:
    /// The density is uniform, or relative to that, by patch; where it is 0 no point is drawn.
    explicit PointsOverSurface(const Mesh& mesh, std::span<const double> density = {});

    /// Draws points, each of which stands for as much as it is drawn from. The sampling is
    /// systematic (Madow and Madow 1944): what is drawn from is laid end to end in the order of the
    /// patches, and a comb with one random offset picks the patches. The result is empty if nothing
    /// reflects.
    [[nodiscard]] std::vector<PatchPoint> draw(std::size_t count, std::uint64_t seed) const;

  private:
    const Mesh& mesh_;
    std::vector<double> density_;
    std::vector<double> ends_; ///< by patch, the sum up to it
};

/// Returns by patch its area times its reflected radiosity squared: what errors are relative to,
/// and what holds most of the noise of gathers.
[[nodiscard]] std::vector<double> reflected_squares(const Mesh& mesh,
                                                    std::span<const Vec3> radiosity);

/// Returns a density for these points. Equally many lie over the area, on each patch, as patches
/// are small where light changes, and in proportion to each of some quantities, by patch, that are
/// not empty. All of it is times `weight`, by patch, or 1 if that is empty.
[[nodiscard]] std::vector<double>
mixed_density(const Mesh& mesh, std::span<const double> weight,
              std::initializer_list<std::span<const double>> quantities);

/// Returns `rows` x `rows` points of each of some patches, if it reflects, 3 x 3 to `max_rows`
/// squared. They follow each other, each uniform over an equal piece of the patch. There are more
/// where the patch is large beside the mean of all.
[[nodiscard]] std::vector<PatchPoint> points_on_patches(const Mesh& mesh,
                                                        std::span<const std::uint32_t> some,
                                                        unsigned max_rows, std::uint64_t seed);

} // namespace hemilux
