#pragma once
// Rays that go straight to the crowded parts of a target: small things on a table are lit by the
// whole room, whose rays mostly miss them.
//
// Balls are put around the patches that count most. What a patch shoots through a ball is drawn
// apart from the rest: from a uniform point x of the patch, a direction uniform over the solid
// angle of the ball, with the power W = cos(theta) solid_angle / pi for a unit that the patch
// shoots. Rays by the method's own directions that would pass through the ball carry nothing. So
// all of the power is shot, each part by one kind of ray, and light stays unbiased whichever the
// balls. From points near a ball, which would cover much of the hemisphere, it is not apart.
//
// A ray that hits patch j with a unit of power counts the value v_j = w_j rho_j^2 / A_j
// (aimed_rays.h), so N rays to a ball err by E[W^2 v] / N, and the best N is as sqrt(E[W^2 v]).
// Some rays look for that, and for what hides the ball, before the first step.

#include "bvh/tracer.h"
#include "parallel/workers.h"
#include "radiosity/rays/patch_start.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace hemilux {

class Mesh;
struct SolverInput;

struct TargetBall {
    Vec3 centre;
    double radius; ///< positive, local units

    /// Whether a ray from here passes through it, and not from near.
    [[nodiscard]] bool takes(const Vec3& origin, const Vec3& direction) const;
    /// A direction for u uniform in [0,1)^2, and W; nothing from near, or where W is 0.
    struct Aimed {
        Vec3 direction; ///< unit
        double power;   ///< W [-]
    };
    [[nodiscard]] std::optional<Aimed> aim(const Vec3& origin, const Vec3& normal, Vec2 u) const;

  private:
    [[nodiscard]] bool is_near(const Vec3& to_centre) const;
};

/// Around the patches of the largest A_j v_j that make up most of the target; at most eight, fewer
/// where more would not be much smaller.
[[nodiscard]] std::vector<TargetBall> find_balls(const Mesh& mesh, std::span<const double> value);

/// The balls of a target, and how many rays patches send to them.
class TargetBalls {
  public:
    TargetBalls() = default; ///< there are none
    TargetBalls(const Mesh& mesh, std::span<const double> value);

    [[nodiscard]] std::size_t count() const { return balls_.size(); }
    /// Rays to a ball for each ray that the patch's power would give it; 0: none go there apart.
    [[nodiscard]] double times(std::uint32_t patch, std::size_t ball) const {
        return times_[patch * count() + ball];
    }
    /// By patch and ball; 0 until set.
    [[nodiscard]] std::span<double> times() { return times_; }
    [[nodiscard]] std::span<const double> times() const { return times_; }
    /// To how many balls what the patch shoots along this ray is shot apart.
    [[nodiscard]] unsigned takers(std::uint32_t patch, const Vec3& origin,
                                  const Vec3& direction) const;

    /// A ray from the patch to a ball, drawn by the random numbers of `key`, with W; nothing where
    /// it would carry nothing.
    struct Shot {
        Ray ray;
        double power;
    };
    [[nodiscard]] std::optional<Shot> draw(const PatchStart& start, std::size_t ball,
                                           std::uint64_t key) const;

    /// What some rays from each patch have found, by patch and ball.
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
