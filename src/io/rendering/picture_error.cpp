#include "io/rendering/picture_error.h"

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

/// Returns the places of a pixel, if it shows one side of one facet.
JudgedPixel judged_pixel(const Mesh& mesh, const Tracer& tracer, const CameraRays& camera,
                         const Image& picture, int x, int y, Rng& rng) {
    const auto look_through = [&](double dx, double dy) {
        return place_at(mesh, tracer,
                        camera.ray((x + dx) / picture.width, (y + dy) / picture.height));
    };
    JudgedPixel pixel{{}, Vec3(picture.pixels[picture.index(x, y)])};
    const auto first = look_through(.5, .5);
    if (!first || first->colours.reflectance == Vec3(0.0))
        return pixel;
    for (const Vec2& to : {Vec2(0, 0), Vec2(1, 0), Vec2(0, 1), Vec2(1, 1)})
        if (const auto corner = look_through(to.x, to.y);
            !corner || corner->at.facet != first->at.facet || corner->at.normal != first->at.normal)
            return pixel;
    for (std::size_t k = 0; k < 2 * places_in_pixel; ++k) {
        const double dx = rng.uniform(), dy = rng.uniform();
        pixel.places.push_back(look_through(dx, dy).value_or(*first));
    }
    return pixel;
}

} // namespace

PictureError picture_error(const Mesh& mesh, const Tracer& tracer, const SurfaceLight& light,
                           const CameraRays& camera, const Image& picture, std::size_t count,
                           std::uint64_t seed, const Workers& workers) {
    const double side =
        std::max(1.0, std::sqrt(double(picture.width) * double(picture.height) / double(count)));
    std::vector<JudgedPixel> pixels;
    Rng rng(seed);
    for (double top = 0; top < picture.height; top += side)
        for (double left = 0; left < picture.width; left += side) {
            const double u = rng.uniform(), v = rng.uniform();
            const int x = static_cast<int>(left + u * side), y = static_cast<int>(top + v * side);
            if (x >= picture.width || y >= picture.height)
                continue;
            JudgedPixel pixel = judged_pixel(mesh, tracer, camera, picture, x, y, rng);
            if (!pixel.places.empty())
                pixels.push_back(std::move(pixel));
        }
    return error_of_pixels(mesh, tracer, light, pixels, seed, false, workers);
}

PictureError error_of_pixels(const Mesh& mesh, const Tracer& tracer, const SurfaceLight& light,
                             std::span<const JudgedPixel> pixels, std::uint64_t seed,
                             bool only_reflected, const Workers& workers) {
    constexpr std::size_t places = 2 * places_in_pixel;
    const auto place_of = [](const JudgedPixel& pixel, std::size_t j) -> const Place& {
        return pixel.places[pixel.places.size() == 1 ? 0 : j];
    };
    std::vector<SurfacePoint> at;
    std::vector<std::uint64_t> streams;
    for (const JudgedPixel& pixel : pixels)
        for (std::size_t j = 0; j < places; ++j) {
            at.push_back(place_of(pixel, j).at);
            streams.push_back(hash_words({seed, at.size()}));
        }
    FinalGather gather(mesh, tracer, light);
    gather.set_only_reflected(only_reflected);
    const StopFlag never;
    const std::vector<Vec3> irradiance = gather.irradiance(at, streams, 1, workers, never);
    double products = 0, squares = 0, size = 0;
    LocalErrors parts;
    const std::size_t of_part = (pixels.size() + parts_of_picture - 1) / parts_of_picture;
    double part_products = 0, part_size = 0;
    for (std::size_t k = 0, next = 0; k < pixels.size(); ++k) {
        std::array<Vec3, 2> off{}, reflected{};
        for (std::size_t j = 0; j < places; ++j, ++next) {
            const Colours& colours = place_of(pixels[k], j).colours;
            const Vec3 here = colours.reflectance * irradiance[next] / double(places_in_pixel);
            reflected.at(j / places_in_pixel) += here;
            off.at(j / places_in_pixel) +=
                here + (colours.emission - pixels[k].shown) / double(places_in_pixel);
        }
        const double product = glm::dot(off[0], off[1]);
        products += product;
        squares += product * product;
        size += glm::dot(reflected[0], reflected[1]);
        part_products += product;
        part_size += glm::dot(reflected[0], reflected[1]);
        if ((k + 1) % of_part == 0 || k + 1 == pixels.size())
            parts.add(std::exchange(part_products, 0.0), std::exchange(part_size, 0.0));
    }
    if (!(size > 0))
        return {.rays = gather.rays()};
    const double square = std::max(products / size, 0.0), sigma = std::sqrt(squares) / size;
    const double error = std::sqrt(square);
    return {error, std::sqrt(square + sigma) - error, parts.within(), gather.rays()};
}

} // namespace hemilux
