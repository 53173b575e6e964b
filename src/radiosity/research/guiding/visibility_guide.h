#pragma once
// A strategy that is guided by what rays hit instead of how many surfaces they pierce.
//
// A ray of power w that hits patch j adds (rho_j w)^2 / A_j to the area-weighted variance of the
// solution. So the importance of a triangle t of patch i is
//
//     V_it = 1/p_t sum_j F_ij,t rho_j^2 / A_j,
//
// where p_t is its share of the power and F_ij,t the part of the form factor that lies in t. The
// best number of rays is Phi_i p_t sqrt(V_it), with the same factor for all triangles of all
// patches. So small and bright things get many rays, whoever sees them.
//
// *Both ways.* A small j is rarely hit from i, but each ray of j that hits i shows i in which
// triangle j stands. By reciprocity, A_i F_ij = A_j F_ji. So all rays between the two, whoever shot
// them, estimate one number. Each counts 1 / (D_it + D_js), where D is the rays sent so far per
// area and share of power (balance heuristic, Veach 1997). Hence no crowd between three empty
// corners is missed: its own rays report it.
//
// *Spread.* What few hits show of a triangle is noise. So a triangle's estimate follows from its
// own hits and from those of its parent, which count as some hits more. Children between which the
// hits show no spread share their parent's importance.
//
// Each triangle keeps sqrt(V) in one byte, and none gets less than a part of its share by power
// (ray_densities.h).

#include "radiosity/engine/shooting/strategy.h"

#include <memory>

namespace hemilux {

class Workers;

/// Makes a strategy that learns from a few rays of each patch before the first step, and with
/// `learn` also from rays of the steps.
[[nodiscard]] std::unique_ptr<Strategy> make_visibility_guide(const SolverInput& input,
                                                              const Hemisphere& hemisphere,
                                                              const Workers& workers, bool learn);

/// Returns what it keeps, as Method::bytes: by leaf its byte, and the importance and number of its
/// hits.
[[nodiscard]] double bytes_of_visibility_guide(int depth, double patches);

} // namespace hemilux
