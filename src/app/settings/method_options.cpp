#include "app/settings/method_options.h"

#include "app/settings/exit_code.h"
#include "app/settings/text.h"
#include "radiosity/form_factors/exact_form_factors.h"
#include "radiosity/plain/plain.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <string>

namespace hemilux {

namespace {

struct OwnOption {
    const char* name;
    std::string_view method;
    bool SolveOptions::*plain;
    bool ProgressiveOptions::*progressive;
    const char* help;

    [[nodiscard]] bool& value(SolveOptions& options) const {
        return plain ? options.*plain : options.progressive.*progressive;
    }
};

constexpr std::array<OwnOption, 4> own_options = {{
    {"--exact", "matrix", &SolveOptions::exact, nullptr,
     "matrix: factors without chance where patches see each other fully; for small scenes"},
    {"--one-shot", "progressive", nullptr, &ProgressiveOptions::one_shot,
     "progressive: a step is one shot"},
    {"--ambient", "progressive", nullptr, &ProgressiveOptions::ambient,
     "progressive: show an estimate of the light that is still unshot"},
    {"--overshoot", "progressive", nullptr, &ProgressiveOptions::overshoot,
     "progressive: also shoot what a patch will probably receive later"},
}};

std::string methods_with_a_page() {
    std::string names;
    for (const Method* const method : methods())
        if (method->plain)
            names += (names.empty() ? "" : ", ") + std::string(method->name);
    return names;
}

} // namespace

void add_own_options(CLI::App& app, SolveOptions& options) {
    for (const OwnOption& option : own_options)
        app.add_flag(option.name, option.value(options), option.help)->group("Of one method");
}

void check_own_options(const SolveOptions& options, std::span<const Method* const> methods) {
    SolveOptions given = options;
    for (const OwnOption& option : own_options)
        if (option.value(given) &&
            std::ranges::find(methods, option.method, &Method::name) == methods.end())
            throw UsageError(std::string(option.name) + " is for --method " +
                             std::string(option.method));
}

void add_plain_option(CLI::App& app, bool& plain) {
    app.add_flag("--plain", plain,
                 "by the page of src/radiosity/plain that shows the method: slower, one thread; "
                 "these have one: " +
                     methods_with_a_page())
        ->group("Method");
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
    if (!settings.checkpoint.path.empty() || !settings.checkpoint.resumed.empty())
        throw UsageError("--plain keeps no state; leave out --checkpoint and --resume");
}

void check_plain(const SolveSettings& settings, std::size_t patches) {
    if (settings.plain && settings.method->plain == plain::gathering &&
        patches > plain::most_patches_of_gathering)
        throw UsageError("--plain --method gathering keeps all pairs of patches: it is for up to " +
                         grouped(plain::most_patches_of_gathering) + " patches, not " +
                         grouped(patches));
}

void check_exact(const SolveOptions& options, std::size_t patches) {
    if (options.exact && patches > most_patches_for_exact_factors)
        throw UsageError("--exact is for up to " + grouped(most_patches_for_exact_factors) +
                         " patches, not " + grouped(patches) +
                         "; leave it out and take more --rays");
}

} // namespace hemilux
