#include "io/rendering/gathered_picture.h"

#include "io/files/error.h"
#include "io/rendering/pixel_colours.h"
#include "parallel/workers.h"
#include "radiosity/scene/mesh.h"

#include <algorithm>
#include <array>

namespace hemilux {
namespace {

/// Over so many pixels, at both ends by half: their rays together are well distributed.
constexpr std::array<float, 5> window{.5f, 1, 1, 1, .5f};
constexpr int half_window = 2;

float weight_at(int step) {
    return window[static_cast<std::size_t>(std::ptrdiff_t{step} + half_window)];
}

} // namespace

GatheredPicture::GatheredPicture(const Mesh& mesh, const VisibleFacets& visible,
                                 const PictureGather& gather, std::span<const Vec2> offsets,
                                 int width, int height)
    : mesh_(mesh), visible_(visible), gather_(gather), offsets_(offsets), width_(width),
      height_(height), whole_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)),
      parts_(static_cast<std::size_t>(height)) {}

Image GatheredPicture::render(const std::function<bool()>& give_up, const Workers& workers) {
    const auto check = [&] {
        if (give_up && give_up())
            throw Interrupted();
    };
    workers.for_chunks_with(
        static_cast<std::size_t>(visible_.bands()), 1, [] { return VisibleFacets::Band(); },
        [&](VisibleFacets::Band& band, std::size_t b, std::size_t) {
            check();
            visible_.fill(static_cast<int>(b), band);
            gather_band(band, static_cast<int>(b) * VisibleFacets::rows_per_band);
        });
    Image image(width_, height_);
    workers.for_chunks(parts_.size(), 8, [&](std::size_t begin, std::size_t end) {
        check();
        for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y) {
            for (int x = 0; x < width_; ++x)
                if (const Part& whole = whole_[image.index(x, y)]; whole.share > 0)
                    image.at(x, y) = radiosity(whole, y);
            for (const Part& part : parts_[static_cast<std::size_t>(y)])
                image.at(part.x, y) += part.share * radiosity(part, y);
        }
    });
    return image;
}

/// Pixels are visited square by square: those near each other share what they have in common.
void GatheredPicture::gather_band(const VisibleFacets::Band& band, int first) {
    constexpr int side = 4;
    const int end = std::min(first + VisibleFacets::rows_per_band, height_);
    std::vector<Part> parts;
    std::vector<int> rows;
    std::vector<PictureGather::Place> places;
    const auto visit = [&](int x, int y) {
        visible_.visit_pixel(
            band, x, y, false,
            [&](std::uint32_t half, const Vec2& place, unsigned sample, unsigned count) {
                const Vec3 direction = visible_.direction(place);
                const Hit hit = visible_.hit_at(half, direction);
                const std::uint32_t patch = mesh_.patch_at(hit);
                const Vec3 position = visible_.eye() + hit.t * direction;
                const auto [reflectance, emission] =
                    pixel_colours(mesh_, visible_, half, patch, place);
                parts.push_back({.position = glm::vec3(position),
                                 .reflectance = glm::vec3(reflectance),
                                 .emission = glm::vec3(emission),
                                 .patch = patch,
                                 .share = float(count) / float(offsets_.size()),
                                 .x = x});
                rows.push_back(y);
                places.push_back(
                    {{position, mesh_.patches()[patch].normal, hit.facet}, place, sample, count});
            });
    };
    for (int top = first; top < end; top += side)
        for (int left = 0; left < width_; left += side)
            for (int y = top; y < std::min(top + side, end); ++y)
                for (int x = left; x < std::min(left + side, width_); ++x)
                    visit(x, y);
    const std::vector<PictureGather::Light> lights = gather_.irradiance(places);
    for (std::size_t k = 0; k < parts.size(); ++k) {
        parts[k].direct = glm::vec3(lights[k].direct.arriving);
        parts[k].unshadowed = glm::vec3(lights[k].direct.unshadowed);
        parts[k].smooth_unshadowed = glm::vec3(lights[k].slow.unshadowed);
        parts[k].indirect = glm::vec3(lights[k].slow.indirect);
        if (places[k].count == offsets_.size())
            whole_[index(parts[k].x, rows[k])] = parts[k];
        else
            parts_[static_cast<std::size_t>(rows[k])].push_back(parts[k]);
    }
}

/// Parts of pixels count where the pixel itself is one: a strip narrower than a pixel shows nothing
/// else.
glm::vec3 GatheredPicture::direct_light(const Part& part, int y) const {
    const Vec3& normal = mesh_.patches()[part.patch].normal;
    glm::vec3 arriving(0.0f), unshadowed(0.0f);
    const auto add = [&](const Part& from, float weight) {
        if (from.share == 0 || (from.patch != part.patch &&
                                !is_same_surface(Vec3(part.position), normal, Vec3(from.position),
                                                 mesh_.patches()[from.patch].normal)))
            return;
        weight *= from.share;
        arriving += weight * from.direct;
        unshadowed += weight * from.unshadowed;
    };
    const int left = std::max(part.x - half_window, 0),
              right = std::min(part.x + half_window, width_ - 1);
    for (int row = std::max(y - half_window, 0); row <= std::min(y + half_window, height_ - 1);
         ++row) {
        for (int x = left; x <= right; ++x)
            add(whole_[index(x, row)], weight_at(x - part.x) * weight_at(row - y));
        if (part.share == 1)
            continue;
        const std::vector<Part>& parts = parts_[static_cast<std::size_t>(row)];
        for (auto there = std::ranges::lower_bound(parts, left, {}, &Part::x);
             there != parts.end() && there->x <= right; ++there)
            add(*there, weight_at(there->x - part.x) * weight_at(row - y));
    }
    glm::vec3 light(0.0f);
    for (int c = 0; c < 3; ++c)
        if (unshadowed[c] > 0)
            light[c] = part.smooth_unshadowed[c] * (arriving[c] / unshadowed[c]);
    return light;
}

glm::vec3 GatheredPicture::radiosity(const Part& part, int y) const {
    return part.emission + part.reflectance * (direct_light(part, y) + part.indirect);
}

} // namespace hemilux
