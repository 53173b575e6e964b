#pragma once
// Options that are of one method alone.

#include "app/settings/command_line.h"
#include "app/settings/settings.h"

#include <span>

namespace hemilux {

/// --exact of `matrix`; --one-shot, --ambient and --overshoot of `progressive`.
void add_own_options(CLI::App& app, SolveOptions& options);

/// Throws UsageError where an option was given whose method is not among these.
void check_own_options(const SolveOptions& options, std::span<const Method* const> methods);

/// --plain.
void add_plain_option(CLI::App& app, bool& plain);

/// Throws UsageError where --plain was given and the method has no page, or its page does not
/// support another option that was given.
void check_plain(const SolveSettings& settings);
/// The same where the page takes fewer patches.
void check_plain(const SolveSettings& settings, std::size_t patches);

/// Throws UsageError where --exact would take too long.
void check_exact(const SolveOptions& options, std::size_t patches);

} // namespace hemilux
