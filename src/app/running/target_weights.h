#pragma once
// --for: what is to be right, as weights of patches.

#include "app/settings/settings.h"
#include "io/results/points.h"

#include <span>
#include <string>
#include <vector>

namespace hemilux {

/// Throws UsageError for a camera that is not given, and where --for is combined with a method or
/// option that does not take it.
void check_target(const SolveSettings& settings);

/// The points of one file that --for names.
struct TargetPoints {
    std::string path;
    std::vector<NamedPoint> points;
};
/// Reads these files. Throws InputError.
[[nodiscard]] std::vector<TargetPoints> points_of_target(const TargetSettings& target);

/// Returns the weights by patch (Solution::weight); empty where --for is not given. Throws
/// UsageError for a group that the scene does not have. Throws InputError for points that lie on no
/// face, and where nothing of the target reflects.
[[nodiscard]] std::vector<double> target_weights(const SolveSettings& settings,
                                                 std::span<const TargetPoints> points,
                                                 const Mesh& mesh, const Tracer& tracer);

} // namespace hemilux
