#pragma once
// A known solution on the same patches, to tell the true error of a run.

#include "io/tables.h"
#include "radiosity/mesh.h"

#include <optional>
#include <string>
#include <vector>

namespace hemilux {

/// Throws InputError, naming the file, unless its rows are the mesh's patches.
void check_same_patches(const PatchTable& table, const std::string& path, const Mesh& mesh);

/// Which patches belong to the groups named, or, where none is, to those whose name begins with
/// `detail`. Throws UsageError for a group that the scene does not have.
[[nodiscard]] std::vector<bool> detail_mask(const Mesh& mesh,
                                            const std::vector<std::string>& groups);

} // namespace hemilux
