#pragma once
// What a report says of a run, or of several, besides the patches, as JSON. What is not UTF-8 is
// replaced; NaN is null.

#include "app/report/error_charts.h"
#include "app/report/half_light.h"
#include "io/results/statistics.h"
#include "io/results/tables.h"
#include "radiosity/answers/views/camera_rays.h"
#include "radiosity/light/lamps/lamp_layers.h"

#include <optional>
#include <span>
#include <string>

namespace hemilux {

class Mesh;
class DensityMap;
class Hemisphere;

/// The counts by which a method divided the hemispheres of all patches.
struct ReportDensities {
    const Hemisphere& hemisphere;
    const DensityMap& map;
    double threshold; ///< is_divided()
};

/// The light that a method had found after some step.
struct LightOfStep {
    std::uint32_t step = 0;
    std::vector<std::uint16_t> halves; ///< halves_of()
};

/// The content of a report; it refers to what lives in the caller.
struct ReportContent {
    const Mesh& mesh;
    const Solution& solution;
    const Statistics& statistics;
    std::span<const StepRow> steps;
    std::span<const std::string> warnings;
    std::string scene;                          ///< its path
    std::string command;                        ///< the command line
    Camera camera;                              ///< the first view
    std::optional<double> exposure;             ///< empty: the page chooses one
    std::span<const LightOfStep> lights;        ///< light after steps before the last, ascending
    double unit = 1;                            ///< unit of these lights [W/m2]
    const LampPatches& lamps;                   ///< none where they are not asked for
    const ReportDensities* densities = nullptr; ///< densities of methods that have them
};

/// Returns the unit of the light of lamps [W/m2].
[[nodiscard]] double unit_of_lamps(const ReportContent& content);

/// Returns the JSON. The keys are scene, command, version, machine, centre, materials, groups,
/// camera, exposure, warnings, statistics (as of to_json), steps, charts (name and svg), unit,
/// lit_steps (those before the last with a light) and, where there are such, lamps (their names),
/// lamp_unit (of their light) and threshold (of densities).
[[nodiscard]] std::string run_json(const ReportContent& content);

/// A method of a comparison.
struct ComparedMethod {
    std::string name, label;
    std::span<const LightOfStep> lights; ///< light of its first run, steps ascending
};

/// The content of a report of a comparison; it refers to what lives in the caller.
struct ComparisonContent {
    const Mesh& mesh;
    std::span<const Vec3> reference; ///< radiosity [W/m2]
    double unit;                     ///< unit of LightOfStep [W/m2]
    std::vector<ComparedMethod> methods;
    std::span<const StepRow> rows;                 ///< steps of all runs, as the CSV has them
    std::vector<PageChart> charts;                 ///< curves of the errors that are known
    std::vector<std::vector<std::string>> summary; ///< table with a row of headings
    std::vector<std::pair<std::string, std::string>>
        facts; ///< name and text of what it all rests on
    std::span<const std::string> warnings;
    std::string scene, command; ///< path; command line
    Camera camera;
    std::optional<double> exposure;
};

/// Returns the JSON. It has the keys scene to warnings of run_json(), and unit, methods, summary,
/// facts, columns, rows and charts. A method has name, label and steps, the numbers of those with a
/// light. Columns and rows are those of the CSV, where an empty field is null.
[[nodiscard]] std::string comparison_json(const ComparisonContent& content);

} // namespace hemilux
