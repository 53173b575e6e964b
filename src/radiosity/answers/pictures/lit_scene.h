#pragma once
// Pictures of a scene with its light.

#include "radiosity/answers/images/image.h"
#include "radiosity/answers/pictures/render.h"
#include "radiosity/answers/views/camera.h"

#include <atomic>
#include <functional>
#include <span>
#include <string>

namespace hemilux {

/// A scene with its light, and the number of threads that look at it; it refers to what lives in
/// the caller.
struct LitScene {
    const Mesh& mesh;
    const Tracer& tracer;
    std::span<const Vec3> radiosity; ///< linear, by patch [W/m2]
    unsigned threads = 0;            ///< 0: one per core
};

/// Returns the options of a picture of this size, which ends with Interrupted once the flag is set.
/// They refer to it.
[[nodiscard]] RenderOptions picture_options(PixelSize size, unsigned threads,
                                            const std::atomic<bool>& interrupted);

/// Returns render(options). Where `give_up` ends it, it is called once more for a picture that is
/// there as fast as can be: large ones in squares.
[[nodiscard]] Image render_in_time(RenderOptions options,
                                   const std::function<Image(const RenderOptions&)>& render);

/// Returns what is said besides of pictures of this size that are rendered so fast: empty for small
/// ones.
[[nodiscard]] std::string squares_text(PixelSize size);

/// Renders the light of the patches so, as the camera sees it, with the textures of surfaces.
[[nodiscard]] Image render_view(const LitScene& scene, const Camera& camera, RenderOptions options);

/// Renders light that is gathered, up to the row at which `give_up` ends it.
[[nodiscard]] RowsOfPicture render_gathered(const LitScene& scene, const Camera& camera,
                                            RenderOptions options);

} // namespace hemilux
