#pragma once
// The file of `compare --report`: one page of HTML with the errors of all runs as a chart and
// tables. It also shows the light that two methods had after as many steps, side by side, to turn
// around.
//
// The page is compare.html with the style page.css, its scripts and the data. JSON holds all
// that is not a number by patch (run_data.h). The arrays of the mesh are those of report_page.h.
// Beside them are
//
//   reference     float16 x 3  of each patch: its radiosity in `unit` of the JSON
//   light-M-K     float16 x 3  the same, of method M of the JSON after step number K of its list
//
// A half has 11 bits: it is off by at most 0.05 %, or 3e-8 units. That is 6 bytes a patch for each
// light; base64 makes 4 of 3.

#include "app/report/run_data.h"

#include <string>

namespace hemilux {

/// Writes the page, array by array. Throws OutputError and Interrupted.
void write_comparison_page(const std::string& path, const ComparisonContent& content);

} // namespace hemilux
