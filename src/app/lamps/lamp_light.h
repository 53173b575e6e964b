#pragma once
// --layers: the light of each lamp by itself, of all that outputs hold.

#include "app/gathering/gathered_light.h"
#include "app/memory/memory.h"
#include "app/rendering/view.h"
#include "app/settings/settings.h"
#include "io/results/points.h"
#include "io/results/statistics.h"
#include "radiosity/answers/images/image.h"
#include "radiosity/answers/views/camera_rays.h"
#include "radiosity/engine/solving/relighting.h"
#include "radiosity/light/lamps/lamp_layers.h"
#include "radiosity/paper/solving/solver.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace hemilux {

/// Throws UsageError where --layers is asked for and the run cannot give them.
void check_layers(const SolveSettings& settings);
/// Throws UsageError for a scene of too many lamps, and InputError for one without any. Adds to the
/// need of a run what its layers hold; throws std::runtime_error where that is more than --memory.
void check_layers(const SolveSettings& settings, const Mesh& mesh, const LayerSize& size,
                  MemoryNeed& need);

/// The light of each lamp; none where --layers is not asked for. The sum over layers is the light
/// of the run, by patch, point and pixel.
struct LampLight : LampPatches {
    std::vector<std::vector<PointLight>> points; ///< by layer and point of --points
    std::vector<Image> pictures;                 ///< by layer; empty where none is gathered
    std::vector<std::vector<Image>> lightmaps;   ///< by layout and layer, where they are gathered
};

/// What the light of a run was found from; it refers to what lives in the caller.
struct LitRun {
    LitScene scene;
    const Solver& solver;
    const Solution& solution;
    const GatheredLight& gathered;
    std::span<const NamedPoint> points;
    Camera camera;                          ///< of pictures
    std::span<const NamedLayout> lightmaps; ///< where surfaces lie in them
};

/// Finds the layers, where they are asked for, by the rays of the run. Enters their errors and what
/// they took into the statistics. Each is gathered as far as its share of the light matters. There
/// are none where a signal came first, which is said.
[[nodiscard]] LampLight find_lamp_light(const SolveSettings& settings, const LitRun& run,
                                        Monitor& monitor, Statistics& statistics);

/// Returns the solution of a layer.
[[nodiscard]] Solution solution_of(const Solution& whole, const Relit& layer);

/// Makes the images of layers add up to that of the whole.
void add_up(const LampShares& shares, const Image& whole, std::span<Image> parts);

/// Returns the names of layers for channels of pictures, which may have 31 letters: those that are
/// longer are cut, and remain different.
[[nodiscard]] std::vector<std::string> channel_names(const LampLayers& lamps);

} // namespace hemilux
