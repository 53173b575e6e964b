#pragma once
// Ambient occlusion: the share of the hemisphere above each texel of a lightmap that nothing
// blocks, weighted by the cosine. It is 1 minus the view factor from the texel's point to all
// surfaces, and the irradiance under a uniform sky of radiosity 1 without any reflection.
//
// Each texel has four independent batches of cosine-distributed rays (sobol.h), whose spread gives
// its variance. Texels are of the object (group) that they show, and each object is given more rays
// until an upper bound of its own error is below the one asked for.

#include "radiosity/answers/lightmaps/lightmap_gather.h"
#include "radiosity/answers/lightmaps/texel_map.h"

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

namespace hemilux {

class Tracer;
class Workers;

struct OcclusionOptions {
    double distance = std::numeric_limits<double>::infinity(); ///< local; nothing beyond it blocks
    double error = .01; ///< at which an object has rays enough, as a share of the whole hemisphere
    std::uint64_t seed = 1;
    std::uint64_t max_rays = std::numeric_limits<std::uint64_t>::max(); ///< after which none begins
    /// Both are called by several threads. The first may throw, before all texels have their first
    /// rays; the second says that no texel is to have more than those.
    std::function<void()> check = [] {};
    std::function<bool()> is_over = [] { return false; };
};

/// The root mean square error of the texels of an object, as a share of the whole hemisphere [-].
struct ObjectError {
    std::uint32_t group;
    std::size_t texels; ///< those gathered whose middles lie on it
    unsigned rays;      ///< most at any of them
    double error;
    double bound; ///< the error is below it in 19 of 20 runs
};

struct Occlusion {
    GatheredLightmap lightmap;        ///< shares from 0 to 1, the same in all channels
    std::vector<ObjectError> objects; ///< by group, those with texels
    std::uint64_t rays = 0;
    /// Returns the error of all objects together, by their texels.
    [[nodiscard]] ObjectError all() const;
};

/// Gathers the occlusion of the texels that are not covered.
[[nodiscard]] Occlusion gather_occlusion(const Mesh& mesh, const Tracer& tracer,
                                         const TexelMap& texels, const std::vector<bool>& covered,
                                         const OcclusionOptions& options, const Workers& workers);

} // namespace hemilux
