#pragma once
// A run of one method, as the program's `solve` does it on patches that are not divided further.

#include "app/settings/settings.h"
#include "python/arrays.h"
#include "python/scene.h"
#include "radiosity/answers/run/run.h"

#include <map>
#include <string>
#include <vector>

namespace hemilux {

/// Numbers of a run that Python gives; empty ones are those of the program.
struct RunNumbers {
    std::optional<double> error, seconds, rays;
    std::optional<std::uint32_t> steps;
    std::optional<std::uint64_t> max_rays;
    int depth = SolveOptions{}.depth;
    double threshold = SolveOptions{}.threshold;
    bool literal = false, keep_all = false;
    std::uint64_t seed = 1;
    unsigned threads = 0;
    std::map<std::string, std::string> own; ///< options of the method, as "--guide", and values
};

/// Returns the method of a name. Throws UsageError, which names those there are.
[[nodiscard]] const Method& method_named(const std::string& name);

/// Checks the numbers. Throws UsageError.
[[nodiscard]] SolveSettings settings_of(const Method& method, const RunNumbers& numbers);

struct RunResult {
    Run run;
    std::vector<double> true_errors; ///< by step; empty without a reference
    Findings findings;               ///< what there is to say of it
};

/// Runs a method until a rule or the monitor ends it. Where the monitor is interrupted the result
/// is that of the steps before. Throws InputError where the scene cannot be solved.
[[nodiscard]] RunResult run_method(const PythonMesh& mesh, const SolveSettings& settings,
                                   std::span<const Vec3> reference, Monitor& monitor);

} // namespace hemilux
