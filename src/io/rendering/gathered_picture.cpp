#include "io/rendering/gathered_picture.h"

#include "io/rendering/direct_window.h"
#include "io/rendering/pixel_colours.h"
#include "io/rendering/row_windows.h"
#include "parallel/workers.h"
#include "radiosity/paper/scene/mesh.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace hemilux {
namespace {

class GatheredPicture {
  public:
    GatheredPicture(const Mesh& mesh, const VisibleFacets& visible, const PictureGather& gather,
                    std::span<const Vec2> offsets, int width, int height)
        : mesh_(mesh), visible_(visible), gather_(gather), offsets_(offsets), image_(width, height),
          rows_(static_cast<std::size_t>(height)) {}

    [[nodiscard]] Image render(const std::function<void()>& check, const Workers& workers);

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
    };
    [[nodiscard]] Row& row(int y) { return rows_[static_cast<std::size_t>(y)]; }
    [[nodiscard]] const Row& row(int y) const { return rows_[static_cast<std::size_t>(y)]; }
    void gather_band(const VisibleFacets::Band& band, int first, int end);
    void add_direct_light(int y);
    [[nodiscard]] glm::vec3 direct_light(const Part& part, int x, int y) const;

    const Mesh& mesh_;
    const VisibleFacets& visible_;
    const PictureGather& gather_;
    std::span<const Vec2> offsets_;
    Image image_;           ///< all but direct light at first
    std::vector<Row> rows_; ///< empty before a row is gathered, and once no window reaches it
};

/// Gathers some bands, and adds the direct light of the rows whose windows are known then.
Image GatheredPicture::render(const std::function<void()>& check, const Workers& workers) {
    constexpr int rows_of_band = VisibleFacets::rows_per_band;
    for_row_windows(
        image_.height, 4 * static_cast<int>(workers.threads()) * rows_of_band, DirectWindow::reach,
        [&](int from, int to) {
            visible_.for_bands(from / rows_of_band, (to + rows_of_band - 1) / rows_of_band, workers,
                               check, [&](const VisibleFacets::Band& band, int first, int end) {
                                   gather_band(band, first, end);
                               });
        },
        [&](int first, int end) {
            workers.for_chunks(static_cast<std::size_t>(end - first), 8,
                               [&](std::size_t begin, std::size_t past) {
                                   check();
                                   for (std::size_t k = begin; k < past; ++k)
                                       add_direct_light(first + static_cast<int>(k));
                               });
        },
        [&](int y) { row(y) = {}; });
    return std::move(image_);
}

void GatheredPicture::add_direct_light(int y) {
    for (int x = 0; x < image_.width; ++x)
        if (const Part& whole = row(y).whole[static_cast<std::size_t>(x)]; whole.share > 0)
            image_.at(x, y) += direct_light(whole, x, y);
    for (const auto& [x, part] : row(y).parts)
        image_.at(x, y) += part.share * direct_light(part, x, y);
}

/// Pixels are visited square by square: those near each other share what they have in common.
void GatheredPicture::gather_band(const VisibleFacets::Band& band, int first, int end) {
    constexpr int side = 4;
    struct Shown {
        int x, y;
        std::uint32_t patch;
        Colours colours;
    };
    std::vector<Shown> shown;
    std::vector<PictureGather::Place> places;
    for (int y = first; y < end; ++y)
        row(y).whole.resize(static_cast<std::size_t>(image_.width));
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
        for (int left = 0; left < image_.width; left += side)
            for (int y = top; y < std::min(top + side, end); ++y)
                for (int x = left; x < std::min(left + side, image_.width); ++x)
                    visit(x, y);
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
        const auto& [whole, parts] = row(beside);
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

Image gathered_picture(const Mesh& mesh, const VisibleFacets& visible, const PictureGather& gather,
                       std::span<const Vec2> offsets, int width, int height,
                       const std::function<void()>& check, const Workers& workers) {
    return GatheredPicture(mesh, visible, gather, offsets, width, height).render(check, workers);
}

} // namespace hemilux
