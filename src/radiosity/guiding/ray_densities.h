#pragma once
// How many rays the triangles of hemispheres get by their importance V (visibility_guide.h): in
// proportion to sqrt(V), which each keeps in one byte, as a logarithm.

#include "radiosity/hemisphere/log_byte.h"

#include <array>
#include <cstdint>
#include <vector>

namespace hemilux {

class StateReader;
class StateWriter;

/// The part of its rays by power alone that a triangle always gets: so none starves, and no ray
/// carries more than 1 / lowest_density of the mean.
inline constexpr double lowest_density = .2;

class RayDensities {
  public:
    /// `shares` [-]: of a patch's power, by leaf. All leaves are alike at first.
    RayDensities(std::size_t patches, std::vector<double> shares);

    [[nodiscard]] std::size_t leaves() const { return shares_.size(); }
    /// Rays for the power of a leaf, on average 1.
    [[nodiscard]] double of(std::uint32_t patch, std::size_t leaf) const {
        return density_[importance_[patch * leaves() + leaf]];
    }
    /// Rays for the power of a patch, likewise.
    [[nodiscard]] double for_power(std::uint32_t patch) const { return rays_for_power_[patch]; }

    /// Keeps sqrt(V) of a leaf, and returns it as it is kept.
    double keep(std::uint32_t patch, std::size_t leaf, double root);
    /// From the mean of sqrt(V) over all power; find_for_power() of all patches is to follow.
    void set_mean(double mean_root);
    void find_for_power(std::uint32_t patch);

    [[nodiscard]] std::size_t bytes() const { return importance_.size(); }
    void save(StateWriter& state) const;
    /// Followed by find_for_power(). Throws StateError for what save() cannot have written.
    void load(StateReader& state);

  private:
    std::vector<double> shares_;
    double mean_root_ = 0;
    std::vector<std::uint8_t> importance_;         ///< sqrt(V) by patch and leaf
    std::array<double, log_byte::values> density_; ///< by the byte of importance_
    std::vector<double> rays_for_power_;           ///< by patch
};

} // namespace hemilux
