#include "radiosity/answers/pictures/picture_error.h"

#include "parallel/workers.h"
#include "radiosity/light/cached_light/local_error.h"
#include "radiosity/light/final_gather/final_gather.h"
#include "radiosity/paper/sampling/rng.h"
#include "radiosity/paper/scene/mesh.h"
#include "radiosity/paper/solving/stop_flag.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace hemilux {
namespace {

/// The number of places in a pixel for each of the two estimates.
constexpr std::size_t places_in_pixel = 8;

/// The number of parts of the picture whose errors are told apart.
constexpr std::size_t parts_of_picture = 64;

using Place = JudgedPixel::Place;

/// Returns what a ray shows, in the colours that panes on the way leave of it.
std::optional<Place> place_at(const Mesh& mesh, const Tracer& tracer, const Ray& ray) {
    const std::optional<Visible> visible = look(mesh, tracer.of_facets(), ray);
    if (!visible)
        return std::nullopt;
    const Patch& patch = mesh.patches()[visible->patch];
    const Vec3 point = ray.origin + visible->hit.t * ray.direction;
    const Colours colours = colours_at(mesh, patch, point);
    const double passed = tracer.passed_up_to(ray, visible->hit.t);
    return Place{{point, patch.normal, patch.facet},
                 {passed * colours.reflectance, passed * colours.emission}};
}

/// Returns the places of a pixel, if it shows one side of one facet; else none.
std::vector<Place> places_of(const Mesh& mesh, const Tracer& tracer, const CameraRays& camera,
                             const Vec2& corner, const Vec2& size, Rng& rng) {
    const auto look_through = [&](double dx, double dy) {
        return place_at(mesh, tracer,
                        camera.ray((corner.x + dx) / size.x, (corner.y + dy) / size.y));
    };
    const auto first = look_through(.5, .5);
    if (!first || first->colours.reflectance == Vec3(0.0))
        return {};
    for (const Vec2& to : {Vec2(0, 0), Vec2(1, 0), Vec2(0, 1), Vec2(1, 1)})
        if (const auto there = look_through(to.x, to.y);
            !there || there->at.facet != first->at.facet || there->at.normal != first->at.normal)
            return {};
    std::vector<Place> places;
    for (std::size_t k = 0; k < 2 * places_in_pixel; ++k) {
        const double dx = rng.uniform(), dy = rng.uniform();
        places.push_back(look_through(dx, dy).value_or(*first));
    }
    return places;
}

std::vector<JudgedPixel> pixels_of(const Mesh& mesh, const Tracer& tracer, const CameraRays& camera,
                                   int width, int height, std::size_t count, std::uint64_t seed) {
    const double side = std::max(1.0, std::sqrt(double(width) * double(height) / double(count)));
    std::vector<JudgedPixel> pixels;
    Rng rng(seed);
    for (double top = 0; top < height; top += side)
        for (double left = 0; left < width; left += side) {
            const double u = rng.uniform(), v = rng.uniform();
            const int x = static_cast<int>(left + u * side), y = static_cast<int>(top + v * side);
            if (x >= width || y >= height)
                continue;
            std::vector<Place> places =
                places_of(mesh, tracer, camera, {x, y}, {width, height}, rng);
            if (!places.empty())
                pixels.push_back({static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                                      static_cast<std::size_t>(x),
                                  std::move(places)});
        }
    return pixels;
}

} // namespace

PictureJudge judge_of_pictures(const Mesh& mesh, const Tracer& tracer, const SurfaceLight& light,
                               const CameraRays& camera, int width, int height,
                               std::uint64_t seed) {
    return {mesh, tracer, light,
            [&mesh, &tracer, &camera, width, height](std::size_t count, const Image&,
                                                     std::uint64_t of) {
                return pixels_of(mesh, tracer, camera, width, height, count, of);
            },
            seed};
}

