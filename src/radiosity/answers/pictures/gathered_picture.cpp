#include "radiosity/answers/pictures/gathered_picture.h"

#include "bvh/tracer.h"
#include "parallel/asked_to_end.h"
#include "parallel/workers.h"
#include "radiosity/answers/pictures/direct_window.h"
#include "radiosity/answers/pictures/pixel_colours.h"
#include "radiosity/answers/pictures/row_windows.h"
#include "radiosity/paper/scene/mesh.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace hemilux {
namespace {

class GatheredPicture {
  public:
    GatheredPicture(const Mesh& mesh, const VisibleFacets& visible, PictureGather& gather,
                    const Tracer* panes, std::span<const Vec2> offsets, int width, int height)
        : mesh_(mesh), visible_(visible), gather_(gather), panes_(panes), offsets_(offsets),
          image_(width, height), rows_(static_cast<std::size_t>(height)) {}

    [[nodiscard]] RowsOfPicture render(const RowWork& work, const Workers& workers);

  private:
    /// The part of a pixel that shows one facet, or the whole pixel where it shows nothing else.
    struct Part {
        glm::vec3 position{0.0f};                 ///< local frame
        glm::vec3 direct{0.0f}, unshadowed{0.0f}; ///< by its own shadow rays
        glm::vec3 reflected{0.0f};                ///< of direct light if nothing stood between
        std::uint32_t patch = none;
        float share = 0; ///< of the pixel
    };
    struct NarrowPart {
        int x;
        Part part;
    };
    /// What a row shows.
    struct Row {
        std::vector<Part> whole;       ///< by pixel; share 0 where it shows nothing or several
        std::vector<NarrowPart> parts; ///< from left to right
        std::vector<float> passed;     ///< by pixel, through the panes; empty where there are none
    };
    struct Shown {
        int x, y;
        std::uint32_t patch;
        Colours colours;
    };
    [[nodiscard]] Row& row(int y) { return rows_[static_cast<std::size_t>(y)]; }
    [[nodiscard]] const Row& row(int y) const { return rows_[static_cast<std::size_t>(y)]; }
    void gather_band(const VisibleFacets::Band& band, int first, int end,
                     const std::function<void()>& check);
    void gather_places(std::span<const Shown> shown, std::span<const PictureGather::Place> places);
    void look_through_panes(const VisibleFacets::Band& band, int y);
    void finish_row(int y);
    [[nodiscard]] glm::vec3 direct_light(const Part& part, int x, int y) const;

