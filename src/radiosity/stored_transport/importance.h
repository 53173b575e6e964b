#pragma once
// What the light of each patch counts for a target: the adjoint of the radiosity equation, solved
// on the stored rays, and where more rays gain most.
//
// The light that arrives solves h = d + F rho h. Since A_i F_ij is symmetric, importance, which
// flows the other way (Smits, Arvo and Salesin 1992), solves the same equation: I = w + F rho I,
// with the weights w of the target for d. Then
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

/// I = w + F rho I by channel; by patch, `weight` is w.
/// `tolerance`: as of solve_by_gradients().
[[nodiscard]] std::vector<Vec3> importance_of(const ExchangeMatrix& factors,
                                              std::span<const double> area,
                                              std::span<const Vec3> reflectance,
                                              std::span<const double> weight,
                                              const Workers& workers, double tolerance);

/// What the variance of the light that rays bring to a patch counts in the error of the target,
/// over what it counts on a target of the mean weight (that of its own light): m_k below.
///
/// Noise e_k of the row k moves the light at i by G_ik e_k, G = 1 + K being the inverse of 1 - F
/// rho, and the squared error of the target by sum_i w_i A_i rho_i^2 G_ik^2 of e_k^2. The patch's
/// own light, G_kk = 1, counts w_k A_k rho_k^2. All other light counts at least as its mean over
/// the target does (Jensen), (sum_i w_i A_i rho_i K_ik)^2 / W with W = sum_i w_i A_i, and that sum
/// is A_k rho_k (I_k - w_k). Neighbours do not err each for itself but some c of them together,
/// as they look at the same things: then sums are squared, not summands. Over A_k rho_k^2 all is
///
///     m_k = w_k + c A_k (I_k - w_k)^2 / W,
///
/// and given out are m_k over sum_i w_i^2 A_i / W, which is 1 for a group.
///
/// I is the mean over the patch and its neighbours: a patch must not get more rays as its own have
/// found the target (RayPlan::weigh).
[[nodiscard]] std::vector<double> importance_of_rays(const Mesh& mesh,
                                                     std::span<const Vec3> importance,
                                                     std::span<const double> weight);

/// Which patches the target depends on, and how much, as a run knows it.
class TargetAim {
  public:
    /// Empty `weight`: there is no target, and nothing is ever known. What is referred to outlives
    /// this.
    TargetAim(const Mesh& mesh, const TransportSystem& system, std::span<const double> weight);

    [[nodiscard]] bool has_target() const { return !weight_.empty(); }
    /// After a step: parts of the scene (linked_parts.h) without a patch of the target are not
    /// needed, as far as the target is lit.
    void step_done(std::span<const std::uint32_t> part, const std::vector<bool>& lit);
    /// Whether what is important is to be found out once more before further rays: after the first
    /// step, and later only where a part has turned out to be needed.
    [[nodiscard]] bool is_outdated() const { return is_outdated_; }
    /// From the rays so far. Of the first few nothing is concluded but what is important.
    void renew(const ExchangeMatrix& factors, const Workers& workers);

    /// The importance of the rays of each patch (importance_of_rays); 0: it needs no more rays.
    [[nodiscard]] std::span<const double> importance() const { return of_rays_; }
    /// What the squared error of a patch's own light counts, times its area and reflectance
    /// squared, where it errs for itself, as by shadow rays: m_k with c = 1.
    [[nodiscard]] double counts_alone(std::uint32_t patch) const;
    /// Counts the lit patches that need no more rays.
    [[nodiscard]] std::size_t unneeded() const { return unneeded_; }

    void save(StateWriter& state) const;
    /// Throws StateError for what save() cannot have written.
    void load(StateReader& state);

  private:
    void leave_out_unneeded();

    const Mesh& mesh_;
    const TransportSystem& system_;
    std::span<const double> weight_;
    double unit_ = 0;             ///< of of_rays_, in weights
    std::vector<double> learned_; ///< of rays, were all patches needed
    std::vector<double> of_rays_;
    std::vector<bool> needed_; ///< empty: not known yet
    bool is_outdated_ = false;
    std::size_t unneeded_ = 0;
};

} // namespace hemilux
