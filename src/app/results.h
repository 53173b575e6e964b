#pragma once
// What a run leaves behind: the files that were asked for.

#include "app/settings.h"
#include "app/write_report.h"
#include "io/statistics.h"
#include "io/tables.h"

#include <span>
#include <string>
#include <vector>

namespace hemilux {

/// Everything that is known after a run; refers to what lives in the caller.
struct Results {
    const Mesh& mesh;
    const Tracer& tracer;
    const Solution& solution;
    const Statistics& statistics;
    std::span<const StepRow> steps;
};

/// All paths that the settings write to.
[[nodiscard]] std::vector<std::string> output_paths(const SolveSettings& settings);

/// Throws UsageError where nothing would be written or one file is named twice, OutputError where a
/// file cannot be made.
void check_outputs(const SolveSettings& settings);

/// Writes all outputs.
[[nodiscard]] WriteReport write_results(const SolveSettings& settings, const Results& results);

} // namespace hemilux
