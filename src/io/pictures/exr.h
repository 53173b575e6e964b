#pragma once
// Pictures of many layers: OpenEXR 2 (technical introduction and file layout of the Academy
// Software Foundation), one part of scan lines with ZIP compression.

#include "io/files/provenance.h"
#include "radiosity/answers/images/image.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace hemilux {

/// One number per pixel, row by row from the top left.
struct ExrChannel {
    std::string name; ///< name with its layer: "error.R"; at most 31 letters
    enum class Kind { number, whole, half } kind = Kind::number;
    /// The bits of a float or, in the lower 16, of a half; or the whole number itself.
    std::vector<std::uint32_t> bits;
    /// Returns the bytes of one number in the file.
    [[nodiscard]] std::size_t bytes() const { return kind == Kind::half ? 2 : 4; }
};

/// The rows that the format compresses together.
inline constexpr int exr_rows_per_chunk = 16;

/// Appends the three channels `layer`.R, .G and .B, or R, G and B for a layer without a name.
void add_exr_channels(std::vector<ExrChannel>& channels, const std::string& layer,
                      const Image& image);

/// Appends the same as numbers of 16 bits, which are right to 0.05 %; of 32 where some light is
/// brighter than these can say.
void add_half_exr_channels(std::vector<ExrChannel>& channels, const Image& image);

/// Writes a file with these channels, which may be in any order, as linear numbers of 32 or 16
/// bits. Where the provenance is known, the file has the attributes `software`, `command` and
/// `seed`. Throws OutputError.
void write_exr(const std::string& path, int width, int height, std::vector<ExrChannel> channels,
               const Provenance& from = {});

} // namespace hemilux
