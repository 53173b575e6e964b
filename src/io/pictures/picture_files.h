#pragma once
// Pictures are written as PNG for the eye (sRGB, 8 bits) and as Radiance HDR for numbers.

#include "io/files/provenance.h"
#include "radiosity/answers/images/image.h"
#include "radiosity/answers/images/tone.h"

#include <atomic>
#include <cstdint>
#include <string>
#include <vector>

namespace hemilux {

/// Sets the flag of a hurry: once it is true, pictures are compressed little, as a large one takes
/// many seconds otherwise. With nullptr, as at the start, there is never one.
void compress_little_on(const std::atomic<bool>* flag);
[[nodiscard]] bool is_in_a_hurry();

/// This says how much time a file may take to be small.
enum class Compression { usual, little };

/// Returns the bytes of a PNG file of three bytes a pixel, or four with alpha, row by row from the
/// top left. Throws std::bad_alloc.
[[nodiscard]] std::string png_of(int width, int height, const std::vector<std::uint8_t>& bytes,
                                 int bytes_per_pixel = 3,
                                 Compression compression = Compression::usual);

/// Writes 8 bits per channel through the sRGB curve, as `display` shows the light. Where the
/// provenance is known, the file has tEXt chunks Software, Command and Seed. Throws OutputError.
void write_png(const std::string& path, const Image& image, const Display& display,
               const Provenance& from = {}, Compression compression = Compression::usual);
/// Writes Radiance RGBE, which is linear, with the provenance as lines of the header. Throws
/// OutputError.
void write_hdr(const std::string& path, const Image& image, const Provenance& from = {});

/// Returns the bytes as a zlib stream (RFC 1950), as a PNG and an EXR file have them. Throws
/// std::bad_alloc.
[[nodiscard]] std::string zlib_compressed(std::vector<unsigned char> bytes,
                                          Compression compression = Compression::usual);

} // namespace hemilux
