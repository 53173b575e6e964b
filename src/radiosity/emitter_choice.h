#pragma once
// Which emitter a shadow ray of a patch goes to: drawn by the light that each would send there if
// nothing stood between.
//
// With up to 128 emitters each is weighed by itself. Where there are more, neighbours are put
// together into 128 clusters; these are weighed, and within a cluster emitters are drawn by their
// power. So the work for a patch does not grow with the emitters. Any emitter that may send light
// there has a chance, so what is found is right on average.

#include "geometry/vector.h"

#include <cstdint>
#include <span>
#include <vector>

namespace hemilux {

class Mesh;

class EmitterChoice {
  public:
    /// `emitters`: patches that emit; they outlive this.
    EmitterChoice(const Mesh& mesh, std::span<const std::uint32_t> emitters);

    /// Fills the running sums of the weights that choose() takes. The last one is 0 where no light
    /// can come from anywhere.
    void weigh(std::uint32_t receiver, std::vector<double>& sums) const;

    struct Choice {
        std::uint32_t emitter; ///< its place among the emitters
        double chance;         ///< with which it is drawn
    };
    /// `u` in [0, 1).
    [[nodiscard]] Choice choose(std::span<const double> sums, double u) const;

  private:
    struct Cluster {
        std::uint32_t begin, end; ///< of order_
        Vec3 centre;
        double radius; ///< of a sphere around all of them
        double power;
    };
    void divide(std::uint32_t begin, std::uint32_t end, std::size_t clusters);
    void add_cluster(std::uint32_t begin, std::uint32_t end);
    [[nodiscard]] double weight(std::uint32_t receiver, const Cluster& cluster) const;
    [[nodiscard]] const Vec3& centre(std::uint32_t place) const;

    const Mesh& mesh_;
    std::span<const std::uint32_t> emitters_;
    std::vector<std::uint32_t> order_; ///< places among the emitters, cluster by cluster
    std::vector<double> power_sums_;   ///< by order_, from the beginning of each cluster on
    std::vector<Cluster> clusters_;
};

} // namespace hemilux
