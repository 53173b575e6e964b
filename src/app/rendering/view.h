#pragma once
// The view of a scene that the user asked for.

#include "app/settings/settings.h"
#include "io/files/provenance.h"
#include "radiosity/answers/images/image.h"
#include "radiosity/answers/images/tone.h"
#include "radiosity/answers/pictures/lit_scene.h"
#include "radiosity/answers/vertices/smooth.h"

#include <atomic>
#include <functional>
#include <optional>
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

/// Returns the camera given, or one chosen for the scene.
[[nodiscard]] Camera camera_of(const ViewSettings& view, const LitScene& scene);

/// Writes a .png file, by the exposure of the view, or the light alone in an .hdr or .exr file.
/// Throws OutputError.
void write_picture(const Output& output, const Image& image, const ViewSettings& view,
                   const Provenance& from);

/// Returns how many pixels are enough for the exposure: all, or some after a signal.
[[nodiscard]] std::optional<double> pixels_in_time(const std::atomic<bool>& interrupted);

/// Chooses the exposure for what render_view() made, where none was given: by all pixels, or faster
/// by about so many.
void choose_exposure(ViewSettings& view, const Image& picture, const LitScene& scene,
                     const Camera& camera, std::optional<double> pixels = {});
/// Returns how pictures are shown, once their exposure is known.
[[nodiscard]] Display display_of(const ViewSettings& view);
/// Returns the same for the light of a mesh's vertices, by class of corners.
[[nodiscard]] Display display_of(const ViewSettings& view, const Mesh& mesh,
                                 const CornerClasses& classes, std::span<const Vec3> of_class);

} // namespace hemilux
