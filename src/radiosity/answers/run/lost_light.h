#pragma once
// Light that is lost: a black picture with an error of 0 % does not pass for a result.

#include "radiosity/answers/asked/finding.h"
#include "radiosity/answers/run/sides.h"

#include <optional>

namespace hemilux {

class Mesh;
class Tracer;
struct Solution;

/// Returns a warning where nothing is lit, or more than nine tenths of the light fell on backs or
/// escaped; empty for other runs, and before the first step.
[[nodiscard]] std::optional<Finding> lost_light_finding(const Mesh& mesh, const Tracer& tracer,
                                                        const Solution& solution, Sides sides);

} // namespace hemilux
