#pragma once
// The parts of the module, a file each.

#include <pybind11/pybind11.h>

namespace hemilux {

void add_view_factors(pybind11::module_& module); ///< factors.cpp
void add_solve(pybind11::module_& module);        ///< solving.cpp
void add_lighting(pybind11::module_& module);     ///< lighting.cpp
void add_compare(pybind11::module_& module);      ///< comparing.cpp
void add_rays(pybind11::module_& module);         ///< tracing.cpp
void add_density(pybind11::module_& module);      ///< densities.cpp

} // namespace hemilux
