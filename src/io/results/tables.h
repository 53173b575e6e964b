#pragma once
// Tables of numbers as CSV (RFC 4180): the patch table, written and read again as a reference, and
// the log of the steps. Columns are a contract that other tools read; numbers are the shortest text
// that gives back the same double.

#include "io/results/csv.h"
#include "parallel/workers.h"
#include "radiosity/engine/solving/run.h"
#include "radiosity/paper/solution/solution.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hemilux {

class Mesh;

/// Writes one row per patch in the mesh's order, in world units. An empty `standard_error` is
/// written as zeros, a NaN as `nan`. The bytes are the same for any number of threads. Where there
/// are slopes, nine more columns hold the gradient of each channel [W/m2 per m]. The light at x is
/// that of the patch plus the gradient times (x - centre). Where there are weights
/// (Solution::weight), a column `target` holds them. `more` follow. Throws OutputError.
void write_patch_table(const std::string& path, const Mesh& mesh, std::span<const Vec3> radiosity,
                       std::span<const Vec3> standard_error, const Workers& workers = Workers(1),
                       std::span<const Slope> slope = {}, std::span<const double> weight = {},
                       const csv::MoreColumns& more = {});

/// The part of a patch table that `solve --reference` needs: one entry per patch, in world units.
struct PatchTable {
    std::vector<Vec3> centre;         ///< [m]
    std::vector<double> area;         ///< [m2]
    std::vector<Vec3> radiosity;      ///< [W/m2]
    std::vector<Vec3> standard_error; ///< [W/m2]; may be NaN
};

/// Columns are found by their names, in any order; others are skipped. Throws InputError with file
/// and line.
[[nodiscard]] PatchTable read_patch_table(const std::string& path);

/// A row of the steps log.
struct StepRow {
    std::string method;
    std::uint32_t run = 0; ///< number among several runs with different seeds
    StepRecord record{};
    std::optional<RelativeError> error{}; ///< error against a reference, if there is one
    std::optional<double> total_error{};  ///< error against the light itself (known_light.h)
    std::optional<double> relative_mse{}; ///< Reference::relative_mse; the log does not have it
};

/// The names of a row's columns, with commas between them.
inline constexpr std::string_view steps_columns =
    "method,run,step,rays,seconds,estimated_error,true_error,true_error_detail,true_error_rest,"
    "total_error";
/// Writes the log. A number that is absent or NaN stays an empty field. Throws OutputError.
void write_steps_log(const std::string& path, std::span<const StepRow> rows);

} // namespace hemilux
