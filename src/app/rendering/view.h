#pragma once
// The view of a scene that the user asked for.

#include "app/settings/settings.h"
#include "io/pictures/image.h"
#include "io/rendering/render.h"
#include "io/results/smooth.h"

#include <atomic>
#include <chrono>
#include <span>
#include <string>

namespace hemilux {

/// Throws UsageError for a camera given whose eye and target are one point at the scene's scale,
/// and InputError where that camera is of the file of the scene.
void check_camera(const ViewSettings& view, const Mesh& mesh, const std::string& scene);

/// Returns the option that asks for this camera: "--camera 1,2,3,4,5,6,45". Places have six digits
/// of the distance at which it looks, wherever the origin is.
[[nodiscard]] std::string camera_text(const Camera& camera);
/// Returns the camera that this option gives, so that it may be copied.
[[nodiscard]] Camera as_printed(Camera camera);

/// The time that pictures may still take once the user has asked the program to end: until two
/// seconds after this was made, so that small ones are written. It refers to the argument.
class PictureTime {
  public:
    explicit PictureTime(const std::atomic<bool>& interrupted) : interrupted_(interrupted) {}
    [[nodiscard]] bool is_over() const;

  private:
    const std::atomic<bool>& interrupted_;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// A scene with its light, and the number of threads that look at it; it refers to what lives in
/// the caller.
struct LitScene {
    const Mesh& mesh;
    const Tracer& tracer;
    std::span<const Vec3> radiosity; ///< linear, by patch [W/m2]
    unsigned threads = 0;            ///< 0: one per core
};

/// Returns the camera given, or one chosen for the scene.
[[nodiscard]] Camera camera_of(const ViewSettings& view, const LitScene& scene);

/// Returns the options of a picture in the size asked for, which ends with Interrupted when the
/// time is over. They refer to `time`.
[[nodiscard]] RenderOptions picture_options(PixelSize size, unsigned threads,
                                            const PictureTime& time);

/// Renders the scene as the camera sees it, with the textures of its surfaces.
[[nodiscard]] Image render_view(const LitScene& scene, const Camera& camera, RenderOptions options);

/// Writes a .png file, by the exposure of the view, or the light alone in an .hdr or .exr file.
/// Throws OutputError.
void write_picture(const Output& output, const Image& image, const ViewSettings& view,
                   const Provenance& from);

/// Chooses the exposure for what render_view() made, where none was given.
void choose_exposure(ViewSettings& view, const Image& picture, const LitScene& scene,
                     const Camera& camera);
/// Returns how pictures are shown, once their exposure is known.
[[nodiscard]] Display display_of(const ViewSettings& view);
/// Returns the same for the light of a mesh's vertices, by class of corners.
[[nodiscard]] Display display_of(const ViewSettings& view, const Mesh& mesh,
                                 const CornerClasses& classes, std::span<const Vec3> of_class);

} // namespace hemilux
