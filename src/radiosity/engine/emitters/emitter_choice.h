#pragma once
// The choice of the emitter that a shadow ray of a patch goes to. It is drawn by the light that
// each would send there if nothing stood between. With equal chances, an error of 1 % takes 36 to
// 93 times as many rays.
//
// With up to 1024 emitters each is weighed by itself. If there are more, they form a tree of
// clusters, and each patch weighs 128 of these. Near ones are divided, far ones are not (as in
// Walter et al. 2005, "Lightcuts"). Within a cluster, emitters are drawn by their power. So the
// work for a patch does not grow with the emitters. Any emitter that may send light there has a
// chance, so what is found is right on average.
//
// The best chance is proportional to the root of the mean square of what a ray would bring. An
// emitter beside a large patch brings little on the whole but much to the points that touch it. If
// it were drawn by the mean alone, those few rays would make most of the error.

#include "geometry/vector.h"
#include "radiosity/engine/sampling/sampling_kernels.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace hemilux {

class Mesh;
struct Patch;

class EmitterChoice {
  public:
    /// `emitters` are what emits.
    EmitterChoice(const Mesh& mesh, std::span<const Patch> emitters);

    /// This is what a patch weighs: emitters or clusters, and running sums of their weights.
    struct Cut {
        std::vector<std::uint32_t> clusters; ///< empty: it is all emitters, in their order
        /// The centre, radius, power, area and light of those that are not single emitters, which
        /// stand first.
        std::array<std::vector<double>, 7> of_many;
        /// The running sums: one more than there are weights, from 0; then infinity, up to a power
        /// of two.
        std::vector<double> sums;
        double sum = 0;
        std::vector<double> found; ///< by ray at random, of each: its mean square
        double square_found = 0;   ///< sum of these
        /// Returns whether no light can come from anywhere.
        [[nodiscard]] bool dark() const { return !(sum > 0); }
        /// Returns whether a shadow ray lowers the error about as much as a random one, or more.
        /// Where many emitters touch a surface, each fills the view of a few points, but is seldom
        /// drawn for just those. What such a ray brings varies more than what one finds by chance.
        [[nodiscard]] bool pays() const { return sum * sum <= 4 * square_found; }
    };
    /// Prepares choose() for a receiver, a patch.
    void weigh(std::uint32_t receiver, Cut& cut) const;
    /// Does the same for a point with a unit normal, in the local frame.
    void weigh(const Vec3& point, const Vec3& normal, Cut& cut) const;
    struct Choice {
        std::uint32_t emitter; ///< its place among the emitters
        double chance;         ///< with which it is drawn [-]
    };
    using Choices = std::array<Choice, samples_per_block>;
    /// Chooses one for each of sixteen numbers in [0, 1), from a cut that is not dark.
    void choose(const Cut& cut, const double* u, Choices& choices) const;

  private:
    struct Cluster {
        std::uint32_t begin, end; ///< of order_
        Vec3 centre{0.0};
        double radius = 0; ///< of a sphere around all of them
        double power = 0;
        double area = 0;                   ///< mean
        double light = 0;                  ///< mean by power
        std::uint32_t left = 0, right = 0; ///< its halves; 0: it is one emitter
    };
    std::uint32_t add(std::uint32_t begin, std::uint32_t end);
    void divide(std::uint32_t cluster);
    void list_emitters();
    [[nodiscard]] EmitterArrays arrays_from(std::size_t k) const;
    void weigh_all(const EmitterReceiver& to, Cut& cut) const;
    void choose_clusters(const EmitterReceiver& to, Cut& cut) const;
    void weigh_clusters(const EmitterReceiver& to, Cut& cut) const;
    [[nodiscard]] Choice choose_within(const Cluster& cluster, double share) const;
    [[nodiscard]] double power_of(std::uint32_t place) const;
    [[nodiscard]] static double nearness(const EmitterReceiver& to, const Cluster& cluster);

    const Mesh& mesh_;
    std::span<const Patch> emitters_;
    std::vector<std::uint32_t> order_; ///< places among the emitters, cluster by cluster
    std::vector<double> power_sums_;   ///< by order_, one more: of all before
    std::vector<Cluster> clusters_;    ///< the first is all of them
    std::vector<double> light_;        ///< of each emitter, see balanced_light
    /// These are, in the order of order_, the centre, normal, four corners, area, side, light.
    std::array<std::vector<double>, 21> arrays_;
};

} // namespace hemilux
