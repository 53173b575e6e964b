#include "radiosity/answers/division/needed_division.h"

#include "parallel/workers.h"
#include "radiosity/answers/division/division.h"
#include "radiosity/engine/solving/time_limit.h"
#include "radiosity/light/division/adaptive_division.h"
#include "radiosity/light/light_error/division_error.h"
#include "radiosity/paper/solution/solve_error.h"

#include <cmath>
#include <limits>

namespace hemilux {

namespace {

/// The time that `info` takes for it [s]: far more than most scenes need.
constexpr double max_seconds = 30;

} // namespace

std::optional<double> error_within_patches(const Mesh& mesh, const Tracer& tracer) {
    if (mesh.patches().empty() || mesh.patches().size() > max_patches_by_default)
        return {};
    try {
        Monitor monitor;
        const TimeLimit limit(monitor.interrupted, max_seconds);
        const Solution rough = rough_solution(mesh, tracer, {.error = .05}, monitor);
        if (monitor.interrupted)
            return std::numeric_limits<double>::quiet_NaN();
        if (rough.steps == 0)
            return {};
        constexpr double resolved = .01;
        const DivisionError found = division_error(mesh, tracer, rough, {.negligible = resolved},
                                                   Workers(0), monitor.interrupted);
        if (monitor.interrupted)
            return std::numeric_limits<double>::quiet_NaN();
        return std::isfinite(found.error) ? std::optional(found.error) : std::nullopt;
    } catch (const SolveError&) {
        return {};
    }
}

} // namespace hemilux
