#pragma once
// Describes what a run is for, as weights of patches: a solution that is to be right on some
// patches need not be right on all.
//
// The error that is asked for is sqrt(sum_i w_i A_i |B_i - B*_i|^2 / sum_i w_i A_i |B*_i - E_i|^2).
// Where all weights are alike it is the usual one (true_error). The method has to find out what
// else the light of the target depends on (stored_transport/importance.h).

#include "bvh/tracer.h"
#include "radiosity/engine/rays/surface_point.h"

#include <cstdint>
#include <span>
#include <vector>

namespace hemilux {

class Mesh;
class Workers;

/// Returns 1 for the patches of these groups of the scene (Facet::group), else 0.
[[nodiscard]] std::vector<double> weights_of_groups(const Mesh& mesh,
                                                    std::span<const std::uint32_t> groups);

/// Returns the weights for a picture that shows these points of patches, one for each pixel. Each
/// point counts at the patch that it lies on. It also counts at those that `rays`
/// cosine-distributed rays from it meet, by the square of its reflectance, as a gathered picture
/// reads them. (Smits, Arvo and Salesin 1992 start importance at what the eye sees; the second part
/// is theirs after one step of transport.) The weights take the square, as they are those of
/// squared errors. The light gathered at a point is off by rho sum_k F_k e_k, whose square is at
/// most rho^2 sum_k F_k e_k^2 (Jensen). A patch has what it gets over its area; the largest weight
/// is 1. The result is the same for any number of threads.
[[nodiscard]] std::vector<double> weights_of_points(const Mesh& mesh, const Tracer& tracer,
                                                    std::span<const SurfacePoint> points,
                                                    unsigned rays, const Workers& workers);

/// Returns a hash that is nearly surely another one for other weights: a saved state belongs to its
/// target.
[[nodiscard]] std::uint64_t hash_of_weights(std::span<const double> weights);

/// Adds weights of another part of the target: a patch gets the larger one. One of both may be
/// empty.
void add_weights(std::vector<double>& weights, std::span<const double> others);

} // namespace hemilux
