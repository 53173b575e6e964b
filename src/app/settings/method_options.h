#pragma once
// Checks options that belong to single methods (MethodOption).

#include "app/settings/settings.h"

#include <functional>
#include <span>
#include <string>
#include <string_view>

namespace hemilux {

/// Throws UsageError where an option is set that none of these methods has, or not with this value,
/// or where their own checks find fault. `patches` is 0 before their number is known.
void check_own_options(const SolveOptions& options, std::span<const Method* const> chosen,
                       std::size_t patches = 0);

/// Sets --rays, --depth, --threshold or an option of the method. Returns false, with nothing
/// changed, for another option or value; throws as MethodOption::set.
[[nodiscard]] bool set_option(const Method& method, std::string_view name, const std::string& value,
                              SolveOptions& options);

/// Throws UsageError where the method refuses the options of the variant.
void check_variant(const MethodVariant& variant, const SolveOptions& options, std::size_t patches);

/// Returns the names of the methods for which `belongs` holds, with `between` between them.
[[nodiscard]] std::string names_of_methods(const std::function<bool(const Method&)>& belongs,
                                           std::string_view between = ", ");

/// Returns the names of the methods that --plain may choose, with commas between them.
[[nodiscard]] std::string methods_with_a_page();

/// Throws UsageError where --plain was given and the method has no page, or its page does not
/// support another option that was given.
void check_plain(const SolveSettings& settings);
/// Throws UsageError if the page takes fewer patches than the scene has.
void check_plain(const SolveSettings& settings, std::size_t patches);

} // namespace hemilux
