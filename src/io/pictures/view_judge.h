#pragma once
// How good a picture a camera would give, judged by a few rays.

#include "io/pictures/camera.h"

#include <span>
#include <vector>

namespace hemilux {

class ViewJudge {
  public:
    /// Mesh and tracer must outlive the judge.
    ViewJudge(const Mesh& mesh, const Tracer& tracer, std::span<const Vec3> radiosity);

    /// Higher is better, 0 worthless: rewards lit surfaces in all of the picture, many facets,
    /// materials and orientations, contrast and width; looking through backs and close-ups cost.
    /// `columns` x `rows` rays.
    [[nodiscard]] double score(const Camera& camera, double aspect, int columns, int rows) const;
    /// Whether a point of the local frame has the fronts of lit surfaces in most directions.
    [[nodiscard]] bool is_inside(const Vec3& point) const;

  private:
    const Mesh& mesh_;
    const Tracer& tracer_;
    std::vector<double> brightness_; ///< of each patch, 0 to 1, half at the reference's tenth
    double diagonal_;                ///< of the scene's box, local frame
};

} // namespace hemilux