    const Mesh& mesh_;
    const VisibleFacets& visible_;
    PictureGather& gather_;
    const Tracer* panes_; ///< null where there are none
    std::span<const Vec2> offsets_;
    Image image_;           ///< all but direct light at first
    std::vector<Row> rows_; ///< empty before a row is gathered, and once no window reaches it
};

/// Gathers some bands, and adds the direct light of the rows whose windows are known then.
RowsOfPicture GatheredPicture::render(const RowWork& work, const Workers& workers) {
    constexpr int rows_of_band = VisibleFacets::rows_per_band;
    RowsOfPicture found;
    const auto gather = [&](int from, int to) {
        gather_.prepare_rows(to, workers);
        visible_.for_bands(from / rows_of_band, (to + rows_of_band - 1) / rows_of_band, workers,
                           work.check, [&](const VisibleFacets::Band& band, int first, int end) {
                               gather_band(band, first, end, work.check);
                           });
    };
    const auto finish = [&](int first, int end) {
        workers.for_chunks(static_cast<std::size_t>(end - first), 8,
                           [&](std::size_t begin, std::size_t past) {
                               work.check();
                               for (std::size_t k = begin; k < past; ++k)
                                   finish_row(first + static_cast<int>(k));
                           });
        found.rows = end;
        if (work.rows_done)
            work.rows_done(image_, end);
    };
    try {
        for_row_windows(image_.height, 4 * static_cast<int>(workers.threads()) * rows_of_band,
                        DirectWindow::reach, gather, finish, [&](int y) { row(y) = {}; });
    } catch (const Interrupted&) { // the rows before are finished
    }
    found.image = std::move(image_);
    found.rays = gather_.rays();
    return found;
}

void GatheredPicture::finish_row(int y) {
    for (int x = 0; x < image_.width; ++x)
        if (const Part& whole = row(y).whole[static_cast<std::size_t>(x)]; whole.share > 0)
            image_.at(x, y) += direct_light(whole, x, y);
    for (const auto& [x, part] : row(y).parts)
        image_.at(x, y) += part.share * direct_light(part, x, y);
    for (int x = 0; !row(y).passed.empty() && x < image_.width; ++x)
        image_.at(x, y) *= row(y).passed[static_cast<std::size_t>(x)];
}

/// Finds what the panes before the surfaces of a row let through, in the mean over its samples.
void GatheredPicture::look_through_panes(const VisibleFacets::Band& band, int y) {
    for (int x = 0; x < image_.width; ++x)
        row(y).passed.push_back(float(passed_through_panes(visible_, *panes_, band, x, y)));
}

/// Pixels are visited square by square: those near each other share what they have in common. Not
/// too many are gathered before it is asked again whether to go on.
void GatheredPicture::gather_band(const VisibleFacets::Band& band, int first, int end,
                                  const std::function<void()>& check) {
    constexpr int side = 4;
    constexpr std::size_t places_at_once = 1 << 14;
    std::vector<Shown> shown;
    std::vector<PictureGather::Place> places;
    for (int y = first; y < end; ++y) {
        row(y).whole.resize(static_cast<std::size_t>(image_.width));
        if (panes_)
            look_through_panes(band, y);
    }
    const auto visit = [&](int x, int y) {
        visible_.visit_pixel(
            band, x, y, false,
            [&](std::uint32_t half, const Vec2& place, unsigned sample, unsigned count) {
                const Vec3 direction = visible_.direction(place);
                const Hit hit = visible_.hit_at(half, direction);
                const std::uint32_t patch = mesh_.patch_at(hit);
                const Vec3 position = visible_.eye() + hit.t * direction;
                shown.push_back({x, y, patch, pixel_colours(mesh_, visible_, half, patch, place)});
                places.push_back(
                    {{position, mesh_.patches()[patch].normal, hit.facet}, place, sample, count});
            });
    };
    for (int top = first; top < end; top += side)
        for (int left = 0; left < image_.width; left += side) {
            for (int y = top; y < std::min(top + side, end); ++y)
                for (int x = left; x < std::min(left + side, image_.width); ++x)
                    visit(x, y);
            if (places.size() < places_at_once)
                continue;
            check();
            gather_places(shown, places);
            shown.clear();
            places.clear();
        }
    gather_places(shown, places);
}

void GatheredPicture::gather_places(std::span<const Shown> shown,
                                    std::span<const PictureGather::Place> places) {
    const std::vector<PictureGather::Light> lights = gather_.irradiance(places);
    for (std::size_t k = 0; k < shown.size(); ++k) {
        const auto& [x, y, patch, colours] = shown[k];
        const auto& [direct, slow, of_points, reach] = lights[k];
        const glm::vec3 reflectance(colours.reflectance);
        const Part part{.position = glm::vec3(places[k].at.position),
                        .direct = glm::vec3(direct.arriving),
                        .unshadowed = glm::vec3(direct.unshadowed),
                        .reflected = reflectance * slow.unshadowed,
                        .patch = patch,
                        .share = float(places[k].count) / float(offsets_.size())};
        image_.at(x, y) += part.share * (glm::vec3(colours.emission) +
                                         reflectance * (slow.indirect + glm::vec3(of_points)));
        if (places[k].count == offsets_.size())
            row(y).whole[static_cast<std::size_t>(x)] = part;
        else
            row(y).parts.push_back({x, part});
    }
}

/// Returns the direct light that a part of pixel (x, y) reflects. Parts of other pixels count only
/// for a part of a pixel: a strip narrower than a pixel shows nothing else.
glm::vec3 GatheredPicture::direct_light(const Part& part, int x, int y) const {
    constexpr int reach = DirectWindow::reach;
    const Vec3& normal = mesh_.patches()[part.patch].normal;
    DirectWindow window(gather_.shadow_rays());
    const auto add = [&](const Part& from, int dx, int dy) {
        if (from.share == 0 || (from.patch != part.patch &&
                                !is_same_surface(Vec3(part.position), normal, Vec3(from.position),
                                                 mesh_.patches()[from.patch].normal)))
            return;
        window.add(dx, dy, from.direct, from.unshadowed,
                   DirectWindow::weight_at(dx, dy) * from.share);
    };
    const int left = std::max(x - reach, 0), right = std::min(x + reach, image_.width - 1);
    for (int beside = std::max(y - reach, 0); beside <= std::min(y + reach, image_.height - 1);
         ++beside) {
        const auto& [whole, parts, passed] = row(beside);
        for (int column = left; column <= right; ++column)
            add(whole[static_cast<std::size_t>(column)], column - x, beside - y);
        if (part.share == 1)
            continue;
        for (auto there = std::ranges::lower_bound(parts, left, {}, &NarrowPart::x);
             there != parts.end() && there->x <= right; ++there)
            add(there->part, there->x - x, beside - y);
    }
    const float own = part.share == 1 ? window.share_of_own() : 0;
    return window.arriving_of(part.reflected, own, part.direct, part.unshadowed);
}

} // namespace

RowsOfPicture gathered_picture(const Mesh& mesh, const VisibleFacets& visible,
                               PictureGather& gather, const Tracer* panes,
                               std::span<const Vec2> offsets, int width, int height,
                               const RowWork& work, const Workers& workers) {
    return GatheredPicture(mesh, visible, gather, panes, offsets, width, height)
        .render(work, workers);
}

double passed_through_panes(const VisibleFacets& visible, const Tracer& tracer,
                            const VisibleFacets::Band& band, int x, int y) {
    double sum = 0;
    unsigned samples = 0;
    visible.visit_pixel(band, x, y, true,
                        [&](std::uint32_t half, const Vec2& place, unsigned, unsigned count) {
                            const Vec3 way = visible.direction(place);
                            sum += count * tracer.passed({.origin = visible.eye(),
                                                          .direction = way,
                                                          .t_max = visible.hit_at(half, way).t});
                            samples += count;
                        });
    return samples > 0 ? sum / samples : 1;
}

} // namespace hemilux
