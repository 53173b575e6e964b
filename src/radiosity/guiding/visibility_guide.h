#pragma once
// A strategy that is guided by what rays hit instead of how many surfaces they pierce.
//
// A ray of power w that hits patch j adds (rho_j w)^2 / A_j to the area-weighted variance of the
// solution. So the importance of a triangle t of patch i is
//
//     V_it = 1/p_t sum_j F_ij,t rho_j^2 / A_j,
//
// p_t being its share of the power and F_ij,t the part of the form factor that lies in t; and the
// best number of rays is Phi_i p_t sqrt(V_it), with the same factor for all triangles of all
// patches: small and bright things want rays, whoever sees them.
//
// *Both ways.* A small j is rarely hit from i, but each ray of j that hits i shows i in which
// triangle j stands. By reciprocity, A_i F_ij = A_j F_ji, so all rays between the two, whoever shot
// them, estimate one number; each counts 1 / (D_it + D_js), D being the rays sent so far per area
// and share of power (balance heuristic, Veach 1997). Hence no crowd between three empty corners is
// missed: its own rays report it.
//
// *Spread.* What few hits show of a triangle is noise. Each triangle counts for what its own hits
// show, and as some hits more for what its parent's show: children whose parent's hits do not show
// a spread share its importance.
//
// Each triangle keeps sqrt(V) in one byte, and none gets less than a part of its share by power
// (ray_densities.h).

#include "radiosity/shooting/strategy.h"

#include <memory>

namespace hemilux {

class Workers;

/// Learns from a few rays of each patch before the first step, and with `learn` also from all rays
/// of the steps.
[[nodiscard]] std::unique_ptr<Strategy> make_visibility_guide(const SolverInput& input,
                                                              const Hemisphere& hemisphere,
                                                              const Workers& workers, bool learn);

} // namespace hemilux
