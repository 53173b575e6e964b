#include "radiosity/answers/lightmaps/occlusion_gather.h"

#include "geometry/compensated_sum.h"
#include "geometry/frame.h"
#include "parallel/workers.h"
#include "radiosity/engine/sampling/sobol.h"
#include "radiosity/paper/rays/shot.h"
#include "radiosity/paper/sampling/rng.h"
#include "radiosity/paper/scene/mesh.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <map>

namespace hemilux {
namespace {

constexpr std::size_t batches = 4;
/// The rays of a batch at a texel: at first, and at most.
constexpr std::uint32_t first_rays = 16, most_rays = 1024;
/// Surfaces lie in [-1,1]^3 and suns and skies far outside, which block nothing.
constexpr double longest = 4;

/// The rays of a texel.
struct TexelRays {
    std::array<std::uint16_t, batches> free{}; ///< by batch
    std::uint16_t traced = 0;                  ///< in each batch
};

struct Estimate {
    double mean, variance; ///< of the share, and of its mean
};

Estimate estimate_of(const TexelRays& rays) {
    std::array<double, batches> share{};
    double mean = 0, squares = 0;
    for (std::size_t b = 0; b < batches; ++b) {
        share[b] = double(rays.free[b]) / rays.traced;
        mean += share[b] / batches;
    }
    for (const double of_batch : share)
        squares += (of_batch - mean) * (of_batch - mean);
    return {mean, squares / (batches * (batches - 1))};
}

struct Object {
    std::vector<std::size_t> texels;
    ObjectError error{};
    bool done = false;
};

/// Traces the rays of each batch of a texel that are missing to `end`.
void trace(const Tracer& tracer, const SurfacePoint& at, std::size_t texel, std::uint32_t end,
           const OcclusionOptions& options, TexelRays& of_texel) {
    const std::uint32_t begin = of_texel.traced;
    const Frame frame = Frame::from_normal(at.normal);
    const std::size_t count = end - begin;
    std::vector<Ray> rays(count);
    const std::vector<std::uint32_t> targets(count, none);
    std::vector<std::uint8_t> blocked(count);
    for (std::size_t b = 0; b < batches; ++b) {
        SobolBlocks<4> numbers(hash_words({options.seed, texel, b}));
        for (std::uint32_t k = begin; k < end; ++k) {
            const auto u = numbers.at(k);
            Ray& ray = rays[k - begin];
            ray = at.ray(frame.to_world(cosine_direction({u[0], u[1]})));
            ray.t_max = std::min(options.distance, longest);
        }
        tracer.occluded_stream(rays, targets, blocked);
        of_texel.free[b] = static_cast<std::uint16_t>(
            of_texel.free[b] + std::count(blocked.begin(), blocked.end(), std::uint8_t{0}));
    }
    of_texel.traced = static_cast<std::uint16_t>(end);
}

/// Returns the error of an object. Its variance is the mean of those of its texels, which is
/// unbiased also where rays seldom differ, but not below that of one ray more among all.
ObjectError error_of(const Object& object, std::uint32_t group, const TexelMap& texels,
                     const std::vector<TexelRays>& rays) {
    constexpr double one_sided_95 = 1.645, degrees_of_freedom = batches - 1;
    CompensatedSum<double> sum, squares;
    ObjectError error{group, 0, 0, 0, 0};
    std::uint32_t fewest = most_rays;
    for (const std::size_t texel : object.texels) {
        if (!texels.is_inside(texel))
            continue;
        const double variance = estimate_of(rays[texel]).variance;
        sum += variance;
        squares += variance * variance;
        ++error.texels;
        error.rays = std::max<unsigned>(error.rays, batches * rays[texel].traced);
        fewest = std::min<std::uint32_t>(fewest, rays[texel].traced);
    }
    if (error.texels == 0)
        return error;
    const auto n = static_cast<double>(error.texels), all_rays = double(batches * fewest);
    const double mean = sum.value() / n, one_ray = 1 / (n * all_rays * all_rays);
    // The spread of the variances, which few texels hardly know, and that of each by itself.
    const double of_mean = std::sqrt(std::max(
        {(squares.value() / n - mean * mean) / n, 2 * mean * mean / (degrees_of_freedom * n)}));
    error.error = std::sqrt(std::max(mean, one_ray));
    error.bound = std::sqrt(std::max(mean + one_sided_95 * of_mean, one_ray));
    return error;
}

} // namespace

ObjectError Occlusion::all() const {
    ObjectError whole{none, 0, 0, 0, 0};
    for (const ObjectError& object : objects) {
        const auto texels = static_cast<double>(object.texels);
        whole.texels += object.texels;
        whole.rays = std::max(whole.rays, object.rays);
        whole.error += texels * object.error * object.error;
        whole.bound += texels * object.bound * object.bound;
    }
    if (whole.texels > 0) {
        whole.error = std::sqrt(whole.error / double(whole.texels));
        whole.bound = std::sqrt(whole.bound / double(whole.texels));
    }
    return whole;
}

Occlusion gather_occlusion(const Mesh& mesh, const Tracer& tracer, const TexelMap& texels,
                           const std::vector<bool>& covered, const OcclusionOptions& options,
                           const Workers& workers) {
    constexpr std::size_t texels_at_a_time = 256;
    std::map<std::uint32_t, Object> objects; // by group
    for (std::size_t k = 0; k < texels.count(); ++k)
        if (texels.shows(k) && !covered[k])
            objects[mesh.scene().facets[texels.triangle(k).facet].group].texels.push_back(k);
    std::vector<TexelRays> rays(texels.count());
    Occlusion found{GatheredLightmap(texels), {}, 0};
    const auto trace_up_to = [&](std::uint32_t end, const Object& object) {
        std::atomic<std::uint64_t> traced{0};
        workers.for_chunks(
            object.texels.size(), texels_at_a_time, [&](std::size_t first, std::size_t last) {
                if (end == first_rays)
                    options.check();
                else if (options.is_over())
                    return;
                std::uint64_t count = 0;
                for (std::size_t k = first; k < last; ++k) {
                    const std::size_t texel = object.texels[k];
                    count += batches * (end - rays[texel].traced);
                    trace(tracer, texels.receiver(texel), texel, end, options, rays[texel]);
                }
                traced += count;
            });
        found.rays += traced;
    };
    bool all_done = false;
    for (std::uint32_t end = first_rays;
         !all_done && end <= most_rays && (end == first_rays || found.rays < options.max_rays) &&
         (end == first_rays || !options.is_over());
         end *= 2) {
        all_done = true;
        for (auto& [group, object] : objects) {
            if (object.done)
                continue;
            trace_up_to(end, object);
            object.error = error_of(object, group, texels, rays);
            object.done = object.error.bound <= options.error;
            all_done = all_done && object.done;
        }
    }
    for (const auto& [group, object] : objects) {
        if (object.error.texels > 0)
            found.objects.push_back(object.error);
        for (const std::size_t texel : object.texels) {
            found.lightmap.known[texel] = true;
            found.lightmap.image.pixels[texel] =
                glm::vec3(static_cast<float>(estimate_of(rays[texel]).mean));
        }
    }
    return found;
}

} // namespace hemilux
