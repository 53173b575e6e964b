#include "radiosity/answers/surfaces/surface_sunlight.h"

#include "geometry/elementary.h"
#include "parallel/workers.h"
#include "radiosity/engine/factors/points/sunlit.h"
#include "radiosity/paper/sampling/rng.h"
#include "radiosity/paper/scene/mesh.h"
#include "radiosity/paper/solving/solver.h"

#include <algorithm>

namespace hemilux {
namespace {

/// Returns the means over surfaces, weighted by area.
std::vector<OpenShare> means_of(const FactorScene& scene, std::span<const OpenShare> of_patches) {
    std::vector<OpenShare> means(scene.surfaces.rows.size());
    std::vector<double> area(means.size());
    const std::span<const Patch> patches = scene.mesh.patches();
    for (std::size_t i = 0; i < patches.size(); ++i)
        area[scene.surfaces.row_of[i]] += patches[i].area;
    for (std::size_t i = 0; i < patches.size(); ++i) {
        const std::uint32_t row = scene.surfaces.row_of[i];
        const double weight = patches[i].area / area[row];
        means[row].factor += weight * of_patches[i].factor;
        means[row].standard_error =
            elementary::hypot(means[row].standard_error, weight * of_patches[i].standard_error);
    }
    for (OpenShare& mean : means)
        mean.factor = std::min(mean.factor, 1.0); // but for rounding
    return means;
}

} // namespace

void find_sunlit(const FactorsAsked& asked, const FactorScene& scene, std::span<const Vec3> suns,
                 std::span<const FactorPoint> points, Monitor& monitor,
                 const std::function<void(std::size_t sun, std::vector<OpenShare> shares)>& keep) {
    const Workers workers(asked.threads);
    monitor.phase = "sunlight";
    for (std::size_t s = 0; s < suns.size(); ++s) {
        monitor.step_share = static_cast<double>(s) / static_cast<double>(suns.size());
        const SunlitOptions options{.error = asked.error, .seed = hash_words({asked.seed, s})};
        const std::vector<OpenShare> of_patches =
            sunlit_patches(suns[s], scene.mesh, scene.tree, options, workers, monitor);
        if (monitor.interrupted)
            return;
        std::vector<OpenShare> shares = means_of(scene, of_patches);
        for (const FactorPoint& point : points)
            shares.push_back({is_sunlit(point, suns[s], scene.tree) ? 1.0 : 0.0, 0});
        keep(s, std::move(shares));
    }
}

} // namespace hemilux
