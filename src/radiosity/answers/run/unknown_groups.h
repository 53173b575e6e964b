#pragma once
// The groups of a scene whose light a solution does not know, though it knows that of the whole.

#include "radiosity/answers/asked/finding.h"

#include <optional>

namespace hemilux {

class Mesh;
struct Solution;

/// Returns a warning that names the groups whose light has a standard error of more than a quarter
/// of it, or of which none was found; empty where there are none, or no groups at all.
[[nodiscard]] std::optional<Finding> unknown_groups_finding(const Mesh& mesh,
                                                            const Solution& solution);

} // namespace hemilux
