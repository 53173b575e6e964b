#include "app/outputs/preview.h"

#include "app/terminal/live_line.h"
#include "io/pictures/picture_files.h"
#include "radiosity/paper/solution/solution.h"

#include <algorithm>
#include <ctime>
#include <exception>
#include <iterator>

namespace hemilux {
namespace {

/// The processor time of this process [s].
double processor_seconds() { return double(std::clock()) / CLOCKS_PER_SEC; }

/// The number of squares of a coarse picture.
constexpr double coarse = 1 << 16;

/// Gathering so many pixels takes longer than to show them first.
constexpr double many_pixels = 100'000;

/// A preview is followed by so many times the time that it took.
constexpr double patience = 40;

} // namespace

bool shows_previews(const SolveSettings& settings) {
    return settings.preview || (settings.verbosity != Verbosity::quiet && stderr_is_terminal());
}

Preview::Preview(const SolveSettings& settings, const std::atomic<bool>& interrupted)
    : settings_(settings), interrupted_(interrupted), view_(settings.view) {
    if (shows_previews(settings))
        std::ranges::copy_if(settings.outputs, std::back_inserter(pictures_),
                             [](const Output& output) { return output.kind == OutputKind::png; });
}

bool Preview::is_due() const {
    return !pictures_.empty() && !interrupted_ && processor_seconds() >= next_;
}

void Preview::show(const LitScene& scene, const Solution& solution,
                   const std::optional<Camera>& camera) {
    if (solution.steps == 0 || !is_due())
        return;
    begun_ = processor_seconds();
    if (camera)
        view_.camera = camera;
    render(scene, solution);
    write();
}

void Preview::begin_gathering(const LitScene& scene, const Solution& solution,
                              const Camera& camera) {
    const auto [width, height] = settings_.view.size;
    if (pictures_.empty() || (image_.pixels.empty() && double(width) * height < many_pixels))
        return;
    if (image_.pixels.empty())
        next_ = 0;
    view_.camera = camera;
    begun_ = processor_seconds();
    render(scene, solution);
    if (is_due())
        write();
}

void Preview::show_rows(const Image& picture, int rows) {
    if (image_.pixels.empty() || !is_due())
        return;
    begun_ = processor_seconds();
    std::copy_n(picture.pixels.begin(), picture.index(0, rows), image_.pixels.begin());
    write();
}

void Preview::render(const LitScene& scene, const Solution& solution) {
    if (!view_.camera)
        view_.camera = camera_of(view_, scene);
    const auto [width, height] = settings_.view.size;
    image_ = render_view(scene, *view_.camera,
                         {.width = width,
                          .height = height,
                          .samples = 1,
                          .threads = scene.threads,
                          .slope = solution.slope,
                          .square = square_for_speed(width, height, coarse)});
    view_.exposure = settings_.view.exposure;
    choose_exposure(view_, image_, scene, *view_.camera, coarse);
}

/// A file that cannot be written is reported at the end, when it is written for good.
void Preview::write() {
    try {
        for (const Output& output : pictures_)
            write_png(output.path, image_, display_of(view_), settings_.from, Compression::little);
    } catch (const std::exception&) {
        pictures_.clear();
    }
    const double now = processor_seconds();
    next_ = now + patience * (now - begun_);
}

} // namespace hemilux
