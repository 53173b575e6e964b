#pragma once
// A known solution on the same patches, to tell the true error of a run.

#include "io/results/tables.h"
#include "radiosity/paper/scene/mesh.h"

#include <span>
#include <string>
#include <vector>

namespace hemilux {

struct Reference {
    std::vector<Vec3> radiosity;      ///< [W/m2]
    std::vector<Vec3> standard_error; ///< [W/m2]; may be NaN
    std::vector<bool> detail;         ///< patches that are reported apart

    [[nodiscard]] RelativeError error(const Mesh& mesh, std::span<const Vec3> solution) const {
        return true_error(mesh, solution, radiosity, detail);
    }
    /// Returns the mean over area and channels of (B - B*)^2 / (B*^2 + mean(B*)^2 / 100): relMSE of
    /// Rousselle, Knaus and Zwicker (2011), whose 0.01 is for pictures with a mean of 1.
    [[nodiscard]] double relative_mse(const Mesh& mesh, std::span<const Vec3> solution) const;
};

/// Takes the solution of a patch table that was read. Throws InputError, naming the file, unless
/// its rows are the mesh's patches.
[[nodiscard]] Reference reference_of(PatchTable table, const std::string& path, const Mesh& mesh,
                                     std::vector<bool> detail);

/// Returns which patches belong to the groups named, or, where none is, to those whose name begins
/// with `detail`. Throws UsageError for a group that the scene does not have.
[[nodiscard]] std::vector<bool> detail_mask(const Mesh& mesh,
                                            const std::vector<std::string>& groups);

} // namespace hemilux
