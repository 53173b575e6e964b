// The reading half of tables.h.

#include "io/files/error.h"
#include "io/files/text_reader.h"
#include "io/results/csv.h"
#include "io/results/tables.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string_view>

namespace hemilux {
namespace {

/// The columns that are read, in the order of `Record`.
constexpr std::array<std::string_view, 11> wanted{
    "patch",       "area",        "x",        "y",        "z",       "radiosity_r",
    "radiosity_g", "radiosity_b", "stderr_r", "stderr_g", "stderr_b"};
using Record = std::array<double, wanted.size()>;

/// Finds where each wanted column stands in the file.
std::array<std::size_t, wanted.size()> find_columns(const std::string& path, std::size_t line,
                                                    const std::vector<std::string>& header) {
    std::array<std::size_t, wanted.size()> column{};
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        const auto found = std::find(header.begin(), header.end(), wanted[i]);
        if (found == header.end())
            throw InputError(path, line,
                             "expected the header of a patch table with a column '" +
                                 std::string(wanted[i]) + "'");
        column[i] = static_cast<std::size_t>(found - header.begin());
    }
    return column;
}

/// Digits too many for a double are rounded, not refused.
double number_in(const std::string& path, std::size_t line, std::string_view name,
                 const std::string& text) {
    double value = 0;
    const char* end = text.data() + text.size();
    const auto [rest, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc() || rest != end)
        throw InputError(path, line,
                         "expected a number in column '" + std::string(name) + "', got '" + text +
                             "'");
    return value;
}

/// Checks a record, in which only a standard error may be unknown.
void check(const std::string& path, std::size_t line, const Record& record, std::size_t row) {
    if (record[0] != static_cast<double>(row))
        throw InputError(path, line, "expected patch " + std::to_string(row));
    for (std::size_t i = 1; i < 8; ++i)
        if (!std::isfinite(record[i]))
            throw InputError(path, line,
                             "expected a finite number in column '" + std::string(wanted[i]) + "'");
    if (!(record[1] > 0))
        throw InputError(path, line, "expected a positive area");
}

} // namespace

PatchTable read_patch_table(const std::string& path) {
    const std::string content = read_text_file(path, InputKind::stream);
    constexpr double bytes_per_byte = 4; // the table, which grows by being copied
    ask_for_input(path, bytes_per_byte * static_cast<double>(content.size()));
    csv::Reader reader(path, content);
    std::vector<std::string> fields;
    if (!reader.next(fields))
        throw InputError(path, "is empty; expected a patch table");
    const auto column = find_columns(path, reader.line(), fields);
    const std::size_t width = fields.size();
    PatchTable table;
    while (reader.next(fields)) {
        const std::size_t line = reader.line();
        if (fields.size() != width)
            throw InputError(path, line,
                             "expected " + std::to_string(width) + " fields, got " +
                                 std::to_string(fields.size()));
        Record r;
        for (std::size_t i = 0; i < wanted.size(); ++i)
            r[i] = number_in(path, line, wanted[i], fields[column[i]]);
        check(path, line, r, table.area.size());
        table.area.push_back(r[1]);
        table.centre.emplace_back(r[2], r[3], r[4]);
        table.radiosity.emplace_back(r[5], r[6], r[7]);
        table.standard_error.emplace_back(r[8], r[9], r[10]);
    }
    return table;
}

} // namespace hemilux
