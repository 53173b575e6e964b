#pragma once
// The groups of a scene whose light a solution does not know, though it knows that of the whole.

#include <string>

namespace hemilux {

class Mesh;
struct Solution;

/// Returns a warning that names the groups whose light has a standard error of more than a quarter
/// of it, or of which none was found; empty where there are none, or no groups at all.
[[nodiscard]] std::string unknown_groups_text(const Mesh& mesh, const Solution& solution);

} // namespace hemilux
