#pragma once
// The patches with all that is known of them, for ParaView and VTK. The file is an unstructured
// grid in XML (VTK file formats, "Serial XML", version 1.0) with its numbers as raw little-endian
// bytes.

#include "io/files/provenance.h"
#include "radiosity/answers/vertices/smooth.h"
#include "radiosity/paper/solution/solution.h"

#include <string>

namespace hemilux {

/// Writes a cell for each patch, but for those of suns and skies. Its arrays are the columns of the
/// patch table: `patch`, `face`, `material`, `group` (numbers), `area`, `normal`, `reflectance`,
/// `emission`, `radiosity` and `stderr` [W/m2]. Then follow `gradient_r`, `gradient_g`,
/// `gradient_b` [W/m2 per m] and `target` where the solution has them. Points have the smoothed
/// `light` [W/m2]. The names of materials and groups, the program and its command line are field
/// data. Throws OutputError.
void write_vtu(const std::string& path, const Mesh& mesh, const CornerClasses& classes,
               const Solution& solution, const Provenance& from = {});

} // namespace hemilux
