#include "radiosity/light/final_gather/light_within_patches.h"

#include "parallel/workers.h"
#include "radiosity/light/final_gather/final_gather.h"
#include "radiosity/light/final_gather/linear_light.h"
#include "radiosity/light/final_gather/surface_points.h"
#include "radiosity/paper/sampling/rng.h"
#include "radiosity/paper/scene/mesh.h"
#include "radiosity/paper/solving/stop_flag.h"

#include <algorithm>

namespace hemilux {
namespace {

/// The number of patches gathered at a time: points and their light take memory.
constexpr std::size_t patches_at_a_time = 16'384;

} // namespace

LightWithinPatches light_within_patches(const LightSource& light,
                                        std::span<const std::uint32_t> patches,
                                        const WithinOptions& options, const Workers& workers,
                                        const StopFlag& interrupted) {
    LightWithinPatches result;
    result.square.resize(patches.size());
    result.slopes.resize(patches.size());
    FinalGather gather(light.mesh, light.tracer, light.solution, options.rays, options.rays / 2);
    gather.set_rounds(options.rounds);
    for (std::size_t done = 0; done < patches.size() && !interrupted; done += patches_at_a_time) {
        const auto some = patches.subspan(done, std::min(patches_at_a_time, patches.size() - done));
        const std::vector<PatchPoint> points =
            points_on_patches(light.mesh, some, options.max_rows, hash_words({options.seed, 0}));
        std::vector<SurfacePoint> at;
        std::vector<std::uint64_t> streams;
        for (const PatchPoint& point : points) {
            at.push_back(point.at);
            streams.push_back(hash_words({options.seed, 1, point.patch}));
        }
        const std::vector<Vec3> irradiance =
            gather.irradiance(at, streams, 2, workers, interrupted);
        for (std::size_t k = 0, begin = 0, end = 0; k < some.size(); ++k, begin = end) {
            while (end < points.size() && points[end].patch == some[k])
                ++end;
            if (end - begin < LinearLight::min_points)
                continue;
            const Patch& patch = light.mesh.patches()[some[k]];
            const LinearLight found(patch, std::span(points).subspan(begin, end - begin),
                                    std::span(irradiance).subspan(2 * begin, 2 * (end - begin)));
            const Vec3& rho = light.mesh.material(patch).reflectance;
            result.square[done + k] = patch.area * glm::dot(rho * rho, found.variance_left());
            for (std::size_t e = 0; e < 2; ++e)
                result.slopes[done + k][e] = {rho * found.slopes()[e].x, rho * found.slopes()[e].y};
        }
    }
    result.rays = gather.rays();
    return result;
}

} // namespace hemilux
