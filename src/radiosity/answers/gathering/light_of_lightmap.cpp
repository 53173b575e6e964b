#include "radiosity/answers/gathering/light_of_lightmap.h"

#include "parallel/asked_to_end.h"
#include "radiosity/answers/asked/text.h"
#include "radiosity/answers/lightmaps/covered_texels.h"
#include "radiosity/answers/lightmaps/lightmap_gather.h"
#include "radiosity/answers/lightmaps/lightmap_target.h"
#include "radiosity/paper/sampling/rng.h"
#include "radiosity/paper/scene/mesh.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace hemilux {
namespace {

TexelMap texels_of(const WantedLightmap& wanted, const Gatherer& gatherer) {
    std::vector<PlacedTriangle> triangles = wanted.layout.triangles;
    show_brighter_sides(gatherer.scene().mesh, gatherer.solution(), triangles);
    return texels_of(wanted.layout, std::move(triangles), gatherer.scene().mesh,
                     gatherer.scene().tracer);
}

class LightmapOfTexels final : public ImageTarget {
  public:
    LightmapOfTexels(Gatherer& gatherer, const WantedLightmap& wanted)
        : gatherer_(gatherer), wanted_(wanted), texels_(texels_of(wanted, gatherer)),
          found_(texels_) {
        options_.bake = wanted.bake;
        options_.check = [this] {
            if (is_asked_to_end(gatherer_.wishes_to_end()))
                throw Interrupted();
        };
    }

    [[nodiscard]] std::string name() const override {
        return wanted_.object.empty() ? "lightmap" : "lightmap of " + wanted_.object;
    }
    [[nodiscard]] Parts parts(const Workers& workers) override {
        const auto& [mesh, tracer, radiosity, threads] = gatherer_.scene();
        covered_ = find_covered(mesh, tracer, texels_, options_.check, workers);
        return {lightmap_parts(mesh, texels_, covered_, wanted_.bake, seed_of(10)), seed_of(11)};
    }
    void complete() {
        complete_by_patches(found_, gatherer_.scene().mesh, gatherer_.cache().light(), texels_,
                            wanted_.bake, gatherer_.workers());
    }
    void take_image() { found_.image = std::move(image_); }
    [[nodiscard]] LightOfLightmap take();

  protected:
    [[nodiscard]] OneRound gather_round(const Round& round, const Workers& workers) override;
    [[nodiscard]] PictureJudge make_judge() const override {
        const auto& [mesh, tracer, radiosity, threads] = gatherer_.scene();
        return judge_of_lightmaps(mesh, tracer, gatherer_.cache().light(), texels_, covered_,
                                  wanted_.bake, seed_of(12));
    }

  private:
    [[nodiscard]] std::uint64_t seed_of(std::uint64_t use) const {
        const std::uint64_t seed = gatherer_.seed_of(use);
        return wanted_.number == 0 ? seed : hash_words({seed, wanted_.number});
    }

    Gatherer& gatherer_;
    const WantedLightmap& wanted_;
    TexelMap texels_;
    std::vector<bool> covered_;
    LightmapOptions options_;
    GatheredLightmap found_;
};

ImageTarget::OneRound LightmapOfTexels::gather_round(const Round& round, const Workers& workers) {
    options_.rays = round.rays;
    options_.round = round.number;
    options_.rows_done = [&](int rows) { round.tell(double(rows) / texels_.size()); };
    GatheredLightmap one =
        gather_texels(gatherer_.scene().mesh, gatherer_.scene().tracer, gatherer_.cache().light(),
                      texels_, covered_, options_, workers);
    if (one.rows == texels_.size()) {
        found_.known = std::move(one.known);
        found_.rows = one.rows;
        return {std::move(one.image), one.traced};
    }
    if (round.number == 0)
        found_ = std::move(one);
    throw Interrupted();
}

LightOfLightmap LightmapOfTexels::take() {
    LightOfLightmap light;
    light.object = wanted_.object;
    light.texels = static_cast<std::uint64_t>(std::ranges::count(found_.known, true));
    light.rows = found_.rows;
    fill_texels(found_, texels_, wanted_.layout.margin);
    light.image = std::move(found_.image);
    return light;
}

} // namespace

Answer<LightOfLightmap> gather_lightmap(Gatherer& gatherer, const WantedLightmap& lightmap,
                                        const std::optional<WholeLight>& whole) {
    LightmapOfTexels target(gatherer, lightmap);
    Answer<LightOfLightmap> answer;
    try {
        const auto [errors, level, work] = gatherer.gather(target, whole);
        target.take_image();
        answer = {target.take(), errors.of_answer(), work};
        answer.value.level = level;
        answer.value.rays = errors.rays;
    } catch (const Interrupted&) {
        target.complete();
        answer.value = target.take();
    }
    return answer;
}

std::string end_text(const LightOfLightmap& lightmap) {
    const std::string& object = lightmap.object;
    const std::string later = object.empty() ? "" : " and later objects";
    if (lightmap.rows == 0)
        return "interrupted; " +
               (object.empty() ? "the lightmap shows"
                               : "the lightmaps of " + object + later + " show") +
               " the light of the patches";
    return "interrupted; rows 1 to " + grouped(static_cast<std::uint64_t>(lightmap.rows)) + " of " +
           grouped(static_cast<std::uint64_t>(lightmap.image.height)) + " of the lightmap" +
           (object.empty() ? "" : " of " + object) + " are gathered, the others" + later +
           " show the light of the patches";
}

} // namespace hemilux
