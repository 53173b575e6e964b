#include "io/rendering/render.h"

#include "geometry/numeric.h"
#include "io/files/error.h"
#include "io/rendering/gathered_picture.h"
#include "io/rendering/picture_gather.h"
#include "io/rendering/pixel_colours.h"
#include "io/rendering/visible_facets.h"
#include "io/results/smooth.h"
#include "parallel/workers.h"
#include "radiosity/engine/rays/panes.h"
#include "radiosity/light/cached_light/surface_light.h"
#include "radiosity/light/textures/scene_textures.h"
#include "radiosity/paper/scene/mesh.h"
#include "radiosity/paper/solution/solution.h"

#include <functional>
#include <optional>
#include <stdexcept>
#include <vector>

namespace hemilux {
namespace {

/// Returns places in a pixel with both coordinates well spread: the set of Hammersley 1960, moved
/// so that none lies on the border.
std::vector<Vec2> pixel_samples(int count) {
    std::vector<Vec2> places;
    for (int i = 0; i < count; ++i) {
        double reversed = 0.5 / count, digit = 0.5;
        for (int bits = i; bits > 0; bits >>= 1, digit *= 0.5)
            reversed += digit * (bits & 1);
        places.emplace_back((i + 0.5) / count, reversed);
    }
    return places;
}

/// The radiosity at a point of a patch. Where textures show, the irradiance, which does not depend
/// on them, is interpolated over their patches.
class Shading {
  public:
    Shading(const Mesh& mesh, std::span<const Vec3> radiosity, const RenderOptions& options)
        : mesh_(mesh), radiosity_(radiosity), classes_(options.classes),
          textures_(options.textures && !textures_of(mesh.scene()).of_material.empty()) {
        std::vector<Slope> slopes(options.slope.begin(), options.slope.end());
        if (textures_)
            divide_by_textures(slopes);
        if (!options.smooth)
            return;
        if (!classes_)
            classes_ = &own_classes_.emplace(find_corner_classes(mesh));
        corner_radiosity_ = smooth(mesh, *classes_, radiosity_, slopes, MeanOver::corners);
    }
    Shading(const Shading&) = delete;
    Shading& operator=(const Shading&) = delete;

    /// Returns the radiosity of what a half of a facet shows around a place.
    Vec3 at(const VisibleFacets& visible, std::uint32_t half, const Vec2& place) const {
        const Vec3 direction = visible.direction(place);
        const Hit hit = visible.hit_at(half, direction);
        const std::uint32_t patch = mesh_.patch_at(hit);
        const Vec3 light = at(patch, visible.eye() + hit.t * direction);
        if (!textures_ || !mesh_.scene().colours_vary_on(mesh_.patches()[patch].material))
            return light;
        const auto [reflectance, emission] = pixel_colours(mesh_, visible, half, patch, place);
        return emission + reflectance * light;
    }

    Vec3 at(std::uint32_t patch, const Vec3& point) const {
        if (corner_radiosity_.empty())
            return radiosity_[patch];
        const auto weights = corner_weights(mesh_.patches()[patch].shape, point);
        Vec3 sum(0.0);
        for (std::size_t c = 0; c < weights.size(); ++c)
            sum += weights[c] * corner_radiosity_[classes_->of_patch[patch][c]];
        return sum;
    }

  private:
    void divide_by_textures(std::vector<Slope>& slopes) {
        irradiance_.assign(radiosity_.begin(), radiosity_.end());
        for (std::uint32_t i = 0; i < irradiance_.size(); ++i) {
            if (!mesh_.scene().colours_vary_on(mesh_.patches()[i].material))
                continue;
            const Material& material = mesh_.material(i);
            irradiance_[i] =
                ratio_or_zero(irradiance_[i] - material.emission, material.reflectance);
            if (!slopes.empty())
                slopes[i] = {ratio_or_zero(slopes[i].x, material.reflectance),
                             ratio_or_zero(slopes[i].y, material.reflectance)};
        }
        radiosity_ = irradiance_;
    }

