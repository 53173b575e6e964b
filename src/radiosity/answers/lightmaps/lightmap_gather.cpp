#include "radiosity/answers/lightmaps/lightmap_gather.h"

#include "parallel/asked_to_end.h"
#include "parallel/workers.h"
#include "radiosity/answers/pictures/direct_window.h"
#include "radiosity/answers/pictures/picture_gather.h"
#include "radiosity/answers/pictures/row_windows.h"
#include "radiosity/answers/pictures/slow_light_fit.h"
#include "radiosity/paper/scene/mesh.h"

#include <algorithm>
#include <cstdint>
#include <limits>
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

/// The least rays of texels at edges of shadows, and of those that gather by themselves, as in
/// corners. Both are few, and hold most of the error: more of their rays cost less than another
/// round of all.
constexpr unsigned min_shadow_rays = 32, min_own_rays = 8;

/// Texels that gather by themselves share it up to this many steps, whatever is near, if nothing
/// stands between them.
constexpr float least_reach = 1.6f;

/// What was gathered at a texel.
struct TexelLight {
    std::uint32_t chart = none; ///< none: it was not gathered
    bool is_raised = false;     ///< SurfacePoint::is_raised
    glm::vec3 position, normal;
    SlowLight slow;
    glm::vec3 direct, unshadowed; ///< by its own shadow rays
    glm::vec3 of_points;
    float reach = 0; ///< PictureGather::Light::reach

    [[nodiscard]] SurfacePoint place() const {
        return {.position = Vec3(position), .normal = Vec3(normal), .facet = none};
    }
    [[nodiscard]] bool is_beside(const TexelLight& other) const {
        return chart == other.chart && is_same_surface(Vec3(position), Vec3(normal),
                                                       Vec3(other.position), Vec3(other.normal));
    }
};

class TexelGather {
  public:
    TexelGather(const Tracer& tracer, const TexelMap& texels, const std::vector<bool>& covered,
                PictureGather& gather)
        : tracer_(tracer), texels_(texels), covered_(covered), gather_(gather),
          rows_(static_cast<std::size_t>(texels.size())) {}

    /// Calls add(texel, irradiance) for each texel that is not covered, in several threads. Returns
    /// the number of rows, from the first, that were finished before check() threw Interrupted.
    template <class Add>
    [[nodiscard]] int run(const LightmapOptions& options, const Workers& workers, const Add& add);

  private:
    using Row = std::vector<TexelLight>;
    [[nodiscard]] Row& row(int y) { return rows_[static_cast<std::size_t>(y)]; }
    void gather_rows(int first, int end);
    [[nodiscard]] glm::vec3 irradiance(int x, int y) const;

    const Tracer& tracer_;
    const TexelMap& texels_;
    const std::vector<bool>& covered_;
    PictureGather& gather_;
    std::vector<Row> rows_; ///< empty before they are gathered, and once no window reaches them
};

template <class Add>
int TexelGather::run(const LightmapOptions& options, const Workers& workers, const Add& add) {
    constexpr std::size_t rows_at_a_time = 4;
    int finished = 0;
    const auto in_threads = [&](int first, int end, const auto& work) {
        workers.for_chunks(static_cast<std::size_t>(end - first), rows_at_a_time,
                           [&](std::size_t begin, std::size_t past) {
                               options.check();
                               work(first + static_cast<int>(begin),
                                    first + static_cast<int>(past));
                           });
    };
    const auto gather = [&](int from, int to) {
        gather_.prepare_rows(to, workers);
        in_threads(from, to, [&](int first, int end) { gather_rows(first, end); });
    };
    const auto finish = [&](int from, int to) {
        in_threads(from, to, [&](int first, int end) {
            for (int y = first; y < end; ++y)
                for (int x = 0; x < texels_.size(); ++x)
                    if (row(y)[static_cast<std::size_t>(x)].chart != none)
                        add(texels_.index(x, y), irradiance(x, y));
        });
        finished = to;
        if (options.rows_done)
            options.rows_done(to);
    };
    try {
        for_row_windows(texels_.size(), 8 * static_cast<int>(rows_at_a_time * workers.threads()),
                        DirectWindow::reach, gather, finish, [&](int y) { row(y) = {}; });
    } catch (const Interrupted&) { // the rows before are finished
    }
    return finished;
}

