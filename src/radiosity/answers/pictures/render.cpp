#include "radiosity/answers/pictures/render.h"

#include "geometry/numeric.h"
#include "parallel/asked_to_end.h"
#include "parallel/workers.h"
#include "radiosity/answers/pictures/gathered_picture.h"
#include "radiosity/answers/pictures/picture_gather.h"
#include "radiosity/answers/pictures/pixel_colours.h"
#include "radiosity/answers/pictures/visible_facets.h"
#include "radiosity/answers/vertices/smooth.h"
#include "radiosity/engine/rays/panes.h"
#include "radiosity/light/cached_light/surface_light.h"
#include "radiosity/light/textures/scene_textures.h"
#include "radiosity/paper/scene/mesh.h"
#include "radiosity/paper/solution/solution.h"

#include <algorithm>
#include <cmath>
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

int squares(int pixels, int side) { return (pixels + side - 1) / side; }

/// Returns the samples of a picture of squares, as many as its columns and rows.
SampleGrid grid_of(int width, int height, int square) {
    return {squares(width, square), squares(height, square), double(square) / width,
            double(square) / height};
}

/// Renders the light of the patches at what each pixel or square shows.
Image shaded_picture(const VisibleFacets& visible, const SampleGrid& grid, const Shading& shading,
                     const Tracer* panes, const RenderOptions& options,
                     const std::function<void()>& check) {
    Image image(grid.columns, grid.rows);
    const unsigned samples = options.square > 1 ? 1 : static_cast<unsigned>(options.samples);
    const auto pixel = [&](const VisibleFacets::Band& band, int x, int y) {
        Vec3 sum(0.0);
        visible.visit_pixel(band, x, y, !options.smooth,
                            [&](std::uint32_t half, const Vec2& place, unsigned, unsigned count) {
                                sum += double(count) * shading.at(visible, half, place);
                            });
        return glm::vec3(sum / double(samples));
    };
    visible.for_each_band(
        Workers(options.threads), check, [&](const VisibleFacets::Band& band, int first, int end) {
            for (int y = first; y < end; ++y)
                for (int x = 0; x < grid.columns; ++x) {
                    image.at(x, y) = pixel(band, x, y);
                    if (panes)
                        image.at(x, y) *= float(passed_through_panes(visible, *panes, band, x, y));
                }
        });
    return image;
}

/// Returns a picture each of whose squares has the colour of a pixel.
Image enlarged(const Image& image, int square, int width, int height) {
    Image large(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            large.at(x, y) = image.at(x / square, y / square);
    return large;
}

/// What pictures of both kinds need to know of the scene and the camera.
struct View {
    const Mesh& mesh;
    const Tracer& tracer;
    CameraRays rays;
    std::vector<Vec2> offsets;
    SampleGrid grid;
    VisibleFacets visible;

    View(const Mesh& mesh_, const Tracer& tracer_, const Camera& camera,
         const RenderOptions& options, int square)
        : mesh(mesh_), tracer(tracer_), rays(camera, mesh_, double(options.width) / options.height),
          offsets(square > 1 ? std::vector{Vec2(.5)} : pixel_samples(options.samples)),
          grid(grid_of(options.width, options.height, square)),
          visible(mesh, rays, grid, offsets, options.threads) {}
    View(const View&) = delete;
    View& operator=(const View&) = delete;

    [[nodiscard]] const Tracer* panes() const {
        return panes_of(mesh.scene()).empty() ? nullptr : &tracer;
    }
};

std::function<void()> check_of(const RenderOptions& options) {
    return [&options] {
        if (options.give_up && options.give_up())
            throw Interrupted();
    };
}

void check_size(const RenderOptions& options) {
    if (options.width < 1 || options.height < 1 || options.samples < 1 || options.square < 1)
        throw std::invalid_argument("a picture needs at least one pixel and one sample");
}

} // namespace

Image render(const Mesh& mesh, const Tracer& tracer, std::span<const Vec3> radiosity,
             const Camera& camera, const RenderOptions& options) {
    check_size(options);
    if (options.gather > 0) {
        RowsOfPicture found = render_rows(mesh, tracer, radiosity, camera, options);
        if (found.rows < options.height)
            throw Interrupted();
        return std::move(found.image);
    }
    const std::function<void()> check = check_of(options);
    check(); // before it takes much memory
    const View view(mesh, tracer, camera, options, options.square);
    Image image = shaded_picture(view.visible, view.grid, Shading(mesh, radiosity, options),
                                 view.panes(), options, check);
    return options.square > 1 ? enlarged(image, options.square, options.width, options.height)
                              : std::move(image);
}

RowsOfPicture render_rows(const Mesh& mesh, const Tracer& tracer, std::span<const Vec3> radiosity,
                          const Camera& camera, const RenderOptions& options) {
    check_size(options);
    const Workers workers(options.threads);
    const std::function<void()> check = check_of(options);
    try {
        check(); // before it takes much memory
        const View view(mesh, tracer, camera, options, 1);
        PictureGather gather(
            mesh, tracer, SurfaceLight(mesh, PatchLight(radiosity, options.slope), options.cells),
            view.rays, options.width, options.height,
            {.rays = options.gather,
             .shadow_rays = options.coarse_rays > 0 ? options.gather : options.gather / 2,
             .samples = static_cast<unsigned>(options.samples),
             .round = options.gather_round,
             .coarse_rays = options.coarse_rays,
             .check = check},
            workers);
        check();
        return gathered_picture(mesh, view.visible, gather, view.panes(), view.offsets,
                                options.width, options.height, {check, options.rows_done}, workers);
    } catch (const Interrupted&) {
        return {};
    }
}

int square_for_speed(int width, int height, double squares) {
    return std::max(1, static_cast<int>(std::ceil(std::sqrt(double(width) * height / squares))));
}

double exposure_of(const Image& picture, const Mesh& mesh, const Tracer& tracer,
                   const Camera& camera, unsigned threads, int square) {
    std::vector<Vec3> emission;
    for (std::uint32_t i = 0; i < mesh.patches().size(); ++i)
        emission.push_back(mesh.material(i).emission);
    const RenderOptions options{.width = picture.width,
                                .height = picture.height,
                                .samples = 1,
                                .textures = true,
                                .smooth = false,
                                .threads = threads,
                                .square = square};
    const View view(mesh, tracer, camera, options, square);
    const Image emitted = shaded_picture(view.visible, view.grid, Shading(mesh, emission, options),
                                         view.panes(), options, [] {});
    if (square == 1)
        return auto_exposure(picture, emitted);
    Image middles(emitted.width, emitted.height);
    for (int y = 0; y < middles.height; ++y)
        for (int x = 0; x < middles.width; ++x)
            middles.at(x, y) = picture.at(std::min(x * square + square / 2, picture.width - 1),
                                          std::min(y * square + square / 2, picture.height - 1));
    return auto_exposure(middles, emitted);
}

} // namespace hemilux
