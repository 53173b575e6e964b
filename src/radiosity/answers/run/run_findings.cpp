#include "radiosity/answers/run/run_findings.h"

#include "radiosity/answers/asked/text.h"

#include <cmath>
#include <cstdint>
#include <string>
#include <utility>

namespace hemilux {
namespace {

Finding warning(std::string text, std::string advice = {}) {
    return {Finding::Kind::warning, std::move(text), std::move(advice)};
}

/// The largest rise of an estimate above the least one before it; zeros where there is none.
struct Jump {
    double from = 0, to = 0;
};
Jump largest_jump(std::span<const StepRecord> steps) {
    constexpr double jump = 3; // an estimate that rises by this factor had missed something
    Jump found;
    double least = 0; // none is known
    for (const StepRecord& step : steps) {
        const double error = step.estimated_error;
        if (!(error > 0))
            continue;
        if (least > 0 && error > jump * least && error * found.from >= found.to * least)
            found = {least, error};
        if (!(least > 0) || error < least)
            least = error;
    }
    return found;
}

} // namespace

Finding hemicube_finding() {
    return warning("the error of hemicube factors is not estimated: what lies between pixels, and "
                   "that the centre stands for the patch, is not random",
                   "another N, or --factors rays, shows how large it is");
}

Findings run_findings(std::span<const StepRecord> steps, const RunEnd& end) {
    if (!end.estimates_error)
        return {hemicube_finding()};
    Findings findings;
    const StopRule& stop = end.stop;
    const std::uint64_t rays = steps.empty() ? 0 : steps.back().rays;
    const bool known = std::isfinite(end.error);
    const bool lost_patience = !known && !end.interrupted && stop.patience &&
                               steps.size() >= StopRule::steps_of_patience &&
                               rays < stop.rays.value_or(0);
    if (lost_patience)
        findings.push_back(
            warning("the error is unknown: " + short_counted(rays, "ray", "rays") +
                        " have found no light that is more than its own error, and after " +
                        duration(*stop.patience) + " the run has ended",
                    "--time or --max-rays lets it go on"));
    else if (!known && steps.size() > 1)
        findings.push_back(
            warning("the error is unknown: no light was found that is more than its own error",
                    "more rays (--steps, --time, --max-rays), --method stored-transport or another "
                    "lamp may help"));
    if (const Jump jump = largest_jump(steps); jump.to > 0)
        findings.push_back(warning(
            "the estimated error rose from " + percent(jump.from) + " to " + percent(jump.to) +
            " between steps: light takes paths that few rays find, and others may not "
            "have been found yet"));
    if (!end.interrupted && stop.error && !(end.error <= *stop.error)) {
        const bool by_rays = stop.rays && (1 + least_growth) * double(rays) >= double(*stop.rays);
        findings.push_back(warning("the run ended before the error of " + percent(*stop.error) +
                                       " was reached, after " + short_counted(rays, "ray", "rays"),
                                   by_rays ? "--max-rays lets it go on" : ""));
    }
    return findings;
}

} // namespace hemilux
