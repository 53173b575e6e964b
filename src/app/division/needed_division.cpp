#include "app/division/needed_division.h"

#include "app/division/default_division.h"
#include "parallel/workers.h"
#include "radiosity/light/division/adaptive_division.h"
#include "radiosity/light/light_error/division_error.h"
#include "radiosity/paper/solution/solve_error.h"

#include <cmath>

namespace hemilux {

std::optional<double> error_within_patches(const Mesh& mesh, const Tracer& tracer) {
    if (mesh.patches().empty() || mesh.patches().size() > max_patches_by_default)
        return {};
    try {
        Monitor monitor;
        const Solution rough = rough_solution(mesh, tracer, {.error = .05}, monitor);
        if (rough.steps == 0)
            return {};
        constexpr double resolved = .01;
        const DivisionError found = division_error(mesh, tracer, rough, {.negligible = resolved},
                                                   Workers(0), monitor.interrupted);
        return std::isfinite(found.error) ? std::optional(found.error) : std::nullopt;
    } catch (const SolveError&) {
        return {};
    }
}

} // namespace hemilux
