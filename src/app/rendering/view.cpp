#include "app/rendering/view.h"

#include "app/settings/exit_code.h"
#include "app/settings/text.h"
#include "io/files/error.h"
#include "io/meshes/baked_light.h"
#include "io/pictures/exr.h"
#include "radiosity/paper/scene/mesh.h"

#include <cmath>

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

std::string camera_text(const Camera& camera) {
    auto [eye, target, up, fov] = camera;
    const double far = glm::distance(eye, target);
    for (Vec3* point : {&eye, &target})
        for (int axis = 0; axis < 3; ++axis)
            if (std::abs((*point)[axis]) < 1e-9 * far) // 0, but for rounding
                (*point)[axis] = 0;
    const std::string text = formatted("--camera %g,%g,%g,%g,%g,%g,%g", eye.x, eye.y, eye.z,
                                       target.x, target.y, target.z, fov);
    return up == Camera().up ? text : text + formatted(",%g,%g,%g", up.x, up.y, up.z);
}

Camera camera_of(const ViewSettings& view, const LitScene& scene) {
    const auto [width, height] = view.size;
    return view.camera
               ? *view.camera
               : automatic_camera(scene.mesh, scene.tracer, scene.radiosity,
                                  static_cast<double>(width) / height, view.up, scene.threads);
}

bool PictureTime::is_over() const {
    constexpr std::chrono::milliseconds moment(500);
    return interrupted_ && std::chrono::steady_clock::now() - start_ > moment;
}

RenderOptions picture_options(PixelSize size, unsigned threads, const PictureTime& time) {
    return {.width = size.width, .height = size.height, .threads = threads, .give_up = [&time] {
                return time.is_over();
            }};
}

Image render_view(const LitScene& scene, const Camera& camera, RenderOptions options) {
    options.textures = true;
    return render(scene.mesh, scene.tracer, scene.radiosity, camera, options);
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

void choose_exposure(ViewSettings& view, const Image& picture, const LitScene& scene,
                     const Camera& camera) {
    if (!view.exposure)
        view.exposure = exposure_of(picture, scene.mesh, scene.tracer, camera, scene.threads);
}

Display display_of(const ViewSettings& view) {
    return {std::exp2(view.stops) * view.exposure.value_or(1), view.tone};
}

Display display_of(const ViewSettings& view, const Mesh& mesh, const CornerClasses& classes,
                   std::span<const Vec3> of_class) {
    return {std::exp2(view.stops) *
                (view.exposure ? *view.exposure : auto_exposure(mesh, classes, of_class)),
            view.tone};
}

} // namespace hemilux
