#include "app/factors/sunlit_run.h"

#include "geometry/elementary.h"
#include "io/files/atomic_file.h"
#include "io/results/csv.h"
#include "parallel/workers.h"
#include "radiosity/engine/point_views/sunlit.h"
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

/// Writes a row for each fraction; surfaces have consecutive numbers, from `first` on.
void write_rows(AtomicFile& file, std::size_t sun, std::size_t first,
                std::span<const OpenShare> fractions) {
    std::string line;
    for (std::size_t k = 0; k < fractions.size(); ++k) {
        line = std::to_string(sun) + "," + std::to_string(first + k) + ",";
        csv::append_number(line, fractions[k].factor);
        line += ',';
        csv::append_number(line, fractions[k].standard_error);
        file.write(line + "\n");
    }
}

} // namespace

SunlitShares sunlit_shares(const ViewFactorSettings& settings, const FactorScene& scene,
                           const Vec3& sun, std::size_t number, std::span<const FactorPoint> points,
                           Monitor& monitor) {
    const SunlitOptions options{.error = settings.error,
                                .seed = hash_words({settings.options.seed, number})};
    const std::vector<OpenShare> of_patches = sunlit_patches(
        sun, scene.mesh, scene.tree, options, Workers(settings.options.threads), monitor);
    SunlitShares shares;
    if (monitor.interrupted)
        return shares;
    shares.surfaces = means_of(scene, of_patches);
    for (const FactorPoint& point : points)
        shares.points.push_back({is_sunlit(point, sun, scene.tree) ? 1.0 : 0.0, 0});
    return shares;
}

SunlitRun write_sunlit(const std::string& path, const ViewFactorSettings& settings,
                       const FactorScene& scene, std::span<const Vec3> suns,
                       std::span<const FactorPoint> points, std::size_t first_point,
                       Monitor& monitor) {
    AtomicFile file(path);
    file.write("sun,surface,sunlit,standard_error\n");
    SunlitRun run;
    monitor.phase = "sunlight";
    for (std::size_t s = 0; s < suns.size(); ++s) {
        monitor.step_share = static_cast<double>(s) / static_cast<double>(suns.size());
        const auto [means, of_points] = sunlit_shares(settings, scene, suns[s], s, points, monitor);
        if (monitor.interrupted)
            break;
        write_rows(file, s, 0, means);
        write_rows(file, s, first_point, of_points);
        ++run.suns;
        for (const OpenShare& mean : means) {
            ++run.all;
            run.exact += mean.standard_error == 0 ? 1 : 0;
            run.worst_error = std::max(run.worst_error, mean.standard_error);
        }
    }
    file.commit();
    return run;
}

} // namespace hemilux
