#pragma once
// What is said on stderr about a run: lines of text made from its figures.

#include "bvh/quality.h"
#include "io/results/statistics.h"
#include "io/results/tables.h"
#include "radiosity/scene/mesh.h"

#include <optional>
#include <string>

namespace hemilux {

/// What was prepared before solving (-v).
[[nodiscard]] std::string mesh_text(const Mesh& mesh);
[[nodiscard]] std::string tracer_text(const std::optional<BvhQuality>& tree, double seconds);
/// One step (-v).
[[nodiscard]] std::string step_text(const StepRow& row);

/// The end of a run: method, rays, time, error, energy.
[[nodiscard]] std::string run_text(const Statistics& statistics);
/// Bytes of the density store and of the process (-v).
[[nodiscard]] std::string memory_text(const Statistics& statistics);
/// Against a reference.
[[nodiscard]] std::string error_text(const RelativeError& error);
[[nodiscard]] std::string z_scores_text(const ZScores& z);

} // namespace hemilux
