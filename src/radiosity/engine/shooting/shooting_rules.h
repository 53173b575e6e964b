#pragma once
// These rules say how the power of a patch becomes rays. A strategy's file chooses them; the engine
// knows no more of it.

#include "radiosity/engine/densities/cell_directions.h"
#include "radiosity/paper/solving/solve_options.h"

namespace hemilux {

/// The points where rays into a cell start; those into the whole hemisphere start anywhere.
enum class RayOrigins {
    anywhere, ///< uniform over the patch, or over the part that a private cell belongs to
    centre,   ///< middle of that: biased (docs/paper/decisions.md, D2)
};

/// The number of rays that a patch shoots in a bounce.
enum class RaysPerPatch {
    by_power,    ///< rays in proportion to its unshot power, made whole by systematic sampling
    same_number, ///< N_hemi each, and N_tr rounded: what is due less than half a ray is lost (D10)
};

struct ShootingRules {
    CellArea area = CellArea::projected_solid_angle;
    RayOrigins origins = RayOrigins::anywhere;
    RaysPerPatch rays = RaysPerPatch::by_power;
};

/// Returns the rules of the paper as printed with --literal, otherwise the unbiased ones.
[[nodiscard]] inline ShootingRules shooting_rules(const SolveOptions& options) {
    if (!options.literal)
        return {};
    return {.area = CellArea::solid_angle,
            .origins = RayOrigins::centre,
            .rays = RaysPerPatch::same_number};
}

} // namespace hemilux
