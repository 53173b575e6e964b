#include "radiosity/answers/gathering/light_of_picture.h"

#include "parallel/asked_to_end.h"
#include "radiosity/answers/asked/text.h"
#include "radiosity/answers/pictures/picture_parts.h"
#include "radiosity/answers/pictures/render.h"
#include "radiosity/answers/views/camera_rays.h"
#include "radiosity/paper/scene/mesh.h"

#include <algorithm>
#include <utility>

namespace hemilux {
namespace {

class PictureTarget final : public ImageTarget {
  public:
    PictureTarget(Gatherer& gatherer, const WantedPicture& wanted)
        : gatherer_(gatherer), wanted_(wanted),
          rays_(wanted.camera, gatherer.scene().mesh,
                double(wanted.size.width) / wanted.size.height) {}

    [[nodiscard]] std::string name() const override { return "picture"; }
    [[nodiscard]] Parts parts(const Workers& workers) override {
        const auto& [mesh, tracer, radiosity, threads] = gatherer_.scene();
        return {picture_parts(mesh, tracer, rays_, wanted_.size.width, wanted_.size.height,
                              gatherer_.seed_of(6), workers),
                gatherer_.seed_of(5)};
    }
    [[nodiscard]] Image take() { return std::move(image_); }
    /// Returns the rows of the first round that are gathered before a signal, and the light of the
    /// patches in the others; nothing where there is none.
    [[nodiscard]] std::optional<Image> complete();

  protected:
    [[nodiscard]] OneRound gather_round(const Round& round, const Workers& workers) override;
    [[nodiscard]] PictureJudge make_judge() const override {
        const auto& [mesh, tracer, radiosity, threads] = gatherer_.scene();
        return judge_of_pictures(mesh, tracer, gatherer_.cache().light(), rays_, wanted_.size.width,
                                 wanted_.size.height, gatherer_.seed_of(7));
    }

  private:
    [[nodiscard]] RenderOptions options() const {
        RenderOptions options =
            picture_options(wanted_.size, gatherer_.asked().threads, gatherer_.wishes_to_end());
        options.slope = gatherer_.solution().slope;
        return options;
    }

    Gatherer& gatherer_;
    const WantedPicture& wanted_;
    CameraRays rays_;
    RowsOfPicture before_signal_;
};

ImageTarget::OneRound PictureTarget::gather_round(const Round& round, const Workers&) {
    RenderOptions in_round = options();
    in_round.cells = &gatherer_.cache().cells();
    in_round.coarse_rays = round.alone ? 4 * round.rays : 0;
    in_round.gather = round.rays;
    in_round.gather_round = round.number;
    in_round.rows_done = [&](const Image& rows, int count) {
        round.tell(double(count) / wanted_.size.height);
        if (wanted_.rows_done && round.number == 0)
            wanted_.rows_done(rows, count);
    };
    RowsOfPicture found = render_gathered(gatherer_.scene(), wanted_.camera, in_round);
    if (found.rows == wanted_.size.height)
        return {std::move(found.image), found.rays};
    if (round.number == 0)
        before_signal_ = std::move(found);
    throw Interrupted();
}

std::optional<Image> PictureTarget::complete() {
    auto& [image, rows, rays] = before_signal_;
    if (rows == 0)
        return std::nullopt;
    const Image of_patches = render_view(gatherer_.scene(), wanted_.camera, options());
    const auto first = static_cast<std::ptrdiff_t>(of_patches.index(0, rows));
    std::copy(of_patches.pixels.begin() + first, of_patches.pixels.end(),
              image.pixels.begin() + first);
    gatherer_.watcher().tell(
        Finding::Kind::ended_early,
        "interrupted; rows 1 to " + grouped(static_cast<std::uint64_t>(rows)) + " of " +
            grouped(static_cast<std::uint64_t>(image.height)) +
            " of pictures are gathered, the others show the light of the patches" +
            squares_text(wanted_.size));
    return std::move(image);
}

} // namespace

std::optional<Answer<LightOfPicture>> gather_picture(Gatherer& gatherer,
                                                     const WantedPicture& picture,
                                                     const std::optional<WholeLight>& whole) {
    PictureTarget target(gatherer, picture);
    try {
        const auto [errors, level, work] = gatherer.gather(target, whole);
        return Answer<LightOfPicture>{{target.take(), level}, errors.of_answer(), work};
    } catch (const Interrupted&) {
        std::optional<Image> rest = target.complete();
        if (!rest)
            return std::nullopt;
        return Answer<LightOfPicture>{{std::move(*rest), {}}, {}, {}};
    }
}

} // namespace hemilux
