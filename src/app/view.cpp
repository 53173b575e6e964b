#include "app/view.h"

#include "io/render.h"

namespace hemilux {

Camera camera_of(const ViewSettings& view, const Mesh& mesh, const Tracer& tracer,
                 std::span<const Vec3> radiosity) {
    const auto [width, height] = view.size;
    return view.camera
               ? *view.camera
               : automatic_camera(mesh, tracer, radiosity, static_cast<double>(width) / height);
}

bool PictureTime::is_over() const {
    constexpr std::chrono::seconds moment(2);
    return interrupted_ && std::chrono::steady_clock::now() - start_ > moment;
}

Image render_view(const ViewSettings& view, const Mesh& mesh, const Tracer& tracer,
                  std::span<const Vec3> radiosity, const Camera& camera, unsigned threads,
                  const PictureTime& time, const CornerClasses* classes) {
    const auto [width, height] = view.size;
    return render(mesh, tracer, radiosity, camera,
                  {.width = width,
                   .height = height,
                   .threads = threads,
                   .classes = classes,
                   .give_up = [&time] { return time.is_over(); }});
}

double exposure_of(const ViewSettings& view, const Image& image) {
    return view.exposure ? *view.exposure : auto_exposure(image);
}

} // namespace hemilux
