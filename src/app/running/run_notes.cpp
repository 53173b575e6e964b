#include "app/running/run_notes.h"

#include "radiosity/answers/asked/text.h"

#include <cmath>

namespace hemilux {

void RunNotes::step_done(const StepRecord& record) {
    constexpr double jump = 3; // an estimate that rises by this factor had missed something
    const double error = record.estimated_error;
    rays_ = record.rays;
    ++steps_;
    if (!(error > 0))
        return;
    if (least_ > 0 && error > jump * least_ && error * before_jump_ >= jump_ * least_) {
        before_jump_ = least_;
        jump_ = error;
    }
    if (!(least_ > 0) || error < least_)
        least_ = error;
}

std::vector<std::string> RunNotes::texts(double error, bool interrupted) const {
    std::vector<std::string> notes;
    if (!estimates_error_)
        return {hemicube_note};
    const bool known = std::isfinite(error);
    const bool lost_patience = !known && !interrupted && stop_.patience &&
                               steps_ >= StopRule::steps_of_patience &&
                               rays_ < stop_.rays.value_or(0);
    if (lost_patience)
        notes.push_back("the error is unknown: " + short_counted(rays_, "ray", "rays") +
                        " have found no light that is more than its own error, and after " +
                        duration(*stop_.patience) +
                        " the run has ended; --time or --max-rays lets it go on");
    else if (!known && steps_ > 1)
        notes.push_back(
            "the error is unknown: no light was found that is more than its own error; "
            "more rays (--steps, --time, --max-rays), --method stored-transport or another "
            "lamp may help");
    if (jump_ > 0)
        notes.push_back("the estimated error rose from " + percent(before_jump_) + " to " +
                        percent(jump_) +
                        " between steps: light takes paths that few rays find, and others may not "
                        "have been found yet");
    if (!interrupted && stop_.error && !(error <= *stop_.error)) {
        std::string text = "the run ended before the error of " + percent(*stop_.error) +
                           " was reached, after " + short_counted(rays_, "ray", "rays");
        if (stop_.rays && (1 + least_growth) * double(rays_) >= double(*stop_.rays))
            text += "; --max-rays lets it go on";
        notes.push_back(text);
    }
    return notes;
}

} // namespace hemilux
