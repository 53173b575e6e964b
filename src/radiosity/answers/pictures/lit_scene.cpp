#include "radiosity/answers/pictures/lit_scene.h"

#include "parallel/asked_to_end.h"
#include "radiosity/answers/asked/text.h"

#include <utility>

namespace hemilux {

RenderOptions picture_options(PixelSize size, unsigned threads,
                              const std::atomic<bool>& interrupted) {
    return {.width = size.width,
            .height = size.height,
            .threads = threads,
            .give_up = [&interrupted] { return is_asked_to_end(interrupted); }};
}

Image render_in_time(RenderOptions options,
                     const std::function<Image(const RenderOptions&)>& render) {
    try {
        return render(options);
    } catch (const Interrupted&) {
        options.give_up = {};
        options.samples = 1;
        options.square = square_for_speed(options.width, options.height);
        return render(options);
    }
}

std::string squares_text(PixelSize size) {
    const int square = square_for_speed(size.width, size.height);
    return square > 1 ? formatted(", in squares of %d pixels", square) : "";
}

Image render_view(const LitScene& scene, const Camera& camera, RenderOptions options) {
    options.textures = true;
    return render_in_time(std::move(options), [&](const RenderOptions& in_time) {
        return render(scene.mesh, scene.tracer, scene.radiosity, camera, in_time);
    });
}

RowsOfPicture render_gathered(const LitScene& scene, const Camera& camera, RenderOptions options) {
    options.textures = true;
    return render_rows(scene.mesh, scene.tracer, scene.radiosity, camera, options);
}

} // namespace hemilux
