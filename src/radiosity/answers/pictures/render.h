#pragma once
// Pictures of a solution.

#include "radiosity/answers/images/image.h"
#include "radiosity/answers/views/automatic_camera.h"
#include "radiosity/answers/views/camera_rays.h"

#include <cstdint>
#include <functional>
#include <span>

namespace hemilux {

struct CornerClasses;
class IrradianceCells;
struct Slope;

struct RenderOptions {
    int width = 800, height = 600; ///< pixels
    int samples = 4; ///< places in a pixel; more: smoother edges, proportionally slower
    /// Surfaces show their textures; else the means of patches. Values that are no light have no
    /// textures.
    bool textures = false;
    bool smooth = true; ///< interpolate over patches; else each shows its own radiosity
    /// The number of rays that gather the light at points once more (picture_gather.h). Shadows are
    /// then at their places, for many times the time. 0: the patches' light is shown.
    unsigned gather = 0;
    unsigned gather_round = 0;              ///< PictureGatherOptions::round
    unsigned coarse_rays = 0;               ///< PictureGatherOptions::coarse_rays
    unsigned threads = 0;                   ///< 0: one per core. The picture does not depend on it
    const CornerClasses* classes = nullptr; ///< of the mesh, where they are known already
    std::span<const Slope> slope = {};      ///< of the patches' light; empty: none
    const IrradianceCells* cells = nullptr; ///< what gathers read besides, where walks found it
    /// The patches' light is shown by squares of so many pixels, each by the sample in its middle.
    int square = 1;
    /// All threads ask it now and then; true ends the picture with Interrupted.
    std::function<bool()> give_up = {};
    /// Is called where light is gathered, with the picture and the number of its rows, from the
    /// top, that are finished.
    std::function<void(const Image& picture, int rows)> rows_done = {};
};

/// A picture of which so many rows are finished, from the top.
struct RowsOfPicture {
    Image image;
    int rows = 0;
    std::uint64_t rays = 0; ///< traced, but for those of paths that go on
};

/// Renders the linear radiosity seen through the camera; black where there is no surface. Throws
/// std::invalid_argument for a size or a number of samples below 1.
[[nodiscard]] Image render(const Mesh& mesh, const Tracer& tracer, std::span<const Vec3> radiosity,
                           const Camera& camera, const RenderOptions& options = {});

/// Renders a picture whose light is gathered. Where `give_up` ends it, it has the rows that are
/// finished by then.
[[nodiscard]] RowsOfPicture render_rows(const Mesh& mesh, const Tracer& tracer,
                                        std::span<const Vec3> radiosity, const Camera& camera,
                                        const RenderOptions& options);

/// Returns the exposure by auto_exposure() for a picture that render() made, by one pixel of each
/// square of so many.
[[nodiscard]] double exposure_of(const Image& picture, const Mesh& mesh, const Tracer& tracer,
                                 const Camera& camera, unsigned threads = 0, int square = 1);

/// Returns the side of squares [pixels] of which a picture has about so many.
inline constexpr double pixels_for_speed = 1 << 20;
[[nodiscard]] int square_for_speed(int width, int height, double squares = pixels_for_speed);

} // namespace hemilux
