#pragma once
// View factors as files: a table of pairs, a sparse matrix for SciPy, and the input of uDALES.
// Their legend is in view_factor_legend.h.

#include "io/files/provenance.h"
#include "radiosity/answers/surfaces/surface_rows.h"
#include "radiosity/engine/factors/points/point_factors.h"
#include "radiosity/engine/factors/rows/sky_bands.h"
#include "radiosity/engine/factors/rows/view_factors.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace hemilux {

/// All that the files are made of.
struct FactorTable {
    const ViewFactors& factors;
    std::span<const FactorSurface> surfaces; ///< by row
    std::vector<Open> columns;               ///< of what is open, those that are columns too
    const std::atomic<bool>* interrupted = nullptr;
    bool has_pairs = true;                     ///< false: only what is open was computed
    std::span<const PointFactors> points = {}; ///< further rows, which have no columns
    std::span<const FactorPlace> places = {};  ///< by point
    const SkyBands* bands = nullptr; ///< parts of the sky; where it is a column, they are instead

    /// Returns the number of columns, which are rows too: points follow them.
    [[nodiscard]] std::size_t size() const { return surfaces.size() + column_names().size(); }
    /// Returns the names of the columns that follow the surfaces.
    [[nodiscard]] std::vector<std::string> column_names() const;
    [[nodiscard]] std::size_t rows() const { return size() + points.size(); }
};

/// Returns "sky", "ground" or "back".
[[nodiscard]] const char* name_of(Open open);

/// Writes `i,j,F,standard_error`, a row per factor above 0. Surfaces count from 0; what is open
/// follows them in the order of the columns. Throws OutputError, as all functions do.
void write_factor_pairs(const std::string& path, const FactorTable& table);

/// Writes an archive that scipy.sparse.load_npz reads as a CSR matrix, float64, with int32 indices
/// or int64 ones where these do not suffice. Further arrays are `standard_error` (in the order of
/// `data`), `area` [m2] of the surfaces, `name` of all rows, `seed` and `command`. Sky and ground
/// add rows without entries, so that it is square but for the rows of points.
void write_factor_npz(const std::string& path, const FactorTable& table, const Provenance& from);

/// Writes vfsparse.inp of uDALES: `i j F`, from 1, with eight decimals, without what rounds to 0.
void write_udales_factors(const std::string& path, const FactorTable& table);
/// Writes svf.inp of uDALES: a line of text, then the factor to the sky of each surface.
void write_udales_sky(const std::string& path, const FactorTable& table);

/// Writes the whole matrix as a dense NumPy array, with the rows of points below.
void write_dense_factors(const std::string& path, const FactorTable& table);

} // namespace hemilux
