#pragma once
// What a point sees of one side of a facet: the part that nothing hides, and its factor.

#include "bvh/wide/wide_bvh.h"
#include "geometry/frame.h"
#include "radiosity/engine/factors/pairs/free_exchange.h"
#include "radiosity/engine/factors/points/point_factors.h"
#include "radiosity/engine/factors/points/seen_part.h"

#include <cstdint>
#include <vector>

namespace hemilux {

/// A side of a facet or of a part of it, as a point may see it.
struct PointTarget {
    FacePlane face;
    std::uint32_t facet;
    std::uint32_t column; ///< surface; none: back of a one-sided facet
};

/// Returns about the factor of a target that nothing hides, rather too large than too small.
[[nodiscard]] double rough_factor(const FactorPoint& point, const PointTarget& target);

/// What is seen of a target: a factor, its variance, and how much of it is above the level of the
/// point, towards the sky.
struct SeenFactor {
    double factor = 0, variance = 0, above = 0;
};

/// Sees targets from one point after the other. It has memory of its own; one for each thread.
class TargetView {
  public:
    TargetView(const Mesh& mesh, const WideBvh& tree, const PointFactorOptions& options)
        : mesh_(mesh), tree_(tree), options_(options) {}

    /// Goes to a point; it has to before it sees anything.
    void move_to(const FactorPoint& point);
    /// Returns what is seen of a target in front of which the point is.
    [[nodiscard]] SeenFactor see(const PointTarget& target, std::uint64_t seed);

  private:
    struct Cover {
        ConvexPart part;
        double factor;
    };
    [[nodiscard]] ConvexPart directions_of(const ConvexPart& part) const;
    [[nodiscard]] ConvexPart cover_of(std::uint32_t facet, const PointTarget& target) const;
    [[nodiscard]] bool is_hidden_by_one(const PointTarget& target, const ConvexPart& whole);
    void find_covers(const PointTarget& target, const ConvexPart& part);
    [[nodiscard]] bool cut_out(const ConvexPart& whole);
    [[nodiscard]] SeenFactor by_rays(const PointTarget& target, double free,
                                     std::uint64_t seed) const;

    const Mesh& mesh_;
    const WideBvh& tree_;
    const PointFactorOptions& options_;

    FactorPoint point_{};
    Frame frame_{}; ///< its z is the point's normal
    Plane horizon_{};
    Vec3 up_{}; ///< in the point's frame
    std::vector<std::uint32_t> near_;
    std::vector<Cover> covers_;
    SeenPart seen_;
};

} // namespace hemilux
