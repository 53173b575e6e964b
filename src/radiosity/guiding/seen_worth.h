#pragma once
// What is known of the worth of rays, triangle by triangle of all hemispheres (seen_guide.h).
//
// A triangle's own hits say little when they are few. Its estimate is therefore moved towards that
// of its parent, which counts for a few hits more, and so on up to the patch and the scene
// (empirical Bayes): triangles between which the hits show no spread share their parent's worth.

#include "radiosity/hemisphere/hemisphere.h"

#include <cstdint>
#include <span>
#include <vector>

namespace hemilux {

class Mesh;
class StateReader;
class StateWriter;

class SeenWorth {
  public:
    SeenWorth(const Hemisphere& hemisphere, std::size_t patches);

    /// Adds to what is known of a leaf, the `leaf`-th triangle of the last level: the sum over hits
    /// of value / (rays per area and share), and how many hits told it. It counts once it has
    /// been settled.
    void add(std::uint32_t patch, std::size_t leaf, float sum, float hits) {
        news_[patch * leaves() + leaf] += Known{sum, hits};
    }
    /// What was added becomes known, its sums times a factor.
    void settle(double factor);
    /// What was added is forgotten: its step was not finished.
    void drop_news();

    [[nodiscard]] std::size_t leaves() const { return leaves_; }
    /// Share of a patch's power that a leaf has.
    [[nodiscard]] double share(std::size_t leaf) const { return shares_[first_leaf_ + leaf]; }
    /// Integral of the worth over a patch's hemisphere by its own hits, times its area.
    [[nodiscard]] double sum_of(std::uint32_t patch) const;
    /// The worth of each leaf, for sums that are to be multiplied by `scale`; `usual` is the worth
    /// where nothing is known.
    void estimate(std::uint32_t patch, double scale, double usual, std::span<double> worth) const;

    /// Of use when no worth will be asked for again.
    void forget() { known_ = {}, news_ = {}; }
    [[nodiscard]] std::size_t bytes() const {
        return (known_.size() + news_.size()) * sizeof(Known);
    }
    void save(StateWriter& state) const;
    void load(StateReader& state);

  private:
    struct Known {
        float sum = 0, hits = 0;
        void operator+=(const Known& more) { sum += more.sum, hits += more.hits; }
    };
    /// All triangles of a patch, leaf or not.
    void collect(std::uint32_t patch, std::vector<Known>& tree) const;

    const Hemisphere& hemisphere_;
    std::size_t first_leaf_, leaves_;
    std::vector<double> shares_;      ///< by cell
    std::vector<Known> known_, news_; ///< by patch and leaf
};

/// Rays of unequal power do not carry exactly the power to be shot. What is too much or too little
/// goes on over all bounces and spreads over all patches, so every ray has a worth besides what it
/// strikes: about 2 (rho M)^2 / N relative to the mean of N patches, M being all power shot over
/// that emitted. In usual rooms it is next to nothing; at reflectance .99 it is above all else, and
/// all rays are to be nearly equal.
[[nodiscard]] double worth_of_energy(const Mesh& mesh, std::span<const Vec3> radiosity);

} // namespace hemilux
