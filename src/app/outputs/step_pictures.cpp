#include "app/outputs/step_pictures.h"

#include "app/rendering/view.h"
#include "radiosity/answers/asked/text.h"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <optional>

namespace hemilux {

namespace {

std::string step_path(const std::string& path, std::uint32_t step) {
    const std::filesystem::path whole(path);
    const std::string name =
        whole.stem().string() + formatted("-%04u", step) + whole.extension().string();
    return (whole.parent_path() / name).string();
}

} // namespace

StepPictures::StepPictures(const SolveSettings& settings, const Mesh& mesh, const Tracer& tracer,
                           const std::atomic<bool>& interrupted)
    : mesh_(mesh), tracer_(tracer), interrupted_(interrupted), view_(settings.view),
      from_(settings.from), threads_(settings.options.threads) {
    if (settings.every_step)
        std::ranges::copy_if(settings.outputs, std::back_inserter(pictures_), is_picture,
                             &Output::kind);
}

void StepPictures::write(std::span<const Vec3> radiosity, std::uint32_t step) {
    const LitScene scene{mesh_, tracer_, radiosity, threads_};
    std::optional<Image> image;
    for (const Output& output : pictures_) {
        if (!report_.failed.empty() || !report_.left_out.empty())
            continue;
        const std::string path = step_path(output.path, step);
        report_.attempt(path, [&] {
            if (!view_.camera)
                view_.camera = camera_of(view_, scene);
            if (!image)
                image = render_view(scene, *view_.camera,
                                    picture_options(view_.size, threads_, interrupted_));
            choose_exposure(view_, *image, scene, *view_.camera, pixels_in_time(interrupted_));
            write_picture({path, output.kind}, *image, view_, from_);
        });
    }
}

} // namespace hemilux
