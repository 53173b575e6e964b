#pragma once
// Points on the surfaces of a scene, where light is to be known.

#include "geometry/vector.h"

#include <cstdint>
#include <span>
#include <vector>

namespace hemilux {

class Mesh;

/// In the local frame.
struct SurfacePoint {
    Vec3 position;
    Vec3 normal;         ///< unit, to the side that receives
    std::uint32_t facet; ///< that it lies on, or none
};

/// A point of a patch, which stands for `area` of it.
struct PatchPoint {
    SurfacePoint at;
    std::uint32_t patch;
    double area;
};

/// `count` points, uniform over the area of the patches that reflect: each stands for as much of
/// it. They are drawn systematically: the areas are laid end to end in the order of the patches,
/// and a comb with one random offset picks the patches (Madow and Madow 1944). Empty where nothing
/// reflects.
[[nodiscard]] std::vector<PatchPoint> points_over_surface(const Mesh& mesh, std::size_t count,
                                                          std::uint64_t seed);

/// Of each of some patches, if it reflects, `rows` x `rows` points, 3 x 3 to `most_rows` squared,
/// one after the other, each uniform over an equal piece of it: more where the patch is large
/// beside the mean of all.
[[nodiscard]] std::vector<PatchPoint> points_on_patches(const Mesh& mesh,
                                                        std::span<const std::uint32_t> some,
                                                        unsigned most_rows, std::uint64_t seed);

} // namespace hemilux
