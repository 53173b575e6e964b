#pragma once
// The view of a scene that the user asked for.

#include "app/settings/settings.h"
#include "io/pictures/image.h"
#include "io/results/smooth.h"

#include <atomic>
#include <chrono>
#include <span>
#include <string>

namespace hemilux {

/// Throws UsageError for a camera given whose eye and target are one point at the scene's scale.
void check_camera(const ViewSettings& view, const Mesh& mesh);

/// Returns the option that asks for this camera: "--camera 1,2,3,4,5,6,45".
[[nodiscard]] std::string camera_text(const Camera& camera);

/// Returns the camera given, or one chosen for the scene.
[[nodiscard]] Camera camera_of(const ViewSettings& view, const Mesh& mesh, const Tracer& tracer,
                               std::span<const Vec3> radiosity, unsigned threads);

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

/// Renders linear radiosity in the size asked for: that of the patches, or gathered with `gather`
/// rays at a point. `classes` are the mesh's classes of corners, where they are known. `slope` is
/// as in smooth(). Throws Interrupted when the time is over.
[[nodiscard]] Image render_view(const ViewSettings& view, const Mesh& mesh, const Tracer& tracer,
                                std::span<const Vec3> radiosity, const Camera& camera,
                                unsigned threads, const PictureTime& time,
                                const CornerClasses* classes = nullptr, unsigned gather = 0,
                                std::span<const Slope> slope = {});

/// Writes a .png file, by the exposure of the view, or the light alone in an .hdr or .exr file.
/// Throws OutputError.
void write_picture(const Output& output, const Image& image, const ViewSettings& view,
                   const Provenance& from);

/// Chooses the exposure for what render_view() made, where none was given.
void choose_exposure(ViewSettings& view, const Image& picture, const Mesh& mesh,
                     const Tracer& tracer, const Camera& camera, unsigned threads);
/// Returns how pictures are shown, once their exposure is known.
[[nodiscard]] Display display_of(const ViewSettings& view);
/// Returns the same for the light of a mesh's vertices, by class of corners.
[[nodiscard]] Display display_of(const ViewSettings& view, const Mesh& mesh,
                                 const CornerClasses& classes, std::span<const Vec3> of_class);

} // namespace hemilux