void TexelGather::gather_rows(int first, int end) {
    std::vector<PictureGather::Place> places;
    std::vector<TexelLight*> which;
    for (int y = first; y < end; ++y) {
        row(y).resize(static_cast<std::size_t>(texels_.size()));
        for (int x = 0; x < texels_.size(); ++x) {
            const std::size_t texel = texels_.index(x, y);
            if (!texels_.shows(texel) || covered_[texel])
                continue;
            const std::uint32_t chart = texels_.triangle(texel).chart;
            places.push_back({texels_.receiver(texel), Vec2(x + .5, y + .5), 0, 1, chart});
            which.push_back(&row(y)[static_cast<std::size_t>(x)]);
        }
    }
    const std::vector<PictureGather::Light> lights = gather_.irradiance(places);
    for (std::size_t k = 0; k < which.size(); ++k) {
        const SurfacePoint& at = places[k].at;
        const auto& [direct, slow, of_points, reach] = lights[k];
        *which[k] = {.chart = places[k].part,
                     .is_raised = at.is_raised,
                     .position = glm::vec3(at.position),
                     .normal = glm::vec3(at.normal),
                     .slow = slow,
                     .direct = glm::vec3(direct.arriving),
                     .unshadowed = glm::vec3(direct.unshadowed),
                     .of_points = glm::vec3(of_points),
                     .reach = float(reach)};
    }
}

/// Returns what arrives at a texel, by what was found there and at the texels around.
glm::vec3 TexelGather::irradiance(int x, int y) const {
    constexpr int reach = DirectWindow::reach;
    const TexelLight& here = rows_[static_cast<std::size_t>(y)][static_cast<std::size_t>(x)];
    DirectWindow direct(gather_.shadow_rays());
    SlowLightFit slow(here.slow);
    for (int beside = std::max(y - reach, 0); beside <= std::min(y + reach, texels_.size() - 1);
         ++beside)
        for (int column = std::max(x - reach, 0); column <= std::min(x + reach, texels_.size() - 1);
             ++column) {
            const TexelLight& there =
                rows_[static_cast<std::size_t>(beside)][static_cast<std::size_t>(column)];
            if (!here.is_beside(there))
                continue;
            const int dx = column - x, dy = beside - y;
            const float weight = DirectWindow::weight_at(dx, dy);
            direct.add(dx, dy, there.direct, there.unshadowed, weight);
            if (!(here.reach > 0) || &there == &here)
                continue;
            const glm::vec3 way = (there.position - here.position) / here.reach;
            const float steps = float(dx * dx + dy * dy) / (least_reach * least_reach),
                        square = glm::dot(way, way), near = 1 - std::min(square, steps);
            if (near > 0 && (double(square) < free_reach * free_reach ||
                             !tracer_.occluded(ray_between(here.place(), there.place()))))
                slow.add({dx, dy}, there.slow, double(weight * near));
        }
    const auto [unshadowed, indirect] = slow.solve().light;
    const float own = here.is_raised ? 1 : direct.share_of_own();
    return indirect + here.of_points +
           direct.arriving_of(unshadowed, own, here.direct, here.unshadowed);
}

} // namespace

Vec3 radiosity_of(const Mesh& mesh, const SurfacePoint& at, const Vec3& irradiance) {
    const auto [reflectance, emission] = colours_at(mesh, mesh.patches()[at.patch], at.position);
    return emission + reflectance * irradiance;
}

GatheredLightmap gather_texels(const Mesh& mesh, const Tracer& tracer, const SurfaceLight& light,
                               const TexelMap& texels, const std::vector<bool>& covered,
                               const LightmapOptions& options, const Workers& workers) {
    PictureGather gather(mesh, tracer, light, grid_of(texels, covered, workers),
                         {.rays = options.rays,
                          .shadow_rays = std::max(2 * options.rays, min_shadow_rays),
                          .samples = 1,
                          .round = options.round,
                          .coarse_rays = std::max(options.rays, min_own_rays),
                          .only_reflected = options.bake == Bake::indirect,
                          .check = options.check});
    GatheredLightmap lightmap(texels);
    lightmap.rows =
        TexelGather(tracer, texels, covered, gather)
            .run(options, workers, [&](std::size_t texel, const glm::vec3& irradiance) {
                lightmap.image.pixels[texel] =
                    options.bake == Bake::radiosity
                        ? glm::vec3(radiosity_of(mesh, texels.point(texel), Vec3(irradiance)))
                        : irradiance;
            });
    lightmap.traced = gather.rays();
    for (std::size_t k = 0; k < texels.index(0, lightmap.rows); ++k)
        lightmap.known[k] = texels.shows(k) && !covered[k];
    return lightmap;
}

GatheredLightmap::GatheredLightmap(const TexelMap& texels)
    : image(texels.size(), texels.size()), known(texels.count()) {}

void complete_by_patches(GatheredLightmap& lightmap, const Mesh& mesh, const SurfaceLight& light,
                         const TexelMap& texels, Bake bake, const Workers& workers) {
    const std::size_t first = texels.index(0, lightmap.rows);
    workers.for_chunks(texels.count() - first, 4096, [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = first + begin; k < first + end; ++k) {
            if (!texels.shows(k))
                continue;
            const SurfacePoint at = texels.point(k);
            const Vec3 arriving = light.irradiance(at.patch, at.position).value;
            lightmap.image.pixels[k] =
                glm::vec3(bake == Bake::radiosity ? radiosity_of(mesh, at, arriving) : arriving);
        }
    });
    for (std::size_t k = first; k < texels.count(); ++k)
        lightmap.known[k] = texels.shows(k);
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

} // namespace hemilux
