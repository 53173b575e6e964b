#pragma once
// The folder that a comparison leaves behind.

#include "app/commands/compare_run.h"
#include "app/commands/compare_summary.h"
#include "app/running/write_report.h"

#include <span>
#include <string>
#include <vector>

namespace hemilux {

/// Makes the folder where it is not there. Throws OutputError where nothing can be written to it.
void make_folder(const std::string& folder);

/// Checks and returns the files of the run. Throws UsageError where a file that is read would be
/// replaced, OutputError where a file cannot be made, InputError where one cannot be read.
[[nodiscard]] RunFiles check_files(const CompareSettings& settings);

/// Writes error.csv, error.svg and reference.png, and from the first run of each method METHOD.png
/// with METHOD_difference.png. Writes the page of --report, too, with `warnings`. All pictures have
/// one camera and one exposure, all differences one scale.
[[nodiscard]] WriteReport write_comparison(const Comparison& comparison,
                                           std::span<const MethodRuns> results,
                                           std::span<const MethodSummary> summaries,
                                           std::span<const std::string> warnings);

/// Returns the estimated error of the reference itself, relative [-]; NaN where it is not known.
[[nodiscard]] double own_error(const Mesh& mesh, const Reference& reference);

/// Writes reference.csv, for use with --reference.
[[nodiscard]] WriteReport write_reference(const Comparison& comparison);

} // namespace hemilux
