#include "app/gathering/shown_camera.h"

#include "app/terminal/log.h"

namespace hemilux {

Camera shown_camera_of(const ViewSettings& view, const LitScene& scene, Verbosity verbosity) {
    const Camera camera = camera_of(view, scene);
    if (!view.camera)
        log_line(verbosity, Verbosity::normal,
                 "pictures are seen by " + camera_text(camera) +
                     (!view.up && camera.up.z == 1 ? "; --up y takes y as upwards" : ""));
    return camera;
}

} // namespace hemilux
