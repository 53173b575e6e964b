#pragma once
// Describes panes: faces that let a share of light through and absorb the rest.
//
// A pane emits and reflects nothing, so no patch stands for it and nothing has to be solved on it:
// along a ray, light from either side is multiplied by the transmittance of each pane on the way.
// Exchange between two patches stays symmetric by that.

#include "bvh/bvh.h"
#include "geometry/polygon.h"
#include "geometry/vector.h"

#include <array>
#include <span>
#include <vector>

namespace hemilux {

class Mesh;
struct Scene;

struct Pane {
    std::array<Vec3, 4> corner; ///< world units [m]; of a triangle the last two are equal
    double transmittance;       ///< [-], of light that crosses it once, from 0 to 1
};

/// Returns the panes of a scene.
[[nodiscard]] std::span<const Pane> panes_of(const Scene& scene);
/// Returns their shapes in the local frame of a mesh.
[[nodiscard]] std::vector<Polygon> local_panes(const Mesh& mesh);

/// The panes of a mesh, as rays cross them.
class PaneCrossings {
  public:
    explicit PaneCrossings(const Mesh& mesh);

    /// Returns the share of light [-] that comes along a ray up to t_max. Panes in one place count
    /// as one; those where the ray begins or ends do not count.
    [[nodiscard]] double passed(const Ray& ray) const;
    /// Returns whether the ray crosses a pane up to t_max.
    [[nodiscard]] bool any_on(const Ray& ray) const;

  private:
    Bvh tree_;
    std::vector<double> transmittance_; ///< by facet of the tree
};

} // namespace hemilux
