#pragma once
// The light of outputs for which it is gathered: pictures, lightmaps and points. It is learned
// until its error is as asked for (light_cache.h), then gathered.

#include "app/gathering/gather_rounds.h"
#include "app/gathering/lightmap_layout.h"
#include "app/rendering/view.h"
#include "app/settings/settings.h"
#include "io/results/points.h"
#include "io/results/statistics.h"
#include "radiosity/answers/images/image.h"
#include "radiosity/answers/views/camera_rays.h"
#include "radiosity/light/cached_light/light_cache.h"
#include "radiosity/light/final_gather/light_at_points.h"
#include "radiosity/paper/solving/solver.h"

#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace hemilux {

struct GatheredLight {
    std::unique_ptr<LightCache> cache; ///< empty: nothing is gathered
    std::vector<Sensor> sensors;       ///< by point of --points
    LightAtPoints points;
    /// Empty: none was asked for, or a signal left no row of it.
    std::optional<Image> picture;
    std::vector<Image> lightmaps;    ///< of the layouts; empty: none was asked for
    std::vector<TargetLevel> levels; ///< of points, lightmaps and the picture, as far as asked for
    /// The relative error, the largest of what is given out [-]; NaN where it is not known.
    double error = std::numeric_limits<double>::quiet_NaN();
};

/// A lightmap to be gathered, of an object of this name or, without one, of all.
struct NamedLayout {
    std::string object;
    LightmapLayout layout;
};

/// Returns whether any output shows gathered light.
[[nodiscard]] bool gathers(const SolveSettings& settings);

/// Returns whether lightmaps show gathered light.
[[nodiscard]] bool gathers_lightmap(const SolveSettings& settings);

/// Takes a picture of which so many rows, from the top, are gathered.
using ShowRows = std::function<void(const Image& picture, int rows)>;

/// Learns the light, and gathers that of points. `camera` is that of pictures; `lightmaps` say
/// where surfaces lie in each. Everything that is referred to must outlive the result. Enters the
/// error into the statistics where only gathered light is given out. With `whole` the light is a
/// part of that, and is as exact as that needs it. `show_rows` is called as the rows of the picture
/// are gathered. A signal leaves what is gathered by then, and the light of the patches elsewhere.
[[nodiscard]] GatheredLight
gather_light(const SolveSettings& settings, const LitScene& scene, const Solution& solution,
             std::span<const NamedPoint> points, const Camera& camera,
             std::span<const NamedLayout> lightmaps, Monitor& monitor, Statistics& statistics,
             const std::optional<WholeLight>& whole = {}, const ShowRows& show_rows = {});

} // namespace hemilux
