#pragma once
// Importance-driven stochastic ray radiosity (the paper's reference 19; Bekaert 1999): where only a
// target is to be right (target.h), patches shoot by what their light does for it.
//
// A patch that shoots the power Phi_i by N_i rays errs by Phi_i^2 / N_i times the mean of what a
// ray with a unit of power adds to the squared error of the target. One that arrives at j changes
// the light there by rho_j / A_j, whose square counts w_j A_j: rho_j u_j, with u_j = w_j rho_j /
// A_j. What is reflected from there adds as much again as a ray from j, at most. So the mean is
//
//     J_i = sum_j F_ij rho_j (u_j + J_j),
//
// the importance of what i shoots, u being that of the target itself. The errors of all patches add
// up to the least, for a given number of rays, where N_i is as Phi_i sqrt(J_i).
//
// A F being symmetric, A rho (u + J) is the power that patches with the emission rho u shoot. Its
// rays are shot as those of light are. One that hits patch i brings to A_i J_i what the ray
// carries, p; so hits count as of A_i / p rays from patch i that each find 1 or nothing. Rays of
// light, which small emitters shoot too, find rho_j (u_j + J_j) where they arrive.
//
// Where the target is small, rays that go straight to it are shot apart (target_balls.h).

#include "radiosity/shooting/target_balls.h"

#include <span>
#include <vector>

namespace hemilux {

struct SolverInput;
struct StepResult;
struct StepTask;

/// How the rays of a step are allocated.
struct Aim {
    /// By patch, how many times the rays that its power alone would give it a patch gets for the
    /// target of the input: positive, and with those to balls over all power 1 on average.
    std::vector<double> times;
    TargetBalls balls;
};

/// Shoots the task's rays as light, by the cosine law and all bounces, into `pilot`, and as many as
/// importance; with `balls` some rays more look for the target. `times` is empty when interrupted.
[[nodiscard]] Aim aim_rays(const SolverInput& input, const StepTask& task, bool balls,
                           StepResult& pilot);

/// What a ray that arrives with a unit of power counts, by patch: rho u, u being over its own mean.
[[nodiscard]] std::vector<double> values_of_arrival(const SolverInput& input);

} // namespace hemilux
