#pragma once
// The legend of a matrix of view factors: what its rows are, and what is known of each as a whole.

#include "io/results/view_factor_files.h"

#include <string>

namespace hemilux {

/// Writes a row per surface: `surface,name,face,side,material,group,area,x,y,z,nx,ny,nz`, then the
/// factors to sky, ground and backs each with its standard error, the sum of the row and a bound
/// for what it does not list. Columns of the matrix that stand for sky and ground follow as rows
/// with their names, bands of the sky with the direction of their middle. Then come points, whose
/// rows have no face and no area. The last columns are the bands of the sky, each with its standard
/// error. What is not known is empty. Throws OutputError.
void write_factor_legend(const std::string& path, const FactorTable& table);

} // namespace hemilux
