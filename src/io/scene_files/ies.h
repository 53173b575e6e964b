#pragma once
// Reads the photometry of lamps: IES files (ANSI/IES LM-63-1991, -1995, -2002), photometry of type
// C without tilt.

#include "radiosity/engine/rays/candela_table.h"

#include <memory>
#include <string>

namespace hemilux {

/// Returns the intensities, times all factors of the file. Throws InputError with the line for what
/// is no such file, or of another type.
[[nodiscard]] std::shared_ptr<const CandelaTable> read_ies(const std::string& path);

} // namespace hemilux
