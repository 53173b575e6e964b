#pragma once
// Decides from which patches rays are to be traced: how much a ray of each takes from the error.

#include "geometry/vector.h"
#include "radiosity/paper/scene/needs.h"

#include <cstdint>
#include <span>
#include <vector>

namespace hemilux {

class Mesh;
class StateReader;
class StateWriter;

/// Errors of well-distributed points fall about as rays^-.7, and their squares with this power:
inline constexpr double variance_fall = 1.5;

class RayWeights {
  public:
    /// Weighs patches by area and reflectance, as long as nothing is known.
    RayWeights(const Mesh& mesh, const Needs& needs);

    // These return, by patch and in any unit, the importance of a cosine-distributed ray and of a
    // shadow ray. A patch with 0 gets no more.
    [[nodiscard]] std::span<const double> random() const { return random_; }
    [[nodiscard]] std::span<const double> to_emitters() const { return to_emitters_; }
    /// Returns whether light of emitters might reach a patch, but by the rays so far none has.
    [[nodiscard]] bool is_left_out(std::size_t patch) const {
        return to_emitters_[patch] == 0 && prior_to_emitters_[patch] > 0;
    }

    /// Gives no more rays to patches that no light has reached (`lit`), unless none is lit.
    void leave_out(const std::vector<bool>& lit);

    /// Gives more rays to patches to which light comes that is uneven; none to those that no light
    /// reaches (`lit`), as far as all rays know. `variance` is that of the light over the
    /// directions of each patch, by channel.
    ///
    /// How many rays a patch gets must not depend on what its own rays have found. Where they
    /// missed something rare, their variance is too small, fewer rays would follow, and the mean of
    /// all would stay wrong. So a patch is weighed by its neighbours, and only once, by the first
    /// rays that found light, which are soon a small part of all.
    void weigh(std::span<const Vec3> variance, const std::vector<bool>& lit);

    /// Gives more shadow rays to patches whose light from emitters is uncertain. `variance` is that
    /// of each patch, times its area, in any unit, as so many `rays` left it. Where it is negative
    /// the patch takes none.
    void weigh_emitters(std::span<const double> variance, std::span<const std::uint32_t> rays,
                        const std::vector<bool>& lit);

    void save(StateWriter& state) const;
    /// Takes the state of weights made with the same arguments. Throws StateError for what save()
    /// cannot have written.
    void load(StateReader& state);

  private:
    [[nodiscard]] double of_neighbours(std::uint32_t patch, std::span<const double> known) const;
    void learn(std::span<const Vec3> variance);
    static void mix(std::span<const double> known, std::span<const double> prior,
                    std::vector<double>& weights);

    const Mesh& mesh_;
    std::vector<Vec3> reflectance_; ///< reflectance by patch [-]
    std::vector<double> random_, to_emitters_;
    std::vector<double> learned_random_; ///< weights, were all patches lit
    bool has_learned_ = false;
    std::vector<double> prior_random_, prior_to_emitters_; ///< weights before anything is known
};

} // namespace hemilux
