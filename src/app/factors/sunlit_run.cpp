#include "app/factors/sunlit_run.h"

#include "geometry/elementary.h"
#include "io/files/atomic_file.h"
#include "io/results/csv.h"
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

/// Writes a row for each fraction. Surfaces count from 0, points from `first_point`.
void write_rows(AtomicFile& file, std::size_t sun, std::size_t surfaces, std::size_t first_point,
                std::span<const OpenShare> fractions) {
    std::string line;
    for (std::size_t k = 0; k < fractions.size(); ++k) {
        const std::size_t row = k < surfaces ? k : first_point + (k - surfaces);
        line = std::to_string(sun) + "," + std::to_string(row);
        csv::append_field(line, fractions[k].factor);
        csv::append_field(line, fractions[k].standard_error);
        file.write(line + "\n");
    }
}

} // namespace

void find_sunlit(const ViewFactorSettings& settings, const FactorScene& scene,
                 std::span<const Vec3> suns, std::span<const FactorPoint> points, Monitor& monitor,
                 const std::function<void(std::size_t sun, std::vector<OpenShare> shares)>& keep) {
    const Workers workers(settings.options.threads);
    monitor.phase = "sunlight";
    for (std::size_t s = 0; s < suns.size(); ++s) {
        monitor.step_share = static_cast<double>(s) / static_cast<double>(suns.size());
        const SunlitOptions options{.error = settings.error,
                                    .seed = hash_words({settings.options.seed, s})};
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

SunlitRun write_sunlit(const std::string& path, const ViewFactorSettings& settings,
                       const FactorScene& scene, std::span<const Vec3> suns,
                       std::span<const FactorPoint> points, std::size_t first_point, bool keeps,
                       Monitor& monitor) {
    AtomicFile file(path);
    file.write("sun,surface,sunlit,standard_error\n");
    SunlitRun run;
    find_sunlit(settings, scene, suns, points, monitor,
                [&](std::size_t sun, std::vector<OpenShare> shares) {
                    const std::size_t surfaces = scene.surfaces.rows.size();
                    write_rows(file, sun, surfaces, first_point, shares);
                    ++run.suns;
                    for (const OpenShare& share : std::span(shares).first(surfaces)) {
                        ++run.all;
                        run.exact += share.standard_error == 0 ? 1 : 0;
                        run.worst_error = std::max(run.worst_error, share.standard_error);
                    }
                    if (keeps)
                        run.kept.push_back(std::move(shares));
                });
    file.commit();
    return run;
}

} // namespace hemilux
