#include "app/rendering/view.h"

#include "app/settings/exit_code.h"
#include "geometry/elementary.h"
#include "io/files/error.h"
#include "io/files/provenance.h"
#include "io/pictures/exr.h"
#include "io/pictures/picture_files.h"
#include "parallel/asked_to_end.h"
#include "radiosity/answers/asked/text.h"
#include "radiosity/answers/images/tone.h"
#include "radiosity/answers/vertices/baked_light.h"
#include "radiosity/paper/scene/mesh.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

namespace hemilux {

void check_camera(const ViewSettings& view, const Mesh& mesh, const std::string& scene) {
    if (!view.camera ||
        mesh.frame().to_local(view.camera->eye) != mesh.frame().to_local(view.camera->target))
        return;
    if (view.uses_camera_of_scene) // as --camera was not given
        throw InputError(scene, "the camera's eye and target are the same point beside the scene's "
                                "distance from the origin; --camera auto chooses another");
    throw UsageError("--camera: expected an eye and a target that differ; beside the scene's "
                     "distance from the origin these two are the same point");
}

namespace {

/// Returns a coordinate of a camera that looks so far, with six digits of that distance.
std::string place_text(double coordinate, double far) {
    constexpr int digits = 6, most = 17;
    const int decimals =
        std::clamp(digits - static_cast<int>(std::floor(std::log10(far))), 0, most);
    return rounded_text(coordinate, decimals);
}

std::string angle_text(double degrees) { return formatted("%.6g", degrees); }

} // namespace

std::string camera_text(const Camera& camera) {
    const auto& [eye, target, up, fov] = camera;
    const double far = glm::distance(eye, target);
    std::string text = "--camera ";
    for (const Vec3& point : {eye, target})
        for (int axis = 0; axis < 3; ++axis)
            text += place_text(point[axis], far) + ",";
    text += angle_text(fov);
    return up == Camera().up ? text : text + formatted(",%g,%g,%g", up.x, up.y, up.z);
}

Camera as_printed(Camera camera) {
    const double far = glm::distance(camera.eye, camera.target);
    if (!(far > 0) || !std::isfinite(far))
        return camera;
    for (Vec3* const point : {&camera.eye, &camera.target})
        for (int axis = 0; axis < 3; ++axis)
            (*point)[axis] = std::strtod(place_text((*point)[axis], far).c_str(), nullptr);
    if (camera.up != Camera().up)
        for (int axis = 0; axis < 3; ++axis)
            camera.up[axis] = std::strtod(formatted("%g", camera.up[axis]).c_str(), nullptr);
    camera.vertical_fov_degrees =
        std::strtod(angle_text(camera.vertical_fov_degrees).c_str(), nullptr);
    return camera;
}

Camera camera_of(const ViewSettings& view, const LitScene& scene) {
    const auto [width, height] = view.size;
    return view.camera ? *view.camera
                       : as_printed(automatic_view(scene.mesh, scene.tracer, scene.radiosity,
                                                   {static_cast<double>(width) / height, view.up,
                                                    view.usual_up, scene.threads})
                                        .camera);
}

void write_picture(const Output& output, const Image& image, const ViewSettings& view,
                   const Provenance& from) {
    if (output.kind == OutputKind::hdr)
        return write_hdr(output.path, image, from);
    if (output.kind == OutputKind::exr) {
        std::vector<ExrChannel> channels;
        add_exr_channels(channels, "", image);
        return write_exr(output.path, image.width, image.height, std::move(channels), from);
    }
    write_png(output.path, image, display_of(view), from);
}

std::optional<double> pixels_in_time(const std::atomic<bool>& interrupted) {
    return interrupted ? std::optional(pixels_for_speed) : std::nullopt;
}

void choose_exposure(ViewSettings& view, const Image& picture, const LitScene& scene,
                     const Camera& camera, std::optional<double> pixels) {
    if (!view.exposure)
        view.exposure =
            exposure_of(picture, scene.mesh, scene.tracer, camera, scene.threads,
                        pixels ? square_for_speed(picture.width, picture.height, *pixels) : 1);
}

Display display_of(const ViewSettings& view) {
    return {elementary::exp2(view.stops) * view.exposure.value_or(1), view.tone};
}

Display display_of(const ViewSettings& view, const Mesh& mesh, const CornerClasses& classes,
                   std::span<const Vec3> of_class) {
    return {elementary::exp2(view.stops) *
                (view.exposure ? *view.exposure : auto_exposure(mesh, classes, of_class)),
            view.tone};
}

} // namespace hemilux
