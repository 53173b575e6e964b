#pragma once
// Computes what the light of each patch counts for a target: the adjoint of the radiosity equation,
// solved on the stored rays. It says where more rays gain most.
//
// The light that arrives solves h = d + F rho h. Importance flows the other way (Smits, Arvo and
// Salesin 1992). Since A_i F_ij is symmetric, it solves the same equation: I = w + F rho I, with
// the weights w of the target for d. Then
//
//     sum_i w_i A_i rho_i h_i = sum_k A_k rho_k I_k d_k,   sum_i w_i A_i B_i = sum_k A_k I_k E_k,
//
// so that I_k says what light at k does for the target in the end. No ray is needed for it.

#include "geometry/vector.h"
#include "parallel/workers.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace hemilux {

class ExchangeMatrix;
class Mesh;
class StateReader;
class StateWriter;
class TransportSystem;

/// Solves I = w + F rho I by channel; by patch, `weight` is w. `tolerance` is as in
/// solve_by_gradients(); where the iterations end before, the result is rougher.
[[nodiscard]] std::vector<Vec3> importance_of(const ExchangeMatrix& factors,
                                              std::span<const double> area,
                                              std::span<const Vec3> reflectance,
                                              std::span<const double> weight,
                                              const Workers& workers, double tolerance);

/// Returns what the variance of the light that rays bring to a patch counts in the error of the
/// target: m_k below. It is relative to what it counts on a target of the mean weight (that of its
/// own light).
///
/// Noise e_k of the row k moves the light at i by G_ik e_k, where G = 1 + K is the inverse of 1 - F
/// rho. It moves the squared error of the target by sum_i w_i A_i rho_i^2 G_ik^2 of e_k^2. The
/// patch's own light, G_kk = 1, counts w_k A_k rho_k^2. All other light counts at least as its mean
/// over the target does (Jensen), (sum_i w_i A_i rho_i K_ik)^2 / W with W = sum_i w_i A_i. That sum
/// is A_k rho_k (I_k - w_k). Neighbours do not err independently but some c of them together, as
/// they look at the same things: then sums are squared, not summands. Over A_k rho_k^2 all is
///
///     m_k = w_k + c A_k (I_k - w_k)^2 / W,
///
/// and the result is m_k over sum_i w_i^2 A_i / W, which is 1 for a group.
///
/// I is the mean over the patch and its neighbours: a patch must not get more rays because its own
/// have found the target (RayPlan::weigh).
[[nodiscard]] std::vector<double> importance_of_rays(const Mesh& mesh,
                                                     std::span<const Vec3> importance,
                                                     std::span<const double> weight);

/// Knows which patches the target depends on, and how much, as far as a run has found out.
class TargetAim {
  public:
    /// Aims at nothing where `weight` is empty: there is no target, and nothing is ever known.
    TargetAim(const Mesh& mesh, std::span<const double> weight);

    [[nodiscard]] bool has_target() const { return !weight_.empty(); }
    /// Takes note of a step. Parts of the scene (linked_parts.h) without a patch of the target are
    /// not needed, as far as the target is lit.
    void step_done(std::span<const std::uint32_t> part, const std::vector<bool>& lit);
    /// Returns whether importance is to be found again before further rays. That is so after the
    /// first step, and later only where a part has turned out to be needed.
    [[nodiscard]] bool is_outdated() const { return is_outdated_; }
    /// Computes importance from the rays so far. From the first few, only what is important is
    /// concluded.
    void renew(const Mesh& mesh, const TransportSystem& system, const ExchangeMatrix& factors,
               const Workers& workers);

    /// Returns the importance of the rays of each patch (importance_of_rays); a patch with 0 needs
    /// no more rays.
    [[nodiscard]] std::span<const double> importance() const { return of_rays_; }
    /// Returns what the squared error of a patch's own light counts, times its area and reflectance
    /// squared. This is m_k with c = 1: the patch errs independently, as by shadow rays.
    [[nodiscard]] double counts_alone(std::uint32_t patch) const;
    /// Returns the number of lit patches that need no more rays.
    [[nodiscard]] std::size_t unneeded() const { return unneeded_; }

    void save(StateWriter& state) const;
    /// Loads a state; throws StateError for what save() cannot have written.
    void load(StateReader& state);

  private:
    void leave_out_unneeded();

    std::span<const double> weight_; ///< weights by patch; empty: there is no target
    double unit_ = 0;                ///< unit of of_rays_, in weights
    std::vector<double> learned_;    ///< importance of rays, were all patches needed
    std::vector<double> of_rays_;    ///< importance of rays, by patch
    std::vector<bool> needed_;       ///< empty: not known yet
    bool is_outdated_ = false;
    std::size_t unneeded_ = 0;
};

} // namespace hemilux
