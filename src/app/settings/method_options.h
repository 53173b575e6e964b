#pragma once
// Checks options that belong to one method alone.

#include "app/settings/settings.h"

#include <functional>
#include <span>
#include <string>
#include <string_view>

namespace hemilux {

/// Throws UsageError where an option was given whose method (Method::flags, Method::factors) is not
/// among these.
void check_own_options(const SolveOptions& options, std::span<const Method* const> chosen);

/// The names of the methods for which `belongs` holds, with `between` between them.
[[nodiscard]] std::string names_of_methods(const std::function<bool(const Method&)>& belongs,
                                           std::string_view between = ", ");

/// The names of the methods that --plain may choose, with commas between them.
[[nodiscard]] std::string methods_with_a_page();

/// Throws UsageError where --plain was given and the method has no page, or its page does not
/// support another option that was given.
void check_plain(const SolveSettings& settings);
/// Throws UsageError if the page takes fewer patches than the scene has.
void check_plain(const SolveSettings& settings, std::size_t patches);

/// Throws UsageError if exact factors would take too long.
void check_exact(const SolveOptions& options, std::size_t patches);

} // namespace hemilux
