#pragma once
// The messages on stderr about a run: lines of text made from its figures.

#include "bvh/quality.h"
#include "io/results/statistics.h"
#include "io/results/tables.h"
#include "radiosity/paper/scene/mesh.h"

#include <optional>
#include <string>

namespace hemilux {

/// Return what was prepared before solving (-v).
[[nodiscard]] std::string mesh_text(const Mesh& mesh);
[[nodiscard]] std::string tracer_text(const BvhQuality& tree, double seconds);
/// Returns the text of one step (-v).
[[nodiscard]] std::string step_text(const StepRow& row);

/// Returns the text of the end of a run: method, rays, time, error, energy.
[[nodiscard]] std::string run_text(const Statistics& statistics);
/// Returns the whole time of a run, and how it was spent.
[[nodiscard]] std::string time_text(const Statistics& statistics);
/// Returns the bytes of the density store and of the process (-v).
[[nodiscard]] std::string memory_text(const Statistics& statistics);
/// Return the errors against a reference.
[[nodiscard]] std::string error_text(const RelativeError& error);
[[nodiscard]] std::string z_scores_text(const ZScores& z);

} // namespace hemilux
