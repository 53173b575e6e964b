#pragma once
// The notes on how a run ended that a user must know besides its numbers: that an error is not
// known, that it was not reached, that the estimate has jumped.

#include "radiosity/engine/solving/run.h"

#include <string>
#include <vector>

namespace hemilux {

/// The note on factors by hemicubes.
inline constexpr const char* hemicube_note =
    "the error of hemicube factors is not estimated: what lies between pixels, and that the centre "
    "stands for the patch, is not random; another N, or --factors rays, shows how large it is";

class RunNotes {
  public:
    explicit RunNotes(const StopRule& stop, bool estimates_error = true)
        : stop_(stop), estimates_error_(estimates_error) {}

    void step_done(const StepRecord& record);

    /// Returns a sentence for each note, for stderr; none where there is nothing to say. `error` is
    /// the estimated one of the solution, relative [-], NaN where it is not known.
    [[nodiscard]] std::vector<std::string> texts(double error, bool interrupted) const;

  private:
    StopRule stop_;
    bool estimates_error_;              ///< MethodWork::estimates_error
    double least_ = 0;                  ///< estimated error so far; 0: none is known
    double before_jump_ = 0, jump_ = 0; ///< the largest jump: from, to
    std::uint64_t rays_ = 0;
    std::uint32_t steps_ = 0;
};

} // namespace hemilux
