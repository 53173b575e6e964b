#pragma once
// What a report says of a run besides its patches, as JSON.

#include "io/pictures/camera.h"
#include "io/results/statistics.h"
#include "io/results/tables.h"

#include <optional>
#include <span>
#include <string>

namespace hemilux {

class Mesh;

/// What a report is made of; refers to what lives in the caller.
struct ReportContent {
    const Mesh& mesh;
    const Solution& solution;
    const Statistics& statistics;
    std::span<const StepRow> steps;
    std::span<const std::string> warnings;
    std::string scene;              ///< its path
    std::string command;            ///< the command line
    Camera camera;                  ///< the first view
    std::optional<double> exposure; ///< empty: the page chooses one
};

/// The keys are scene, command, version, centre, materials, groups, camera, exposure, statistics
/// (as of to_json), steps and warnings. Every `<` is written as \u003c, so that no name ends the
/// element of the page that holds the text. What is not UTF-8 is replaced; NaN is null.
[[nodiscard]] std::string run_json(const ReportContent& content);

} // namespace hemilux
