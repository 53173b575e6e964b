// view_factors: the factors of the program's `viewfactors`, as the arrays of a sparse matrix; and
// the sunlit fractions of surfaces.

#include "app/settings/exit_code.h"
#include "app/settings/factor_aim.h"
#include "io/results/view_factor_files.h"
#include "python/parts.h"
#include "python/scene.h"
#include "python/waiting.h"
#include "radiosity/answers/surfaces/surface_factors.h"
#include "radiosity/answers/surfaces/surface_points.h"
#include "radiosity/answers/surfaces/surface_sunlight.h"

#include <pybind11/stl.h>

#include <bit>
#include <optional>

namespace hemilux {
namespace {

FactorRows rows_of_name(const std::string& by) {
    if (by == "face")
        return FactorRows::face;
    if (by == "group")
        return FactorRows::group;
    if (by == "material")
        return FactorRows::material;
    if (by == "patch")
        return FactorRows::patch;
    throw UsageError("by: expected 'face', 'group', 'material' or 'patch', found '" + by + "'");
}

/// Returns what is asked of all functions.
FactorsAsked asked_of(double error, const std::string& by, std::uint64_t seed, unsigned threads) {
    FactorsAsked asked;
    if (!(error > 0 && error < 1))
        throw UsageError("error: expected a number above 0 and below 1");
    asked.by = rows_of_name(by);
    asked.error = error;
    asked.seed = seed;
    asked.threads = threads;
    return asked;
}

FactorsAsked asked_of(double error, const std::string& of, const std::string& by,
                      std::uint32_t rays, std::optional<double> seconds,
                      const std::string& sky_bands, std::uint64_t seed, unsigned threads) {
    constexpr std::uint32_t least_rays = 256, most_rays = 1 << 20;
    FactorsAsked asked = asked_of(error, by, seed, threads);
    if (!std::has_single_bit(rays) || rays < least_rays || rays > most_rays)
        throw UsageError("rays: expected a power of two from 256 to 1048576");
    const std::optional<FactorAim> aim = parse_factor_aim(of);
    if (!aim)
        throw UsageError("of: expected 'above:F', 'rows', 'largest', 'pair:A,B' or 'sky', found '" +
                         of + "'");
    asked.aim = *aim;
    asked.ground = true; // its error is asked for, as that of the sky
    asked.rays = rays;
    if (!sky_bands.empty()) {
        asked.sky_bands = parse_sky_division(sky_bands);
        if (!asked.sky_bands)
            throw UsageError(
                "sky_bands: expected a whole number from 1 to 90 or 'tregenza', found " +
                sky_bands);
    }
    if (seconds && !(*seconds > 0))
        throw UsageError("time: expected a number of seconds above 0");
    asked.seconds = seconds;
    return asked;
}

std::vector<FactorPlace> places_of(const Doubles& positions, const Doubles& normals) {
    std::vector<FactorPlace> places;
    for (std::size_t k = 0; k < rows_of(positions).size(); ++k)
        places.push_back({{}, rows_of(positions)[k], rows_of(normals)[k]});
    return places;
}

py::list names_of(const FactorSurfaces& surfaces) {
    py::list names;
    for (const FactorSurface& surface : surfaces.rows)
        names.append(surface.name);
    return names;
}

py::dict audit_of(const ViewFactors& factors, double reciprocity) {
    const ClosingAudit& audit = factors.audit;
    const ExchangeWork& work = factors.work;
    py::dict result;
    result["lacking_rms"] = audit.lacking_rms;
    result["lacking_worst"] = audit.lacking_worst;
    result["worst_patch"] = audit.worst_row;
    result["chance_rms"] = audit.chance_rms;
    result["chance_worst"] = audit.chance_worst;
    result["largest_move"] = audit.largest_move;
    result["largest_exact_move"] = audit.largest_exact_move;
    result["set_to_zero"] = audit.set_to_zero;
    result["reciprocity"] = reciprocity;
    result["rays"] = work.rays;
    result["lines"] = work.lines;
    result["exact_pairs"] = work.exact_pairs;
    result["line_pairs"] = work.line_pairs;
    result["ray_pairs"] = work.ray_pairs;
    result["clear_pairs"] = work.clear_pairs;
    return result;
}

/// Returns the factors to sky, ground and backs of all rows as (n, 3), or their standard errors.
py::array_t<double> open_of(const ViewFactors& factors, double OpenShare::*member) {
    static_assert(opens == 3);
    return array_by<Vec3>(factors.rows(), [&](std::size_t i) {
        const auto& [sky, ground, back] = factors.open[i];
        return Vec3(sky.*member, ground.*member, back.*member);
    });
}

std::vector<double> members_of(std::span<const OpenShare> shares, double OpenShare::*member) {
    std::vector<double> values;
    for (const OpenShare& share : shares)
        values.push_back(share.*member);
    return values;
}

py::dict result_of(ViewFactors factors, const FactorSurfaces& surfaces, double reciprocity) {
    py::dict result;
    std::vector<double> areas;
    for (const FactorSurface& surface : surfaces.rows)
        areas.push_back(surface.area);
    result["name"] = names_of(surfaces);
    result["area"] = array_of(std::move(areas));
    result["open"] = open_of(factors, &OpenShare::factor);
    result["open_standard_error"] = open_of(factors, &OpenShare::standard_error);
    result["audit"] = audit_of(factors, reciprocity);
    result["bands"] = array_of(members_of(factors.bands, &OpenShare::factor));
    result["bands_standard_error"] =
        array_of(members_of(factors.bands, &OpenShare::standard_error));
    result["unlisted_bound"] = array_of(std::move(factors.unlisted_bound));
    result["indptr"] = array_as<std::int64_t>(std::move(factors.row_begin));
    result["indices"] = array_as<std::int32_t>(std::move(factors.column)); // as SciPy has them
    result["data"] = array_of(std::move(factors.factor));
    result["standard_error"] = array_of(std::move(factors.standard_error));
    return result;
}

/// Returns the rows of points as the arrays of a sparse matrix.
py::dict points_of(const std::vector<PointFactors>& rows) {
    std::vector<std::uint64_t> begin(1, 0);
    std::vector<std::uint32_t> column;
    std::vector<double> factor, error, bound;
    std::vector<OpenShare> bands;
    for (const PointFactors& row : rows) {
        bands.insert(bands.end(), row.bands.begin(), row.bands.end());
        column.insert(column.end(), row.column.begin(), row.column.end());
        factor.insert(factor.end(), row.factor.begin(), row.factor.end());
        error.insert(error.end(), row.standard_error.begin(), row.standard_error.end());
        begin.push_back(column.size());
        bound.push_back(row.unlisted_bound);
    }
    const auto open = [&rows](double OpenShare::*member) {
        return array_by<Vec3>(rows.size(), [&rows, member](std::size_t i) {
            const auto& [sky, ground, back] = rows[i].open;
            return Vec3(sky.*member, ground.*member, back.*member);
        });
    };
    py::dict result;
    result["open"] = open(&OpenShare::factor);
    result["open_standard_error"] = open(&OpenShare::standard_error);
    result["bands"] = array_of(members_of(bands, &OpenShare::factor));
    result["bands_standard_error"] = array_of(members_of(bands, &OpenShare::standard_error));
    result["unlisted_bound"] = array_of(std::move(bound));
    result["indptr"] = array_as<std::int64_t>(std::move(begin));
    result["indices"] = array_as<std::int32_t>(std::move(column));
    result["data"] = array_of(std::move(factor));
    result["standard_error"] = array_of(std::move(error));
    return result;
}

py::dict compute(const PythonMesh& mesh, double error, const std::string& of, const std::string& by,
                 std::uint32_t rays, std::optional<double> seconds, const std::string& sky_bands,
                 int up, std::uint64_t seed, unsigned threads, const Doubles& positions,
                 const Doubles& normals, const py::object& progress) {
    const FactorsAsked asked = asked_of(error, of, by, rays, seconds, sky_bands, seed, threads);
    const std::optional<SkyBands> bands = bands_of(asked.sky_bands, up);
    Monitor monitor;
    FactorSurfaces surfaces;
    ViewFactors factors;
    double reciprocity = 0;
    const std::vector<FactorPlace> places = places_of(positions, normals);
    std::vector<PointFactors> points;
    run_without_lock(monitor, progress, [&] {
        surfaces = factor_surfaces(mesh.mesh(), asked.by);
        check_aim(asked.aim, surfaces);
        const FactorScene scene{mesh.mesh(), mesh.tree(threads),       surfaces, up,
                                {},          bands ? &*bands : nullptr};
        factors = compute_factors(asked, scene, monitor);
        points =
            compute_points(asked, scene, factor_points(places, scene.mesh, scene.tree), monitor);
        reciprocity = worst_reciprocity(factors);
    });
    py::list band_names;
    for (std::size_t k = 0; bands && k < bands->size(); ++k)
        band_names.append(bands->name(k));
    py::dict result = result_of(std::move(factors), surfaces, reciprocity);
    result["least"] = asked.aim.least; // of above:F
    result["points"] = points_of(points);
    result["band_names"] = band_names;
    return result;
}

/// Returns the names of surfaces, and sunlit fractions and their standard errors: those of surfaces
/// and then of points for the first sun, then for the next one. `directions` are those in which the
/// light of suns goes.
py::dict sunlit(const PythonMesh& mesh, const Doubles& directions, double error,
                const std::string& by, std::uint64_t seed, unsigned threads,
                const Doubles& positions, const Doubles& normals, const py::object& progress) {
    const FactorsAsked asked = asked_of(error, by, seed, threads);
    const std::vector<FactorPlace> places = places_of(positions, normals);
    const std::span<const Vec3> suns = rows_of(directions);
    Monitor monitor;
    FactorSurfaces surfaces;
    std::vector<double> fractions, errors;
    run_without_lock(monitor, progress, [&] {
        surfaces = factor_surfaces(mesh.mesh(), asked.by);
        const FactorScene scene{mesh.mesh(), mesh.tree(threads), surfaces, 2};
        const std::vector<FactorPoint> points = factor_points(places, scene.mesh, scene.tree);
        std::vector<Vec3> to_suns;
        for (const Vec3& sun : suns)
            to_suns.push_back(-glm::normalize(sun));
        find_sunlit(asked, scene, to_suns, points, monitor,
                    [&](std::size_t, const std::vector<OpenShare>& shares) {
                        for (const OpenShare& share : shares) {
                            fractions.push_back(share.factor);
                            errors.push_back(share.standard_error);
                        }
                    });
    });
    py::dict result;
    result["name"] = names_of(surfaces);
    result["sunlit"] = array_of(std::move(fractions));
    result["standard_error"] = array_of(std::move(errors));
    return result;
}

/// Makes factors of the arrays of a matrix again.
ViewFactors factors_of(const Integers& begin, const Integers& column, const Doubles& factor,
                       const Doubles& standard_error, const Doubles& open,
                       const Doubles& open_error, const Doubles& bands,
                       const Doubles& bands_error) {
    ViewFactors factors;
    factors.row_begin.assign(begin.data(), begin.data() + begin.size());
    factors.column.assign(column.data(), column.data() + column.size());
    factors.factor.assign(factor.data(), factor.data() + factor.size());
    factors.standard_error.assign(standard_error.data(),
                                  standard_error.data() + standard_error.size());
    const std::span<const Vec3> shares = rows_of(open), errors = rows_of(open_error);
    for (std::size_t i = 0; i < shares.size(); ++i) {
        auto& row = factors.open.emplace_back();
        for (std::size_t k = 0; k < opens; ++k) {
            const int axis = static_cast<int>(k);
            row.at(k) = {shares[i][axis], errors[i][axis]};
        }
    }
    for (py::ssize_t k = 0; k < bands.size(); ++k)
        factors.bands.push_back({bands.data()[k], bands_error.data()[k]});
    factors.area.assign(factors.open.size(), 0); // which these files do not show
    return factors;
}

void write(const std::string& path, const FactorTable& table) {
    switch (factor_file_of(path).value_or(FactorFile::cells)) {
    case FactorFile::pairs:
        return write_factor_pairs(path, table);
    case FactorFile::dense:
        return write_dense_factors(path, table);
    case FactorFile::udales_factors:
        return write_udales_factors(path, table);
    case FactorFile::udales_sky:
        return write_udales_sky(path, table);
    case FactorFile::sparse: // which Python writes
    case FactorFile::cells:
        throw UsageError(path + ": expected .npz, .csv, .npy, vfsparse.inp... or svf.inp...");
    }
}

void save(const std::string& path, const Integers& begin, const Integers& column,
          const Doubles& factor, const Doubles& standard_error, const Doubles& open,
          const Doubles& open_error, const Doubles& bands, const Doubles& bands_error,
          const std::string& sky_bands, bool sky, bool ground) {
    const ViewFactors factors =
        factors_of(begin, column, factor, standard_error, open, open_error, bands, bands_error);
    // These files show no directions.
    const std::optional<SkyBands> parts = bands_of(parse_sky_division(sky_bands), 2);
    const std::vector<FactorSurface> surfaces(factors.rows());
    FactorTable table{factors, surfaces, {}};
    table.bands = parts ? &*parts : nullptr;
    if (sky)
        table.columns.push_back(Open::sky);
    if (ground)
        table.columns.push_back(Open::ground);
    const py::gil_scoped_release unlocked;
    write(path, table);
}

} // namespace

void add_view_factors(py::module_& module) {
    module.def("view_factors", &compute);
    module.def("save_factors", &save);
    module.def("sunlit", &sunlit);
}

} // namespace hemilux
