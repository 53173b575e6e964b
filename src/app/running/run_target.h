#pragma once
// --for: what is to be right.

#include "app/settings/settings.h"
#include "io/results/points.h"
#include "radiosity/answers/run/problem.h"

#include <string>
#include <vector>

namespace hemilux {

/// Throws UsageError for a camera that is not given, and where --for is combined with a method or
/// option that does not take it.
void check_target(const SolveSettings& settings);

/// The points of one file that --for names.
struct PointsOfFile {
    std::string path;
    std::vector<NamedPoint> points;
};
/// Reads these files. Throws InputError.
[[nodiscard]] std::vector<PointsOfFile> points_of_target(const TargetSettings& target);

/// Aims the problem at the target; does nothing where --for is not given. Throws UsageError for a
/// group that the scene does not have. Throws InputError for points that lie on no face, and where
/// nothing of the target reflects.
void aim_at(Problem& problem, const SolveSettings& settings,
            const std::vector<PointsOfFile>& points);

} // namespace hemilux
