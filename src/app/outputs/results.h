#pragma once
// The files that a run leaves behind, as they were asked for.

#include "app/gathering/gathered_light.h"
#include "app/gathering/lightmap_layout.h"
#include "app/lamps/lamp_light.h"
#include "app/rendering/view.h"
#include "app/report/run_data.h"
#include "app/running/write_report.h"
#include "app/settings/settings.h"
#include "io/results/points.h"
#include "io/results/statistics.h"
#include "io/results/tables.h"
#include "parallel/stopwatch.h"
#include "radiosity/paper/solving/solver.h"

#include <span>
#include <string>
#include <vector>

namespace hemilux {

/// Everything that is known after a run; it refers to what lives in the caller.
struct Results {
    const Mesh& mesh;
    const Tracer& tracer;
    const Solution& solution;
    const SolveOptions& options; ///< of the run: seed, threads, how hemispheres are divided
    Statistics& statistics;      ///< all but the seconds of outputs
    std::span<const StepRow> steps;
    std::span<const LightOfStep> lights; ///< light after some of the steps, for a page
    double unit;                         ///< unit of these lights [W/m2]
    std::span<const NamedPoint> points;
    const GatheredLight& gathered;
    const LampLight& lamps;                ///< none where they are not asked for
    const FileLightmap& file_lightmap;     ///< of `bake`
    std::span<const std::string> warnings; ///< of reading and of the run
    Monitor& monitor; ///< once it is interrupted, densities and what takes long are left out

    [[nodiscard]] LitScene lit() const {
        return {mesh, tracer, solution.radiosity, options.threads};
    }
};

/// Returns whether anything that is written or said holds the statistics of the run.
[[nodiscard]] bool shows_statistics(const SolveSettings& settings);

/// Writes all outputs, the statistics last: with the seconds that the others took, and those of the
/// run since it was `started`.
[[nodiscard]] WriteReport write_results(const SolveSettings& settings, const Results& results,
                                        const Stopwatch& started);

} // namespace hemilux
