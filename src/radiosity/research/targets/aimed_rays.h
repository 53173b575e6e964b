#pragma once
// Importance-driven stochastic ray radiosity (the paper's reference 19; Bekaert 1999). Where only a
// target must be right (target.h), patches shoot by what their light does for it.
//
// The squared error due to a patch that shoots the power Phi_i by N_i rays is Phi_i^2 J_i / N_i.
// J_i is the mean of what a ray with a unit of power adds to the squared error of the target. A ray
// that arrives at j changes the light there by rho_j / A_j, and the square of this has the weight
// w_j A_j. So it adds rho_j u_j, with u_j = w_j rho_j / A_j. What is reflected from there adds at
// most as much again as a ray from j. So the mean is
//
//     J_i = sum_j F_ij rho_j (u_j + J_j),
//
// the importance of what i shoots; u is the importance of the target itself. For a given number of
// rays, the sum of all errors is least if N_i is proportional to Phi_i sqrt(J_i).
//
// As A F is symmetric, A rho (u + J) is the power that patches with the emission rho u shoot. These
// rays of importance are shot like rays of light. One that hits patch i adds the power p that it
// carries to A_i J_i. So hits count as if A_i / p rays from patch i had each found 1 or nothing.
// Rays of light, which small emitters shoot too, find rho_j (u_j + J_j) where they arrive.
//
// If the target is small, rays that go straight to it are shot separately (target_balls.h).

#include "radiosity/research/targets/target_balls.h"

#include <span>
#include <vector>

namespace hemilux {

struct SolverInput;
struct StepResult;
struct StepTask;

/// The allocation of the rays of a step to patches and balls.
struct Aim {
    /// The factor, by patch, on the rays that power alone would give to the patch [-]. It is
    /// positive; together with the rays to balls it is 1 on average over all power.
    std::vector<double> times;
    TargetBalls balls;
};

/// Shoots the task's rays as light into `pilot`, by the cosine law and through all bounces, and as
/// many rays as importance. With `balls`, some more rays look for the target. `times` is empty when
/// interrupted.
[[nodiscard]] Aim aim_rays(const SolverInput& input, const StepTask& task, bool balls,
                           StepResult& pilot);

/// Returns by patch what a ray counts that arrives with a unit of power: rho u, where u is divided
/// by its own mean.
[[nodiscard]] std::vector<double> values_of_arrival(const SolverInput& input);

} // namespace hemilux
