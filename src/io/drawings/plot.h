#pragma once
// Charts of error against cost: panels side by side with logarithmic axes, the same curves in each.

#include "io/drawings/canvas.h"
#include "io/drawings/error_curves.h"

#include <string>
#include <vector>

namespace hemilux {

struct Panel {
    std::string x_label;
    std::vector<MeanCurve> curves; ///< one per name of the chart; may be empty
};

struct Chart {
    std::string title;
    std::string y_label;
    std::vector<std::string> names; ///< of the curves, for the legend
    std::vector<Panel> panels;
    /// Draw a dashed line of this slope below the curves of each panel; 0: none.
    double guide_slope = -0.5;
    std::string guide_name = "slope -1/2";
};

/// The colour of a curve by its place among the names.
[[nodiscard]] Colour curve_colour(std::size_t index);

/// The text of an .svg file: curves with the range of their runs as a light band, ticks, labels,
/// legend.
[[nodiscard]] std::string chart_svg(const Chart& chart);

} // namespace hemilux
