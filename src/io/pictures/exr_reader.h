#pragma once
// Reads pictures of many layers that hemilux wrote (exr.h).

#include "io/pictures/exr.h"

#include <string>
#include <vector>

namespace hemilux {

struct ExrFile {
    int width = 0, height = 0; ///< [pixels]
    std::vector<ExrChannel> channels;
};

/// Throws InputError for a file that is broken, or of another form of OpenEXR: tiles, several
/// parts, other compressions, subsampled channels, rows from below.
[[nodiscard]] ExrFile read_exr(const std::string& path);

/// Returns the picture of a layer, R, G and B for the one without a name, 0 in channels that it has
/// not. A channel that is a whole number gives its value.
[[nodiscard]] Image image_of(const ExrFile& file, const std::string& layer);

} // namespace hemilux