    const Mesh& mesh_;
    std::span<const Vec3> radiosity_; ///< irradiance of textured patches where textures show
    const CornerClasses* classes_;
    bool textures_;
    std::vector<Vec3> irradiance_;
    std::optional<CornerClasses> own_classes_;
    std::vector<Vec3> corner_radiosity_;
};

/// Renders the light of the patches at what each pixel shows.
Image shaded_picture(const VisibleFacets& visible, const Shading& shading,
                     const RenderOptions& options, const std::function<void()>& check) {
    Image image(options.width, options.height);
    const auto pixel = [&](const VisibleFacets::Band& band, int x, int y) {
        Vec3 sum(0.0);
        visible.visit_pixel(band, x, y, !options.smooth,
                            [&](std::uint32_t half, const Vec2& place, unsigned, unsigned count) {
                                sum += double(count) * shading.at(visible, half, place);
                            });
        return glm::vec3(sum / double(options.samples));
    };
    visible.for_each_band(Workers(options.threads), check,
                          [&](const VisibleFacets::Band& band, int first, int end) {
                              for (int y = first; y < end; ++y)
                                  for (int x = 0; x < options.width; ++x)
                                      image.at(x, y) = pixel(band, x, y);
                          });
    return image;
}

/// Multiplies each pixel by what the panes before its surfaces let through, in the mean over its
/// samples.
void dim_behind_panes(Image& image, const VisibleFacets& visible, const Tracer& tracer,
                      const RenderOptions& options, const std::function<void()>& check) {
    const auto passed = [&](const VisibleFacets::Band& band, int x, int y) {
        double sum = 0;
        unsigned samples = 0;
        visible.visit_pixel(
            band, x, y, true, [&](std::uint32_t half, const Vec2& place, unsigned, unsigned count) {
                const Vec3 way = visible.direction(place);
                sum += count * tracer.passed({.origin = visible.eye(),
                                              .direction = way,
                                              .t_max = visible.hit_at(half, way).t});
                samples += count;
            });
        return samples > 0 ? sum / samples : 1;
    };
    visible.for_each_band(Workers(options.threads), check,
                          [&](const VisibleFacets::Band& band, int first, int end) {
                              for (int y = first; y < end; ++y)
                                  for (int x = 0; x < options.width; ++x)
                                      image.at(x, y) *= static_cast<float>(passed(band, x, y));
                          });
}

} // namespace

Image render(const Mesh& mesh, const Tracer& tracer, std::span<const Vec3> radiosity,
             const Camera& camera, const RenderOptions& options) {
    if (options.width < 1 || options.height < 1 || options.samples < 1)
        throw std::invalid_argument("a picture needs at least one pixel and one sample");
    const double width = options.width, height = options.height;
    const CameraRays rays(camera, mesh, width / height);
    const std::vector<Vec2> offsets = pixel_samples(options.samples);
    const VisibleFacets visible(mesh, rays, {options.width, options.height, 1 / width, 1 / height},
                                offsets, options.threads);
    const std::function<void()> check = [&] {
        if (options.give_up && options.give_up())
            throw Interrupted();
    };
    const auto behind_panes = [&](Image image) {
        if (!panes_of(mesh.scene()).empty())
            dim_behind_panes(image, visible, tracer, options, check);
        return image;
    };
    if (options.gather == 0)
        return behind_panes(
            shaded_picture(visible, Shading(mesh, radiosity, options), options, check));
    const auto samples = static_cast<unsigned>(options.samples);
    const PictureGather gather(
        mesh, tracer, SurfaceLight(mesh, PatchLight(radiosity, options.slope), options.cells), rays,
        options.width, options.height,
        {.rays = options.gather,
         .shadow_rays = options.coarse_rays > 0 ? options.gather : options.gather / 2,
         .samples = samples,
         .round = options.gather_round,
         .coarse_rays = options.coarse_rays,
         .check = check},
        Workers(options.threads));
    return behind_panes(gathered_picture(mesh, visible, gather, offsets, options.width,
                                         options.height, check, Workers(options.threads)));
}

double exposure_of(const Image& picture, const Mesh& mesh, const Tracer& tracer,
                   const Camera& camera, unsigned threads) {
    std::vector<Vec3> emission;
    for (std::uint32_t i = 0; i < mesh.patches().size(); ++i)
        emission.push_back(mesh.material(i).emission);
    return auto_exposure(picture, render(mesh, tracer, emission, camera,
                                         {.width = picture.width,
                                          .height = picture.height,
                                          .samples = 1,
                                          .textures = true,
                                          .smooth = false,
                                          .threads = threads}));
}

} // namespace hemilux
