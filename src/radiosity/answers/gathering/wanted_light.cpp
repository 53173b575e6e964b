#include "radiosity/answers/gathering/wanted_light.h"

#include "radiosity/answers/asked/text.h"

#include <algorithm>
#include <cmath>

namespace hemilux {
namespace {

/// Warns of objects of which no texel was judged: coordinates that fill little of a small lightmap
/// leave none within their triangles.
void warn_of_unknown_errors(const GatheredLight& light, Watcher& watcher) {
    std::uint64_t unknown = 0;
    for (const auto& [lightmap, error, work] : light.lightmaps)
        unknown +=
            !lightmap.object.empty() && lightmap.is_complete() && !std::isfinite(error.bound);
    if (unknown > 0)
        watcher.tell(Finding::Kind::warning,
                     "the error of " + counted(unknown, "object", "objects") +
                         " is not known, as their lightmaps have too few texels; a larger "
                         "--lightmap or --lightmap-uv new has more");
}

} // namespace

AnswerError GatheredLight::largest_error() const {
    AnswerError largest;
    const auto add = [&](const AnswerError& error) {
        if (!std::isnan(error.whole) && (std::isnan(largest.whole) || error.bound > largest.bound))
            largest = error;
    };
    if (points)
        add(points->error);
    for (const Answer<LightOfLightmap>& lightmap : lightmaps)
        add(lightmap.error);
    if (picture)
        add(picture->error);
    return largest;
}

Work GatheredLight::work() const {
    Work work;
    if (points)
        work += points->work;
    for (const Answer<LightOfLightmap>& lightmap : lightmaps)
        work += lightmap.work;
    if (picture)
        work += picture->work;
    return work;
}

GatheredLight gather(Gatherer& gatherer, const WantedLight& wanted, const GatheredLight* whole,
                     const ErrorOfPart& part) {
    GatheredLight light{.was_wanted = true};
    const auto whole_of = [&](const TargetLevel& level) -> std::optional<WholeLight> {
        return WholeLight{level, part.error, part.own_error};
    };
    if (!wanted.points.empty())
        light.points = gather_points(gatherer, wanted.points, wanted.error_of_patches,
                                     whole && whole->points ? whole_of(whole->points->value.level)
                                                            : std::nullopt);
    bool has_ended = false;
    for (const auto& [object, layout] : wanted.lightmaps) {
        if (layout.triangles.empty())
            continue;
        const std::size_t number = light.lightmaps.size();
        light.lightmaps.push_back(
            gather_lightmap(gatherer, {object, layout, wanted.bake, number},
                            whole && number < whole->lightmaps.size()
                                ? whole_of(whole->lightmaps[number].value.level)
                                : std::nullopt));
        const LightOfLightmap& found = light.lightmaps.back().value;
        if (!found.is_complete() && !has_ended)
            gatherer.watcher().tell(Finding::Kind::ended_early, end_text(found));
        has_ended |= !found.is_complete();
    }
    warn_of_unknown_errors(light, gatherer.watcher());
    if (wanted.picture)
        light.picture = gather_picture(
            gatherer, *wanted.picture,
            whole && whole->picture ? whole_of(whole->picture->value.level) : std::nullopt);
    return light;
}

} // namespace hemilux
