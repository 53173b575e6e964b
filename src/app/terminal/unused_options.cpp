#include "app/terminal/unused_options.h"

#include "app/settings/method_options.h"
#include "app/terminal/log.h"

#include <algorithm>
#include <functional>
#include <vector>

namespace hemilux {
namespace {

bool keeps_hemispheres(const Method& method) { return method.role == Role::paper; }

/// Returns the uses of the options of methods. `layers` says that there are pictures with a layer
/// of densities.
std::vector<OptionUse> uses_of_methods(std::span<const Method* const> chosen, bool layers) {
    const auto use = [&](std::string_view name, const std::function<bool(const Method&)>& takes,
                         bool other) {
        return OptionUse{
            name,
            other || std::ranges::any_of(chosen, [&](const Method* one) { return takes(*one); }),
            "--method " + names_of_methods(takes, " or ")};
    };
    return {use("--literal", &Method::has_literal, false),
            use("--depth", &Method::has_depth, layers),
            use("--threshold", keeps_hemispheres, layers)};
}

} // namespace

void warn_of_unused(std::span<const GivenOption> given, std::span<const OptionUse> uses,
                    Verbosity verbosity) {
    for (const auto& [name, is_used, what] : uses)
        if (!is_used && std::ranges::find(given, name, &GivenOption::name) != given.end())
            log_line(verbosity, Verbosity::normal,
                     "warning: " + std::string(name) + " changes nothing in this run; it is for " +
                         what);
}

void warn_of_unused(const SolveSettings& settings) {
    const auto has = [&](auto... kinds) {
        return std::ranges::any_of(settings.outputs, [&](const Output& output) {
            return ((output.kind == kinds) || ...);
        });
    };
    const bool pictures = std::ranges::any_of(settings.outputs, is_picture, &Output::kind);
    const bool meshes = has(OutputKind::glb, OutputKind::ply);
    const bool page = !settings.report.empty();
    const bool views = pictures || page || !settings.error_map.empty() || settings.target.camera;
    std::vector<OptionUse> uses = uses_of_methods({&settings.method, 1}, has(OutputKind::exr));
    const std::vector<OptionUse> others{
        {"--detail", !settings.reference.empty(), "--reference"},
        {"--bake", meshes, ".glb and .ply files"},
        {"--ply-colours", has(OutputKind::ply), ".ply files"},
        {"--camera", views, "pictures, --report and --for camera"},
        {"--size", views, "pictures, --report and --for camera"},
        {"--exposure", pictures || meshes || page, "pictures, meshes and --report"},
        {"--tone", pictures || meshes, "pictures and meshes"},
        {"--gather",
         ((pictures || settings.writes_lightmap()) && settings.gather_pictures) ||
             !settings.points.path.empty() || (meshes && settings.bake == Bake::indirect),
         "pictures without --no-gather, --lightmap, --points and --bake indirect"},
        {"--no-gather", pictures || settings.writes_lightmap(), "pictures and --lightmap"}};
    uses.insert(uses.end(), others.begin(), others.end());
    warn_of_unused(settings.given, uses, settings.verbosity);
}

void warn_of_unused(const CompareSettings& settings) {
    std::vector<const Method*> chosen;
    for (const MethodVariant& variant : settings.variants)
        chosen.push_back(variant.method);
    warn_of_unused(settings.given, uses_of_methods(chosen, false), settings.verbosity);
}

} // namespace hemilux
