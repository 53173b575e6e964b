#pragma once
// Reads the input files of View3D (Walton 2002, NISTIR 6925; View3D 4.0), with the extension .vs3:
// numbered vertices, and surfaces of three or four of them.

#include "io/scene_files/read_result.h"

#include <string>

namespace hemilux {

/// Facet::face counts the surfaces of the file from 0. Each is a group of its name, with which
/// surfaces are joined that the file combines with it (`cmb`). A material stands for an emittance,
/// and reflects the rest. Surfaces look to where their corners run counter-clockwise. Titles and
/// what controls View3D are passed over. Throws InputError for a file that cannot be read, with the
/// line of what is wrong in it, for geometry of other kinds than `F 3`, for surfaces that lie on
/// others (`base`), and where no surface has an area.
[[nodiscard]] ReadResult read_vs3(const std::string& path, const ReadGuard& guard = {});

} // namespace hemilux
