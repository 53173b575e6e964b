#include "app/gathering/shown_camera.h"

#include "app/terminal/log.h"

namespace hemilux {
namespace {

/// Returns words for an axis that the program took to be upwards against what is usual; they are
/// empty where it is y, as nearly everywhere.
std::string guess_text(const ViewSettings& view, const Mesh& mesh) {
    const UpGuess guess = guess_up_axis(mesh, view.usual_up);
    return guess.axis == 1 ? ""
                           : "; z is taken as upwards, as " + guess.reason + "; --up y takes y";
}

} // namespace

Camera shown_camera_of(const ViewSettings& view, const LitScene& scene, Verbosity verbosity) {
    const Camera camera = camera_of(view, scene);
    if (!view.camera)
        log_line(verbosity, Verbosity::normal,
                 "pictures are seen by " + camera_text(camera) +
                     (view.up ? "" : guess_text(view, scene.mesh)));
    return camera;
}

} // namespace hemilux
