#include "app/commands/compare_summary.h"

#include "radiosity/answers/asked/text.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hemilux {

std::vector<const MethodRun*> runs_that_count(const MethodRuns& runs) {
    std::vector<const MethodRun*> complete, begun;
    for (const MethodRun& run : runs.runs) {
        if (run.complete)
            complete.push_back(&run);
        if (!run.rows.empty())
            begun.push_back(&run);
    }
    return complete.empty() ? begun : complete;
}

namespace {

using Figure = double (*)(const StepRow&);

double rays_of(const StepRow& row) { return static_cast<double>(row.record.rays); }
double seconds_of(const StepRow& row) { return row.record.seconds; }

double mean(const std::vector<const MethodRun*>& runs, Figure figure) {
    double sum = 0;
    for (const MethodRun* const run : runs)
        sum += figure(run->rows.back());
    return sum / static_cast<double>(runs.size());
}

double geometric_mean(const std::vector<const MethodRun*>& runs, Figure figure) {
    std::vector<double> numbers;
    for (const MethodRun* const run : runs)
        numbers.push_back(figure(run->rows.back()));
    return hemilux::geometric_mean(numbers);
}

std::vector<ErrorCurve> curves_of(const std::vector<const MethodRun*>& runs, Figure x) {
    std::vector<ErrorCurve> curves;
    for (const MethodRun* const run : runs) {
        ErrorCurve& points = curves.emplace_back();
        for (const StepRow& row : run->rows)
            append(points, {x(row), row.total_error.value_or(row.error->all)});
    }
    return curves;
}

MethodSummary summarise(const MethodRuns& result, bool literal) {
    const std::vector<const MethodRun*> runs = runs_that_count(result);
    MethodSummary summary;
    summary.label =
        result.variant.name + (literal && result.variant.method->has_literal ? " (literal)" : "");
    summary.rays = mean(runs, rays_of);
    summary.seconds = mean(runs, seconds_of);
    summary.error = {geometric_mean(runs, [](const StepRow& row) { return row.error->all; }),
                     geometric_mean(runs, [](const StepRow& row) { return row.error->detail; }),
                     geometric_mean(runs, [](const StepRow& row) { return row.error->rest; })};
    if (runs.front()->rows.back().total_error)
        summary.total_error =
            geometric_mean(runs, [](const StepRow& row) { return *row.total_error; });
    if (runs.front()->rows.back().relative_mse)
        summary.relative_mse = mean(runs, [](const StepRow& row) { return *row.relative_mse; });
    summary.estimated_error =
        geometric_mean(runs, [](const StepRow& row) { return row.record.estimated_error; });
    summary.runs = runs.size();
    summary.runs_by_seconds = curves_of(runs, seconds_of);
    summary.runs_by_rays = curves_of(runs, rays_of);
    for (const MethodRun* const run : runs)
        summary.bytes_density = std::max(summary.bytes_density, run->bytes_density);
    return summary;
}

std::string number(const char* format, double x) {
    return std::isfinite(x) ? formatted(format, x) : "-";
}

std::optional<Gain> gain_of(std::span<const ErrorCurve> runs,
                            std::span<const ErrorCurve> base_runs) {
    const std::optional<double> times = speed_up(runs, base_runs);
    return times ? std::optional(Gain{*times, speed_up_error(runs, base_runs)}) : std::nullopt;
}

std::string gain(const std::optional<Gain>& x) {
    if (!x)
        return "-";
    const std::string times = formatted("%.2f", x->times);
    if (!x->standard_error)
        return times + " +- ?";
    return *x->standard_error == 0 ? times : times + formatted(" +- %.2f", *x->standard_error);
}

/// The column of the total error and of relMSE, where there are any, before `error %`.
constexpr std::ptrdiff_t total_column = 3;

std::vector<std::string> table_row(const MethodSummary& s) {
    std::vector<std::string> row = {s.label,
                                    std::isfinite(s.rays) ? short_count(s.rays) : "-",
                                    number("%.3g", s.seconds),
                                    number("%.3g", 100 * s.error.all),
                                    number("%.3g", 100 * s.error.detail),
                                    number("%.3g", 100 * s.error.rest),
                                    number("%.3g", 100 * s.estimated_error),
                                    number("%.2f", s.estimated_error / s.error.all),
                                    gain(s.gain_seconds),
                                    gain(s.gain_rays),
                                    s.bytes_density > 0 ? byte_size(s.bytes_density) : "-"};
    if (s.relative_mse)
        row.insert(row.begin() + total_column, number("%.3g", *s.relative_mse));
    if (s.total_error)
        row.insert(row.begin() + total_column, number("%.3g", 100 * *s.total_error));
    return row;
}

using Rows = std::vector<std::vector<std::string>>;

/// Returns the first column and some of the others.
Rows with_columns(const Rows& rows, std::span<const std::size_t> columns) {
    Rows some;
    for (const auto& row : rows) {
        some.push_back({row.front()});
        for (const std::size_t c : columns)
            some.back().push_back(row[c]);
    }
    return some;
}

std::vector<std::size_t> known_columns(const Rows& rows) {
    std::vector<std::size_t> known;
    for (std::size_t c = 1; c < rows.front().size(); ++c)
        if (std::any_of(rows.begin() + 1, rows.end(),
                        [&](const auto& row) { return row[c] != "-"; }))
            known.push_back(c);
    return known;
}

/// Returns lines of text: columns two blanks apart, the first flush left, the others flush right.
std::string aligned(const Rows& rows) {
    std::vector<std::size_t> widths(rows.front().size());
    for (const auto& row : rows)
        for (std::size_t c = 0; c < row.size(); ++c)
            widths[c] = std::max(widths[c], row[c].size());
    std::string text;
    for (const auto& row : rows) {
        for (std::size_t c = 0; c < row.size(); ++c) {
            const std::string fill(widths[c] - row[c].size(), ' ');
            text += c == 0 ? row[c] + fill : "  " + fill + row[c];
        }
        text += '\n';
    }
    return text;
}

} // namespace

