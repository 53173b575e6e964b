#pragma once
// Charts of error against cost: panels side by side with logarithmic axes, the same curves in each.

#include "io/drawings/canvas.h"
#include "io/drawings/error_curves.h"

#include <string>
#include <vector>

namespace hemilux {

/// A point of a curve that shows its numbers under the pointer.
struct Dot {
    double x, y;
    std::string text;
    std::string name = {}; ///< a class of its own in the file
};

struct Panel {
    std::string x_label;
    std::vector<MeanCurve> curves;           ///< one per name of the chart; may be empty
    std::vector<std::vector<Dot>> dots = {}; ///< dots of each curve; none: empty
};

struct Chart {
    std::string title;
    std::string y_label;
    std::vector<std::string> names; ///< names of the curves, for the legend
    std::vector<Panel> panels;
};

/// Returns the text of an .svg file: curves with the range of their runs as a light band, ticks,
/// labels and a legend. Below the curves is a dashed line of the slope -1/2. What belongs to curve
/// number k has the class `curve`k.
[[nodiscard]] std::string chart_svg(const Chart& chart);

} // namespace hemilux
