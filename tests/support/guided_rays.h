#pragma once
// A lamp that has a crowd on one side and nothing on the other, and where a method sends its rays.

#include "bvh/bvh.h"
#include "radiosity/paper/scene/mesh.h"
#include "radiosity/paper/solving/solver.h"
#include "support/scenes.h"

#include <cstdint>
#include <memory>

namespace hemilux::test {

/// A small lamp that faces up, at the origin, and black sheets across the axis x, one behind the
/// other. They fill almost half of its hemisphere, and a ray there pierces all of them.
[[nodiscard]] inline Scene lamp_beside_crowd(int sheets) {
    Scene scene;
    scene.materials = {{"lamp", Vec3(0.0), Vec3(1.0)}, {"black", Vec3(0.0), Vec3(0.0)}};
    scene.groups = {"all"};
    const double e = 1e-3, wide = 20;
    add_quad(scene, {-e, 0, -e}, {-e, 0, e}, {e, 0, e}, {e, 0, -e}, 1, 1, 0);
    for (int k = 0; k < sheets; ++k) {
        const double x = .1 + 1e-4 * k;
        add_quad(scene, {x, 0, -wide}, {x, 0, wide}, {x, wide, wide}, {x, wide, -wide}, 1, 1, 1);
    }
    return scene;
}

/// Counts the rays that are traced, and those at least 30 degrees away from the plane x = 0, on its
/// other side than the crowd.
class RaysToOneSide final : public Tracer {
  public:
    explicit RaysToOneSide(const FacetSoup& soup) : bvh_(soup) {}
    [[nodiscard]] std::optional<Hit> closest(const Ray& ray) const override {
        ++all_;
        open_ += ray.direction.x < -.5;
        return bvh_.closest(ray);
    }
    [[nodiscard]] bool occluded(const Ray& ray, std::uint32_t target) const override {
        return bvh_.occluded(ray, target);
    }
    [[nodiscard]] std::uint32_t count(const Ray& ray) const override { return bvh_.count(ray); }
    [[nodiscard]] double open_share() const { return double(open_) / double(all_); }

  private:
    Bvh bvh_;
    mutable std::uint64_t all_ = 0, open_ = 0;
};

/// The share of power that goes there by the cosine law: a segment of the disc.
inline constexpr double power_away_from_crowd = 0.1955;

/// The share of a solver's rays that leave the lamp away from a crowd of 257 sheets.
template <class Make>
[[nodiscard]] double share_away_from_crowd(const Make& make) {
    const Mesh mesh(lamp_beside_crowd(257)); // more than a byte holds
    const RaysToOneSide tracer(mesh.soup());
    const SolveOptions options{.rays = 400, .threads = 1};
    Monitor monitor;
    const auto solver = make(SolverInput{mesh, tracer, options, monitor});
    (void)solver->step();
    return tracer.open_share();
}

} // namespace hemilux::test
