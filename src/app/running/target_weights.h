#pragma once
// --for: what is to be right, as weights of patches.

#include "app/settings/settings.h"

#include <string>
#include <vector>

namespace hemilux {

/// Throws UsageError for a camera that is not given, InputError where --for goes with another
/// method or option that does not take it.
void check_target(const SolveSettings& settings);

/// By patch (Solution::weight); empty where --for is not given. Throws InputError for a group that
/// the scene does not have, for points that lie on no face, and where nothing of the target
/// reflects.
[[nodiscard]] std::vector<double> target_weights(const SolveSettings& settings, const Mesh& mesh,
                                                 const Tracer& tracer);

} // namespace hemilux
