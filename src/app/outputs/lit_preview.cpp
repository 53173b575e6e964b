#include "app/outputs/lit_preview.h"

#include "app/gathering/lit_file_output.h"
#include "app/outputs/preview.h"
#include "parallel/workers.h"
#include "radiosity/answers/lightmaps/lightmap_gather.h"
#include "radiosity/light/cached_light/surface_light.h"

#include <exception>
#include <utility>
#include <vector>

namespace hemilux {
namespace {

/// Gathering so many texels takes longer than to show them first.
constexpr double many_texels = 100'000;

/// Returns a lightmap with the light of the patches.
Image rough_lightmap(const SolveSettings& settings, const LitScene& scene, const Solution& solution,
                     const LightmapLayout& layout) {
    const Workers workers(settings.options.threads);
    std::vector<PlacedTriangle> triangles = layout.triangles;
    show_brighter_sides(scene.mesh, solution, triangles);
    const TexelMap texels = texels_of(layout, std::move(triangles), scene.mesh, scene.tracer);
    GatheredLightmap rough(texels);
    complete_by_patches(rough, scene.mesh, SurfaceLight(scene.mesh, PatchLight(solution)), texels,
                        settings.bake, workers);
    fill_texels(rough, texels, layout.margin);
    return std::move(rough.image);
}

} // namespace

/// A file that cannot be written is reported at the end, when it is written for good.
void preview_lit_file(const SolveSettings& settings, const LitScene& scene,
                      const Solution& solution, const FileLightmap& file,
                      std::span<const NamedLayout> layouts, const std::atomic<bool>& interrupted) {
    if (!file.source || !shows_previews(settings) || interrupted)
        return;
    double texels = 0;
    for (const NamedLayout& named : layouts)
        texels += double(named.layout.size) * named.layout.size;
    if (texels < many_texels)
        return;
    std::vector<Image> lightmaps;
    for (const NamedLayout& named : layouts)
        if (!named.layout.triangles.empty())
            lightmaps.push_back(rough_lightmap(settings, scene, solution, named.layout));
    if (lightmaps.size() < file.parts.size())
        return;
    try {
        for (const Output& output : settings.outputs)
            if (output.kind == OutputKind::glb)
                write_lit_file(settings, output.path, scene.mesh, file, lightmaps);
    } catch (const std::exception&) {
    }
}

} // namespace hemilux
