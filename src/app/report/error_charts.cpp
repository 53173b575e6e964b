#include "app/report/error_charts.h"

#include "radiosity/answers/asked/text.h"

#include <cmath>
#include <limits>

namespace hemilux {
namespace {

using Cost = double (*)(const StepRow&);

double seconds_of(const StepRow& row) { return row.record.seconds; }
double rays_of(const StepRow& row) { return static_cast<double>(row.record.rays); }

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

MeanCurve mean_of(const ChartedRuns& charted, Cost cost) {
    std::vector<ErrorCurve> runs;
    for (const std::span<const StepRow> rows : charted.runs) {
        ErrorCurve& run = runs.emplace_back();
        for (const StepRow& row : rows)
            append(run, {cost(row), charted.kind->of(row)});
    }
    MeanCurve curve = mean_curve(runs);
    for (std::vector<double>* const errors : {&curve.mean, &curve.low, &curve.high})
        for (double& error : *errors)
            error *= 100; // in per cent
    return curve;
}

std::vector<Dot> dots_of(const ChartedRuns& charted, Cost cost) {
    constexpr std::size_t most = 100; // more would hide the curve
    std::vector<Dot> dots;
    if (charted.runs.empty())
        return dots;
    const std::span<const StepRow> rows = charted.runs.front();
    const std::size_t every = (rows.size() + most - 1) / most;
    for (std::size_t k = 0; k < rows.size(); ++k) {
        const StepRow& row = rows[k];
        const double x = cost(row), error = charted.kind->of(row);
        if ((k % every != 0 && k + 1 != rows.size()) || !(x > 0) || !(error > 0))
            continue;
        const std::string step = std::to_string(row.record.step);
        dots.push_back({x, 100 * error,
                        charted.name + ", step " + step + ": " + percent(error) + " after " +
                            short_counted(row.record.rays, "ray", "rays") +
                            formatted(", %.3g s", row.record.seconds),
                        "step" + step});
    }
    return dots;
}

} // namespace

const std::array<ErrorKind, 5>& error_kinds() {
    static constexpr std::array<ErrorKind, 5> kinds{
        {{"true error", [](const StepRow& row) { return row.error ? row.error->all : unknown; }},
         {"estimated error", [](const StepRow& row) { return row.record.estimated_error; }},
         {"true error of details",
          [](const StepRow& row) { return row.error ? row.error->detail : unknown; }},
         {"true error of the rest",
          [](const StepRow& row) { return row.error ? row.error->rest : unknown; }},
         {"error of the light itself",
          [](const StepRow& row) { return row.total_error.value_or(unknown); }}}};
    return kinds;
}

Chart error_chart(const std::string& title, const std::string& y_label,
                  std::span<const ChartedRuns> curves) {
    Chart chart{title,
                y_label,
                {},
                {{"seconds, preprocessing included", {}}, {"rays, density rays included", {}}}};
    for (const ChartedRuns& charted : curves) {
        chart.names.push_back(charted.name);
        chart.panels[0].curves.push_back(mean_of(charted, seconds_of));
        chart.panels[1].curves.push_back(mean_of(charted, rays_of));
    }
    return chart;
}

PageChart page_chart(const std::string& name, std::span<const ChartedRuns> curves) {
    Chart chart = error_chart("", "relative error, %", curves);
    bool any = false;
    for (const ChartedRuns& charted : curves) {
        chart.panels[0].dots.push_back(dots_of(charted, seconds_of));
        chart.panels[1].dots.push_back(dots_of(charted, rays_of));
        any = any || !chart.panels[0].dots.back().empty();
    }
    return {name, any ? chart_svg(chart) : ""};
}

} // namespace hemilux
