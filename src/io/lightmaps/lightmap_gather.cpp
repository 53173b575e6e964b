#include "io/lightmaps/lightmap_gather.h"

#include "io/rendering/picture_gather.h"
#include "parallel/workers.h"
#include "radiosity/paper/sampling/rng.h"
#include "radiosity/paper/scene/mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace hemilux {
namespace {

/// Returns the points of the grid: each is in the middle of four texels, on the triangle of that
/// which lies nearest to its own, of those that are not covered.
GatherGrid grid_of(const TexelMap& texels, const std::vector<bool>& covered,
                   const Workers& workers) {
    constexpr int step = GatherGrid::step;
    const int size = texels.size(), columns = (size + step - 1) / step;
    std::vector<GridPoint> points(static_cast<std::size_t>(columns) *
                                  static_cast<std::size_t>(columns));
    workers.for_chunks(points.size(), 1024, [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k) {
            const int left = step * static_cast<int>(k % static_cast<std::size_t>(columns)),
                      top = step * static_cast<int>(k / static_cast<std::size_t>(columns));
            GridPoint& point = points[k];
            point.at.facet = none;
            float least = std::numeric_limits<float>::infinity();
            std::size_t nearest = 0;
            for (int y = top; y < std::min(top + step, size); ++y)
                for (int x = left; x < std::min(left + step, size); ++x)
                    if (const std::size_t texel = texels.index(x, y);
                        texels.shows(texel) && !covered[texel] && texels.distance(texel) < least) {
                        least = texels.distance(texel);
                        nearest = texel;
                    }
            if (!(least <= TexelMap::reach))
                continue;
            point.at = texels.receiver_near(nearest, Vec2(left, top) + step / 2.0);
            point.part = texels.triangle(nearest).chart;
        }
    });
    return {columns, columns, std::move(points)};
}

/// Returns the irradiance of a place: the share of direct light that arrives is that of its own
/// shadow rays. An average over texels around, as pictures take, would move shadows by texels.
Vec3 irradiance_of(const PictureGather::Light& light) {
    Vec3 irradiance = Vec3(light.slow.indirect) + light.of_points;
    for (int c = 0; c < 3; ++c)
        if (light.direct.unshadowed[c] > 0)
            irradiance[c] += double(light.slow.unshadowed[c]) *
                             (light.direct.arriving[c] / light.direct.unshadowed[c]);
    return irradiance;
}

/// Returns what of the irradiance at a texel counts.
Vec3 factor_of(const Mesh& mesh, const SurfacePoint& at, Bake bake) {
    return bake == Bake::radiosity
               ? colours_at(mesh, mesh.patches()[at.patch], at.position).reflectance
               : Vec3(1.0);
}

} // namespace

Vec3 radiosity_of(const Mesh& mesh, const SurfacePoint& at, const Vec3& irradiance) {
    const auto [reflectance, emission] = colours_at(mesh, mesh.patches()[at.patch], at.position);
    return emission + reflectance * irradiance;
}

GatheredLightmap gather_lightmap(const Mesh& mesh, const Tracer& tracer, const SurfaceLight& light,
                                 const TexelMap& texels, const std::vector<bool>& covered,
                                 const LightmapOptions& options, const Workers& workers) {
    constexpr std::size_t rows_at_a_time = 4;
    const PictureGather gather(mesh, tracer, light, grid_of(texels, covered, workers),
                               {.rays = options.rays,
                                .samples = 1,
                                .round = options.round,
                                .gathers_coarse = true,
                                .only_reflected = options.bake == Bake::indirect,
                                .check = options.check},
                               workers);
    const int size = texels.size();
    GatheredLightmap lightmap{Image(size, size), std::vector<bool>(texels.count())};
    for (std::size_t k = 0; k < lightmap.known.size(); ++k)
        lightmap.known[k] = texels.shows(k) && !covered[k];
    const auto gather_rows = [&](int first, int end) {
        std::vector<PictureGather::Place> places;
        std::vector<std::size_t> which;
        for (int y = first; y < end; ++y)
            for (int x = 0; x < size; ++x) {
                const std::size_t texel = texels.index(x, y);
                if (!lightmap.known[texel])
                    continue;
                places.push_back({texels.receiver(texel), Vec2(x + .5, y + .5), 0, 1,
                                  texels.triangle(texel).chart});
                which.push_back(texel);
            }
        const std::vector<PictureGather::Light> lights = gather.irradiance(places);
        for (std::size_t k = 0; k < which.size(); ++k) {
            const Vec3 irradiance = irradiance_of(lights[k]);
            lightmap.image.pixels[which[k]] =
                glm::vec3(options.bake == Bake::radiosity
                              ? radiosity_of(mesh, texels.point(which[k]), irradiance)
                              : irradiance);
        }
    };
    workers.for_chunks(static_cast<std::size_t>(size), rows_at_a_time,
                       [&](std::size_t begin, std::size_t end) {
                           options.check();
                           gather_rows(static_cast<int>(begin), static_cast<int>(end));
                       });
    return lightmap;
}

GatheredLightmap lightmap_of_patches(const Mesh& mesh, const SurfaceLight& light,
                                     const TexelMap& texels, Bake bake) {
    GatheredLightmap lightmap{Image(texels.size(), texels.size()),
                              std::vector<bool>(texels.count())};
    for (std::size_t k = 0; k < texels.count(); ++k) {
        if (!texels.shows(k))
            continue;
        const SurfacePoint at = texels.point(k);
        const Vec3 arriving = light.irradiance(at.patch, at.position).value;
        lightmap.known[k] = true;
        lightmap.image.pixels[k] =
            glm::vec3(bake == Bake::radiosity ? radiosity_of(mesh, at, arriving) : arriving);
    }
    return lightmap;
}

