#include "app/running/step_pictures.h"

#include "app/rendering/view.h"
#include "app/settings/text.h"

#include <algorithm>
#include <filesystem>
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

void StepPictures::write(std::span<const Vec3> radiosity, std::uint32_t step) {
    const PictureTime time(interrupted_);
    std::optional<Image> image;
    for (const Output& output : settings_.outputs) {
        if (!is_picture(output.kind) || !report_.failed.empty() || !report_.left_out.empty())
            continue;
        const std::string path = step_path(output.path, step);
        report_.attempt(path, [&] {
            if (!view_.camera)
                view_.camera =
                    camera_of(view_, mesh_, tracer_, radiosity, settings_.options.threads);
            if (!image)
                image = render_view(view_, mesh_, tracer_, radiosity, *view_.camera,
                                    settings_.options.threads, time);
            choose_exposure(view_, *image, mesh_, tracer_, *view_.camera,
                            settings_.options.threads);
            write_picture({path, output.kind}, *image, view_, settings_.from);
        });
    }
}

} // namespace hemilux
