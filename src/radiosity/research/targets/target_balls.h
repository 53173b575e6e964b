#pragma once
// Rays that go straight to the crowded parts of a target. Small things on a table are lit by the
// whole room, whose rays mostly miss them.
//
// Balls are put around the patches that count most. What a patch shoots through a ball is drawn
// separately from the rest. From a uniform point x of the patch, a direction is drawn uniformly
// over the solid angle of the ball. It has the power W = cos(theta) solid_angle / pi for a unit
// that the patch shoots. Rays by the method's own directions that would pass through the ball carry
// nothing. So all of the power is shot, each part by one kind of ray, and light stays unbiased
// whichever the balls. From points near a ball, which would cover much of the hemisphere, it is not
// drawn separately.
//
// A ray that hits patch j with a unit of power counts the value v_j = w_j rho_j^2 / A_j
// (aimed_rays.h). So N rays to a ball have the squared error E[W^2 v] / N, and the best N is
// proportional to sqrt(E[W^2 v]). Before the first step, some rays look for that, and for what
// hides the ball.

#include "bvh/tracer.h"
#include "parallel/workers.h"
#include "radiosity/paper/rays/patch_start.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace hemilux {

class Mesh;
struct SolverInput;

struct TargetBall {
    Vec3 centre;   ///< local units
    double radius; ///< positive, local units

    /// Returns whether a ray from `origin` passes through the ball, and does not start near it.
    [[nodiscard]] bool takes(const Vec3& origin, const Vec3& direction) const;
    /// A direction for u uniform in [0,1)^2, and W. aim() returns nothing from near the ball, or if
    /// W is 0.
    struct Aimed {
        Vec3 direction; ///< unit
        double power;   ///< W [-]
    };
    [[nodiscard]] std::optional<Aimed> aim(const Vec3& origin, const Vec3& normal, Vec2 u) const;

  private:
    [[nodiscard]] bool is_near(const Vec3& to_centre) const;
};

/// Returns balls around the patches of the largest A_j v_j that make up most of the target. There
/// are at most eight, and fewer if more would not be much smaller.
[[nodiscard]] std::vector<TargetBall> find_balls(const Mesh& mesh, std::span<const double> value);

/// The balls of a target, and how many rays patches send to them.
class TargetBalls {
  public:
    TargetBalls() = default; ///< there are none
    TargetBalls(const Mesh& mesh, std::span<const double> value);

    [[nodiscard]] std::size_t count() const { return balls_.size(); }
    /// Returns the rays to a ball for each ray that power alone would give to the patch [-]; 0 if
    /// none go there separately.
    [[nodiscard]] double times(std::uint32_t patch, std::size_t ball) const {
        return times_[patch * count() + ball];
    }
    /// Returns these numbers by patch and ball; they are 0 until set.
    [[nodiscard]] std::span<double> times() { return times_; }
    [[nodiscard]] std::span<const double> times() const { return times_; }
    /// Returns to how many balls the power along this ray is shot separately.
    [[nodiscard]] unsigned takers(std::uint32_t patch, const Vec3& origin,
                                  const Vec3& direction) const;

    /// A ray from a patch to a ball, with W. draw() takes the random numbers of `key`, and returns
    /// nothing if the ray would carry nothing.
    struct Shot {
        Ray ray;
        double power; ///< W [-]
    };
    [[nodiscard]] std::optional<Shot> draw(const PatchStart& start, std::size_t ball,
                                           std::uint64_t key) const;

    /// This is what some rays from each patch have found, by patch and ball.
    struct Visibility {
        std::vector<double> root_of_value; ///< sqrt(E[W^2 v])
        std::vector<double> power;         ///< E[W]
        std::uint64_t rays = 0;
    };
    [[nodiscard]] Visibility look(const SolverInput& input, std::span<const double> value,
                                  const Workers& workers) const;

  private:
    std::vector<TargetBall> balls_;
    std::vector<double> times_;
};

} // namespace hemilux
