#include "app/settings/method_options.h"

#include "app/settings/exit_code.h"
#include "app/settings/text.h"
#include "radiosity/form_factors/exact_form_factors.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace hemilux {

std::string names_of_methods(const std::function<bool(const Method&)>& belongs,
                             std::string_view between) {
    std::string names;
    for (const Method* const method : methods())
        if (belongs(*method))
            names.append(names.empty() ? "" : between).append(method->name);
    return names;
}

std::string methods_with_a_page() {
    return names_of_methods([](const Method& method) { return method.plain != nullptr; });
}

namespace {

std::string name_of(FactorKind kind) {
    return kind == FactorKind::exact
               ? "--exact"
               : "--factors " + std::string(factor_names.at(static_cast<std::size_t>(kind)));
}

bool takes(const Method& method, FactorKind kind) {
    return std::ranges::find(method.factors, kind) != method.factors.end();
}

void check_factors(FactorKind kind, std::span<const Method* const> chosen) {
    if (kind == FactorKind::rays ||
        std::ranges::any_of(chosen, [kind](const Method* method) { return takes(*method, kind); }))
        return;
    throw UsageError(
        name_of(kind) + " is for --method " +
        names_of_methods([kind](const Method& method) { return takes(method, kind); }, " or "));
}

/// Flags or numbers that were given are taken by a method that was chosen.
template <auto own>
void check_taken(SolveOptions options, std::span<const Method* const> chosen) {
    SolveOptions defaults;
    for (const Method* const method : methods())
        for (const auto& option : method->*own) {
            const auto takes = [&option](const Method& other) {
                return std::ranges::find(other.*own, option.name, [](const auto& its) {
                           return its.name;
                       }) != (other.*own).end();
            };
            if (option.value(options) != option.value(defaults) &&
                std::ranges::none_of(chosen, [&](const Method* one) { return takes(*one); }))
                throw UsageError(std::string(option.name) + " is for --method " +
                                 names_of_methods(takes, " or "));
        }
}

} // namespace

void check_own_options(const SolveOptions& options, std::span<const Method* const> chosen) {
    check_factors(options.factors.kind, chosen);
    check_taken<&Method::flags>(options, chosen);
    check_taken<&Method::numbers>(options, chosen);
    for (const Method* const method : chosen)
        try {
            if (method->check)
                method->check(options);
        } catch (const std::invalid_argument& error) {
            throw UsageError(error.what());
        }
}

void check_plain(const SolveSettings& settings) {
    if (!settings.plain)
        return;
    if (!settings.method->plain)
        throw UsageError("--plain: --method " + std::string(settings.method->name) +
                         " has no page; these have one: " + methods_with_a_page());
    if (settings.options.guide != Guide::density)
        throw UsageError("--plain is guided by densities alone; leave out --guide " +
                         std::string(guide_names.at(std::size_t(settings.options.guide))));
    if (settings.options.one_shot)
        throw UsageError("--plain shows whole solutions; leave out --one-shot");
    if (!settings.checkpoint.path.empty() || !settings.checkpoint.resumed.empty())
        throw UsageError("--plain keeps no state; leave out --checkpoint and --resume");
}

void check_plain(const SolveSettings& settings, std::size_t patches) {
    const Method& method = *settings.method;
    if (settings.plain && patches > method.most_plain_patches)
        throw UsageError("--plain --method " + std::string(method.name) +
                         " keeps all pairs of patches: it is for up to " +
                         grouped(method.most_plain_patches) + " patches, not " + grouped(patches));
}

void check_exact(const SolveOptions& options, std::size_t patches) {
    if (options.factors.kind == FactorKind::exact && patches > most_patches_for_exact_factors)
        throw UsageError("--exact is for up to " + grouped(most_patches_for_exact_factors) +
                         " patches, not " + grouped(patches) +
                         "; leave it out and take more --rays");
}

} // namespace hemilux