/// Returns the number of rays that it took; nothing where it was ended.
std::optional<std::uint64_t> PictureJudge::estimate_more(const Image& picture, std::size_t pixels,
                                                         const Workers& workers,
                                                         const GoOn& go_on) {
    constexpr std::size_t places = 2 * places_in_pixel;
    constexpr std::size_t points_at_once = 2048; // some ten thousand rays
    const std::uint64_t seed = hash_words({seed_, asked_});
    const std::vector<JudgedPixel> chosen = choice_(pixels - asked_, picture, seed);
    const auto place_of = [](const JudgedPixel& pixel, std::size_t j) -> const Place& {
        return pixel.places[pixel.places.size() == 1 ? 0 : j];
    };
    std::vector<SurfacePoint> at;
    std::vector<std::uint64_t> streams;
    for (const JudgedPixel& pixel : chosen)
        for (std::size_t j = 0; j < places; ++j) {
            at.push_back(place_of(pixel, j).at);
            streams.push_back(hash_words({seed, at.size()}));
        }
    FinalGather gather(mesh_, tracer_, light_);
    gather.set_only_reflected(only_reflected_);
    const StopFlag never;
    std::vector<Vec3> irradiance;
    while (irradiance.size() < at.size()) {
        const std::size_t begin = irradiance.size();
        if (go_on && !go_on(double(begin) / double(at.size())))
            return std::nullopt;
        const std::size_t count = std::min(points_at_once, at.size() - begin);
        const std::vector<Vec3> some =
            gather.irradiance(std::span(at).subspan(begin, count),
                              std::span(streams).subspan(begin, count), 1, workers, never);
        irradiance.insert(irradiance.end(), some.begin(), some.end());
    }
    asked_ = pixels;
    std::size_t next = 0;
    for (const JudgedPixel& pixel : chosen) {
        Estimates& found =
            known_.emplace_back(Estimates{.pixel = pixel.pixel, .weight = pixel.weight});
        for (std::size_t j = 0; j < places; ++j, ++next) {
            const Colours& colours = place_of(pixel, j).colours;
            found.reflected.at(j / places_in_pixel) +=
                colours.reflectance * irradiance[next] / double(places_in_pixel);
            found.emitted.at(j / places_in_pixel) += colours.emission / double(places_in_pixel);
        }
    }
    return gather.rays();
}

std::optional<PictureError> PictureJudge::error_of(const Image& picture, std::size_t pixels,
                                                   const Workers& workers, const GoOn& go_on) {
    std::uint64_t rays = 0;
    if (pixels > asked_) {
        const std::optional<std::uint64_t> taken = estimate_more(picture, pixels, workers, go_on);
        if (!taken)
            return std::nullopt;
        rays = *taken;
    }
    double products = 0, squares = 0, size = 0, weights = 0;
    LocalErrors parts;
    const std::size_t of_part = (known_.size() + parts_of_picture - 1) / parts_of_picture;
    double part_products = 0, part_size = 0, part_weight = 0;
    for (std::size_t k = 0; k < known_.size(); ++k) {
        const auto& [pixel, weight, reflected, emitted] = known_[k];
        const Vec3 shown(picture.pixels[pixel]);
        const double product = weight * glm::dot(reflected[0] + emitted[0] - shown,
                                                 reflected[1] + emitted[1] - shown),
                     light = weight * glm::dot(reflected[0], reflected[1]);
        products += product;
        squares += product * product;
        size += light;
        weights += weight;
        part_products += product;
        part_size += light;
        part_weight += weight;
        if ((k + 1) % of_part == 0 || k + 1 == known_.size())
            parts.add(std::exchange(part_products, 0.0), std::exchange(part_size, 0.0),
                      std::exchange(part_weight, 0.0));
    }
    if (!(size > 0))
        return PictureError{.rays = rays};
    const double square = std::max(products / size, 0.0), sigma = std::sqrt(squares) / size;
    const double error = std::sqrt(square);
    return PictureError{.error = error,
                        .uncertainty = std::sqrt(square + sigma) - error,
                        .bound = std::sqrt(square + sigmas_of_bound_ * sigma),
                        .local = parts.within(),
                        .level = std::sqrt(size / (3 * weights)),
                        .rays = rays};
}

} // namespace hemilux
