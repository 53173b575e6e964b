#pragma once
// The numbers of rays that the triangles of hemispheres get by their importance V
// (visibility_guide.h). They are proportional to sqrt(V), which each triangle keeps in one byte, as
// a logarithm.

#include "radiosity/research/guiding/log_byte.h"

#include <array>
#include <cstdint>
#include <vector>

namespace hemilux {

class StateReader;
class StateWriter;

/// A triangle always gets this part of the rays that power alone would give it. So none starves,
/// and no ray carries more than 1 / lowest_density of the mean.
inline constexpr double lowest_density = .2;

class RayDensities {
  public:
    /// `shares` are those of a patch's power, by leaf [-]. All leaves are alike at first.
    RayDensities(std::size_t patches, std::vector<double> shares);

    [[nodiscard]] std::size_t leaves() const { return shares_.size(); }
    /// Returns the factor on the rays for the power of a leaf; it is 1 on average.
    [[nodiscard]] double of(std::uint32_t patch, std::size_t leaf) const {
        return density_[importance_[patch * leaves() + leaf]];
    }
    /// Returns the same factor for the power of a patch.
    [[nodiscard]] double for_power(std::uint32_t patch) const { return rays_for_power_[patch]; }

    /// Keeps sqrt(V) of a leaf, and returns it as it is kept.
    double keep(std::uint32_t patch, std::size_t leaf, double root);
    /// Sets the mean of sqrt(V) over all power. find_for_power() of all patches must follow.
    void set_mean(double mean_root);
    void find_for_power(std::uint32_t patch);

    [[nodiscard]] std::size_t bytes() const { return importance_.size(); }
    void save(StateWriter& state) const;
    /// Loads what save() has written; find_for_power() of all patches must follow. Throws
    /// StateError for what save() cannot have written.
    void load(StateReader& state);

  private:
    std::vector<double> shares_;
    double mean_root_ = 0;
    std::vector<std::uint8_t> importance_;         ///< sqrt(V) by patch and leaf
    std::array<double, log_byte::values> density_; ///< density by the byte of importance_
    std::vector<double> rays_for_power_;           ///< rays by patch
};

} // namespace hemilux
