#pragma once
// --error-map: where the light of the patches is far off.

#include "app/outputs/results.h"

namespace hemilux {

/// Gathers the error of each patch and writes the picture. Throws OutputError, and Interrupted
/// after a signal.
void write_error_map(const std::string& path, const ViewSettings& view, const Results& results);

} // namespace hemilux
