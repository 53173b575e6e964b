#include "app/factors/sunlit_run.h"

#include "io/files/atomic_file.h"
#include "io/results/csv.h"

#include <algorithm>

namespace hemilux {
namespace {

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

SunlitRun write_sunlit(const std::string& path, const ViewFactorSettings& settings,
                       const FactorScene& scene, std::span<const Vec3> suns,
                       std::span<const FactorPoint> points, std::size_t first_point, bool keeps,
                       Monitor& monitor) {
    AtomicFile file(path);
    file.write("sun,surface,sunlit,standard_error\n");
    SunlitRun run;
    find_sunlit(settings.asked(), scene, suns, points, monitor,
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