/// Goes outwards ring by ring: each texel takes the mean of its known neighbours.
void fill_texels(GatheredLightmap& lightmap, const TexelMap& texels, int margin) {
    Image& image = lightmap.image;
    std::vector<int> ring(texels.count(), -1);
    const auto chart_of = [&](std::size_t texel) {
        return texels.shows(texel) ? texels.triangle(texel).chart : none;
    };
    const auto visit_around = [&](int x, int y, const auto& visit) {
        for (int row = std::max(y - 1, 0); row <= std::min(y + 1, image.height - 1); ++row)
            for (int column = std::max(x - 1, 0); column <= std::min(x + 1, image.width - 1);
                 ++column)
                if (row != y || column != x)
                    visit(column, row);
    };
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            if (lightmap.known[image.index(x, y)])
                ring[image.index(x, y)] = 0;
    // A covered texel takes from its chart, however far that is; one outside of charts from any.
    const auto takes_from = [&](std::size_t to, std::size_t from) {
        return chart_of(to) == none || chart_of(to) == chart_of(from);
    };
    std::vector<std::pair<int, int>> open;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            if (ring[image.index(x, y)] < 0)
                open.emplace_back(x, y);
    for (int number = 1; !open.empty(); ++number) {
        std::vector<std::pair<int, int>> left;
        std::vector<std::pair<std::size_t, glm::vec3>> filled;
        for (const auto& [x, y] : open) {
            const std::size_t to = image.index(x, y);
            if (chart_of(to) == none && number > margin)
                continue;
            glm::vec3 sum(0.0f);
            float count = 0;
            visit_around(x, y, [&](int column, int row) {
                const std::size_t from = image.index(column, row);
                if (ring[from] < 0 || !takes_from(to, from))
                    return;
                sum += image.pixels[from];
                ++count;
            });
            if (count > 0)
                filled.emplace_back(to, sum / count);
            else
                left.emplace_back(x, y);
        }
        if (filled.empty())
            break;
        for (const auto& [texel, light] : filled) {
            image.pixels[texel] = light;
            ring[texel] = number;
        }
        open = std::move(left);
    }
}

std::vector<TargetPart> lightmap_parts(const Mesh& mesh, const TexelMap& texels,
                                       const std::vector<bool>& covered, Bake bake,
                                       std::uint64_t seed) {
    constexpr double parts = 512;
    constexpr int places = 16;
    constexpr double reach = 4; // [texels]
    std::vector<std::size_t> shown;
    for (std::size_t k = 0; k < texels.count(); ++k)
        if (texels.shows(k) && texels.is_inside(k) && !covered[k] &&
            (bake != Bake::radiosity ||
             mesh.material(texels.point(k).patch).reflectance != Vec3(0.0)))
            shown.push_back(k);
    std::vector<TargetPart> all;
    const double each = std::max(1.0, double(shown.size()) / parts);
    const auto size = static_cast<std::size_t>(texels.size());
    for (double next = 0; next < double(shown.size()); next += each) {
        Rng rng(hash_words({seed, all.size()}));
        const std::size_t first = shown[std::min(
            static_cast<std::size_t>(next + rng.uniform() * each), shown.size() - 1)];
        const SurfacePoint middle = texels.point(first);
        TargetPart& part = all.emplace_back();
        for (int k = 0; k < places; ++k) {
            const double dx = rng.uniform() - .5, dy = rng.uniform() - .5;
            const int x = static_cast<int>(first % size) + (k > 0 ? int(2 * reach * dx) : 0),
                      y = static_cast<int>(first / size) + (k > 0 ? int(2 * reach * dy) : 0);
            if (x < 0 || y < 0 || x >= texels.size() || y >= texels.size())
                continue;
            const std::size_t texel = texels.index(x, y);
            if (!texels.shows(texel) || covered[texel])
                continue;
            const SurfacePoint at = texels.point(texel);
            if (at.facet != middle.facet || at.normal != middle.normal)
                continue;
            part.points.push_back(at);
            part.reflectance.push_back(factor_of(mesh, at, bake));
        }
    }
    return all;
}

namespace {

std::vector<JudgedPixel> judged_texels(const Mesh& mesh, const TexelMap& texels,
                                       const std::vector<bool>& covered, Bake bake,
                                       std::size_t count, std::uint64_t seed) {
    std::vector<std::size_t> shown;
    for (std::size_t k = 0; k < texels.count(); ++k)
        if (texels.shows(k) && !covered[k] && texels.is_inside(k))
            shown.push_back(k);
    Rng rng(seed);
    std::vector<JudgedPixel> judged;
    const double each = std::max(1.0, double(shown.size()) / double(count));
    for (double next = 0; next < double(shown.size()); next += each) {
        const std::size_t texel = shown[std::min(
            static_cast<std::size_t>(next + rng.uniform() * each), shown.size() - 1)];
        const SurfacePoint at = texels.point(texel);
        Colours colours{Vec3(1.0), Vec3(0.0)};
        if (bake == Bake::radiosity)
            colours = colours_at(mesh, mesh.patches()[at.patch], at.position);
        if (colours.reflectance != Vec3(0.0))
            judged.push_back({texel, {{texels.receiver(texel), colours}}});
    }
    return judged;
}

} // namespace

PictureJudge judge_of_lightmaps(const Mesh& mesh, const Tracer& tracer, const SurfaceLight& light,
                                const TexelMap& texels, const std::vector<bool>& covered, Bake bake,
                                std::uint64_t seed) {
    return {mesh,
            tracer,
            light,
            [&mesh, &texels, &covered, bake](std::size_t count, std::uint64_t of) {
                return judged_texels(mesh, texels, covered, bake, count, of);
            },
            seed,
            bake == Bake::indirect};
}

} // namespace hemilux
