#pragma once
// Options that change nothing in a run: a script may carry them along, so each gets a warning.

#include "app/settings/settings.h"

#include <span>
#include <string>
#include <string_view>

namespace hemilux {

struct OptionUse {
    std::string_view name;
    bool is_used;     ///< this run reads it
    std::string what; ///< it is for
};

/// Warns of each of these that is given and not used.
void warn_of_unused(std::span<const GivenOption> given, std::span<const OptionUse> uses,
                    Verbosity verbosity);
void warn_of_unused(const SolveSettings& settings);
void warn_of_unused(const CompareSettings& settings);

} // namespace hemilux
