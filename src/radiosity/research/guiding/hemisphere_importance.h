#pragma once
// Estimates of the importance of rays, for each triangle of each patch's hemisphere
// (visibility_guide.h).
//
// A triangle's own hits say little when they are few. Its estimate is therefore moved towards that
// of its parent, which counts for a few hits more, and so on up to the patch and the scene
// (empirical Bayes). Triangles between which the hits show no spread share their parent's
// importance.

#include "radiosity/paper/hemisphere/hemisphere.h"

#include <cstdint>
#include <span>
#include <vector>

namespace hemilux {

class Mesh;
class StateReader;
class StateWriter;

class HemisphereImportance {
  public:
    HemisphereImportance(const Hemisphere& hemisphere, std::size_t patches);

    /// Adds the sum over hits of value / (rays per area and share), and the number of these hits,
    /// to what is known of a leaf. This is the `leaf`-th triangle of the last level. What is added
    /// counts once it has been committed.
    void add(std::uint32_t patch, std::size_t leaf, float sum, float hits) {
        pending_[patch * leaves() + leaf] += Known{sum, hits};
    }
    /// Makes what was added known, with its sums multiplied by `factor`.
    void commit(double factor);
    /// Forgets what was added, because its step was not finished.
    void drop_pending();

    [[nodiscard]] std::size_t leaves() const { return leaves_; }
    /// Returns the share of a patch's power that a leaf has [-].
    [[nodiscard]] double share(std::size_t leaf) const { return shares_[first_leaf_ + leaf]; }
    [[nodiscard]] std::vector<double> shares() const {
        return {shares_.end() - static_cast<std::ptrdiff_t>(leaves_), shares_.end()};
    }
    /// Returns the integral of the importance over a patch's hemisphere by its own hits, times its
    /// area.
    [[nodiscard]] double sum_of(std::uint32_t patch) const;
    /// Writes the importance of each leaf, for sums that are to be multiplied by `scale`.
    /// `prior_mean` is the importance where nothing is known.
    void estimate(std::uint32_t patch, double scale, double prior_mean,
                  std::span<double> importance) const;

    /// Frees the memory, for when no importance will be asked for again.
    void forget() { known_ = {}, pending_ = {}; }
    [[nodiscard]] std::size_t bytes() const {
        return (known_.size() + pending_.size()) * sizeof(Known);
    }
    void save(StateWriter& state) const;
    void load(StateReader& state);

  private:
    struct Known {
        float sum = 0, hits = 0;
        void operator+=(const Known& more) { sum += more.sum, hits += more.hits; }
    };
    /// Writes the sums of all triangles of a patch, leaf or not, to `tree`.
    void collect(std::uint32_t patch, std::vector<Known>& tree) const;

    const Hemisphere& hemisphere_;
    std::size_t first_leaf_, leaves_;
    std::vector<double> shares_;         ///< shares by cell
    std::vector<Known> known_, pending_; ///< importance by patch and leaf
};

/// Returns the importance that every ray has besides what it hits. Rays of unequal power do not
/// carry exactly the power to be shot. What is too much or too little goes on over all bounces and
/// spreads over all patches. This importance is about 2 (rho M)^2 / N relative to the mean of N
/// patches, where M is all power shot over that emitted. In most rooms it is next to nothing; at
/// reflectance .99 it is above all else, and all rays should be nearly equal.
[[nodiscard]] double importance_of_energy(const Mesh& mesh, std::span<const Vec3> radiosity);

} // namespace hemilux