std::string aligned_for(std::size_t columns, const std::vector<std::vector<std::string>>& rows) {
    const auto fits = [&](const std::string& table) { return table.find('\n') <= columns; };
    std::string text = aligned(rows);
    if (columns == 0 || fits(text))
        return text;
    text.clear();
    const std::vector<std::size_t> known = known_columns(rows);
    for (std::span<const std::size_t> left(known); !left.empty();) {
        std::size_t count = 1;
        while (count < left.size() && fits(aligned(with_columns(rows, left.first(count + 1)))))
            ++count;
        text += (text.empty() ? "" : "\n") + aligned(with_columns(rows, left.first(count)));
        left = left.subspan(count);
    }
    return text;
}

std::vector<MethodSummary> summarise(std::span<const MethodRuns> results, bool literal) {
    std::vector<MethodSummary> summaries;
    for (const MethodRuns& result : results)
        summaries.push_back(summarise(result, literal));
    const auto base = std::ranges::find(results, method_of(Role::baseline).name,
                                        [](const MethodRuns& r) { return r.variant.name; });
    if (base == results.end())
        return summaries;
    const MethodSummary yardstick = summaries[static_cast<std::size_t>(base - results.begin())];
    for (MethodSummary& summary : summaries) {
        summary.gain_seconds = gain_of(summary.runs_by_seconds, yardstick.runs_by_seconds);
        summary.gain_rays = gain_of(summary.runs_by_rays, yardstick.runs_by_rays);
        if (summary.label == yardstick.label) // whatever the runs, it gains nothing on itself
            for (std::optional<Gain>* const own : {&summary.gain_seconds, &summary.gain_rays})
                if (*own)
                    *own = Gain{1, 0.0};
    }
    return summaries;
}

std::vector<std::vector<std::string>> summary_rows(std::span<const MethodSummary> summaries) {
    std::vector<std::vector<std::string>> rows{{"method", "rays", "seconds", "error %", "detail %",
                                                "rest %", "estimated %", "estimated/error",
                                                "time gain", "ray gain", "density bytes"}};
    if (!summaries.empty() && summaries.front().relative_mse)
        rows.front().insert(rows.front().begin() + total_column, "relMSE");
    if (!summaries.empty() && summaries.front().total_error)
        rows.front().insert(rows.front().begin() + total_column, "total %");
    for (const MethodSummary& summary : summaries)
        rows.push_back(table_row(summary));
    return rows;
}

std::string gain_note(std::span<const MethodSummary> summaries) {
    bool known = false, unknown = false;
    std::size_t least = std::numeric_limits<std::size_t>::max();
    for (const MethodSummary& summary : summaries) {
        least = std::min(least, summary.runs);
        for (const std::optional<Gain>& gain : {summary.gain_seconds, summary.gain_rays}) {
            known |= gain && gain->standard_error > 0.0;
            unknown |= gain && !gain->standard_error;
        }
    }
    if (unknown && least < 2)
        return "gains are from one run: uncertainty unknown; --runs asks for more";
    if (unknown)
        return "+- ?: without one of the runs there is no such gain, so its uncertainty is unknown";
    if (known)
        return "+-: standard error of the gain, from the spread of " +
               counted(least, "run", "runs");
    return "";
}

} // namespace hemilux
