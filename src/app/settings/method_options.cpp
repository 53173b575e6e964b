#include "app/settings/method_options.h"

#include "app/settings/exit_code.h"
#include "app/settings/names.h"
#include "radiosity/answers/asked/text.h"
#include "radiosity/engine/solving/method_option.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace hemilux {

std::string names_of_methods(const std::function<bool(const Method&)>& belongs,
                             std::string_view between) {
    std::vector<std::string_view> names;
    for (const Method* const method : methods())
        if (belongs(*method))
            names.push_back(method->name);
    return joined(names, between);
}

std::string methods_with_a_page() {
    return names_of_methods([](const Method& method) { return method.plain != nullptr; });
}

SolveOptions MethodVariant::applied_to(SolveOptions options) const {
    for (const auto& [option, value] : settings)
        if (!set_option(*method, option, value, options))
            throw UsageError("--methods: " + name + ": " + option + " " + value);
    return options;
}

std::string MethodVariant::file_name() const {
    std::string file = name;
    std::ranges::replace_if(
        file, [](char letter) { return letter == ':' || letter == '=' || letter == '/'; }, '-');
    return file;
}

bool set_option(const Method& method, std::string_view name, const std::string& value,
                SolveOptions& options) {
    for (const MethodOption& own : method.own_options())
        if (own.name == name)
            return own.set(options, value);
    const std::optional<double> number = parse_number(value);
    if (!number)
        return false;
    if (name == "--rays" && *number > 0)
        options.rays = *number;
    else if (name == "--threshold" && *number >= 0)
        options.threshold = *number;
    else if (name == "--depth" && *number >= 0 && *number <= 5 && *number == std::floor(*number))
        options.depth = static_cast<int>(*number);
    else
        return false;
    return true;
}

void check_variant(const MethodVariant& variant, const SolveOptions& options, std::size_t patches) {
    try {
        if (variant.method->check)
            variant.method->check(variant.applied_to(options), patches);
    } catch (const std::invalid_argument& error) {
        throw UsageError("--methods: " + variant.name + ": " + error.what());
    }
}

namespace {

/// Returns whether the method has an option of this name that takes this value.
bool takes(const Method& method, const std::string& name, const std::string& value) {
    SolveOptions ignored;
    return std::ranges::any_of(method.own_options(), [&](const MethodOption& own) {
        return own.name == name && own.set(ignored, value);
    });
}

} // namespace

void check_own_options(const SolveOptions& options, std::span<const Method* const> chosen,
                       std::size_t patches) {
    for (const Method* const method : methods())
        for (const MethodOption& own : method->own_options()) {
            const auto takes_it = [&own, value = own.get(options)](const Method& other) {
                return takes(other, own.name, value);
            };
            if (own.is_set(options) &&
                std::ranges::none_of(chosen, [&](const Method* one) { return takes_it(*one); }))
                throw UsageError(own.text(options) + " is for --method " +
                                 names_of_methods(takes_it, " or "));
        }
    for (const Method* const method : chosen)
        try {
            if (method->check)
                method->check(options, patches);
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
    for (const MethodOption& own : settings.method->own_options())
        if (!own.on_page && own.is_set(settings.options))
            throw UsageError("--plain: the page of " + std::string(settings.method->name) +
                             " does not have it; leave out " + own.text(settings.options));
    if (!settings.checkpoint.path.empty() || !settings.checkpoint.resumed.empty())
        throw UsageError("--plain keeps no state; leave out --checkpoint and --resume");
}

void check_plain(const SolveSettings& settings, std::size_t patches) {
    const Method& method = *settings.method;
    if (settings.plain && patches > method.max_plain_patches)
        throw UsageError("--plain --method " + std::string(method.name) +
                         " keeps all pairs of patches: it is for up to " +
                         grouped(method.max_plain_patches) + " patches, not " + grouped(patches));
}

} // namespace hemilux
