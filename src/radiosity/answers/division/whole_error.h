#pragma once
// How far off the light of a run is as a whole: by chance, and because patches have one value or a
// linear function each.

#include "radiosity/answers/asked/finding.h"
#include "radiosity/answers/division/division.h"

#include <cstdint>
#include <optional>

namespace hemilux {

/// Errors relative to the reflected light [-].
struct WholeError {
    double sampling;             ///< estimated_error()
    double sampling_uncertainty; ///< one sigma of it
    DivisionError division = {};
    std::uint64_t rays = 0; ///< to find out the error of the division
    double seconds = 0;     ///< for that [s]

    [[nodiscard]] double error() const;       ///< both together
    [[nodiscard]] double uncertainty() const; ///< one sigma of that
};

/// Returns the error of sampling alone; that of the division is not known.
[[nodiscard]] WholeError error_of_sampling(const Mesh& mesh, const Solution& solution);

/// What is chosen of how the error of the division is found out.
struct WholeErrorChoices {
    bool is_asked_for = false; ///< else small errors need not be resolved
    std::uint64_t seed = 1;
    unsigned threads = 0;
};
/// Finds out what the division leaves, unless `divided` has it. It is not known without a step, and
/// where it was interrupted.
void find_error_of_division(WholeError& error, const Divided& divided, const Solution& solution,
                            const WholeErrorChoices& choices, const StopFlag& interrupted);

/// Returns a warning where a run ended before the whole error that it was asked for; `more_patches`
/// names what makes the division finer.
[[nodiscard]] std::optional<Finding> whole_error_finding(double asked, const WholeError& error,
                                                         const std::string& more_patches);

} // namespace hemilux
