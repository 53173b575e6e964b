#pragma once
// These functions write into a picture file how it came about.

#include "io/files/provenance.h"

namespace hemilux {

/// Inserts tEXt chunks (PNG specification, 3rd edition, sections 11.3.3.2 and 5.3) after the header
/// of a PNG file. Where the program is not named, it inserts nothing. Letters outside ASCII become
/// '?'.
void add_to_png(std::string& file, const Provenance& from);

/// Returns the command line that add_to_png() wrote into a file; empty where it has none, and for
/// other files.
[[nodiscard]] std::string command_of_png(const std::string& path);
/// Returns a command line as these functions write it.
[[nodiscard]] std::string as_written(const std::string& command);

/// Inserts lines into the header of a Radiance file (Ward 1994), after its first line. They are the
/// program as SOFTWARE=, the command line as it is, as Radiance does, and SEED=.
void add_to_hdr(std::string& file, const Provenance& from);

} // namespace hemilux
