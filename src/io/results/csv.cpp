#include "io/results/csv.h"

#include "io/files/atomic_file.h"
#include "io/files/error.h"
#include "parallel/workers.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace hemilux::csv {
namespace {

/// A used field keeps its memory from record to record.
std::string& field_at(std::vector<std::string>& fields, std::size_t index) {
    if (index == fields.size())
        fields.emplace_back();
    fields[index].clear();
    return fields[index];
}

} // namespace

void append_number(std::string& line, double value) {
    char text[32];
    const double positive_nan = std::isnan(value) ? std::abs(value) : value;
    line.append(text, std::to_chars(text, text + sizeof text, positive_nan).ptr);
}

void append_number(std::string& line, std::uint64_t value) {
    char text[32];
    line.append(text, std::to_chars(text, text + sizeof text, value).ptr);
}

void append_text(std::string& line, std::string_view name) {
    std::string text(name);
    if (!text.empty() &&
        std::string_view("=+-@\t\r\n").find(text.front()) != std::string_view::npos)
        text.insert(text.begin(), '\'');
    if (text.find_first_of(",\"\r\n") == std::string_view::npos) {
        line += text;
        return;
    }
    line += '"';
    for (const char c : text)
        line.append(c == '"' ? 2 : 1, c);
    line += '"';
}

void append_field(std::string& line, double value) { append_number(line += ',', value); }
void append_field(std::string& line, std::uint64_t value) { append_number(line += ',', value); }
void append_field(std::string& line, std::string_view text) { append_text(line += ',', text); }

void append_known(std::string& line, double value) {
    line += ',';
    if (!std::isnan(value))
        append_number(line, value);
}

void append_fields(std::string& line, const Vec3& v) {
    for (int i = 0; i < 3; ++i)
        append_field(line, v[i]);
}

void append_names(std::string& header, const MoreColumns& columns) {
    if (!columns.word_name.empty())
        append_field(header, columns.word_name);
    for (const ColourColumns& column : columns.colours)
        for (const char* const channel : {".r", ".g", ".b"})
            append_field(header, column.name + channel);
}

void append_fields(std::string& line, const MoreColumns& columns, std::size_t row) {
    if (!columns.word_name.empty())
        append_field(line, columns.word(row));
    for (const ColourColumns& column : columns.colours)
        append_fields(line, column.value(row));
}

void write_table(const std::string& path, const std::string& header, std::size_t rows,
                 const Workers& workers,
                 const std::function<void(std::size_t row, std::string& text)>& append_row) {
    constexpr std::size_t rows_per_text = 256, texts_at_a_time = 64; // about 4 MB
    AtomicFile file(path);
    file.write(header + "\n");
    std::array<std::string, texts_at_a_time> texts;
    for (std::size_t first = 0; first < rows; first += texts.size() * rows_per_text) {
        const auto begin_of = [&](std::size_t text) {
            return std::min(first + text * rows_per_text, rows);
        };
        workers.for_each_in_order(
            texts.size(),
            [&](std::size_t k) {
                texts[k].clear();
                for (std::size_t row = begin_of(k); row < begin_of(k + 1); ++row)
                    append_row(row, texts[k]);
            },
            [&](std::size_t k) { file.write(texts[k]); });
    }
    file.commit();
}

Reader::Reader(const std::string& file, std::string_view content) : file_(file), left_(content) {}

bool Reader::next(std::vector<std::string>& fields) {
    while (!left_.empty() && at_line_end())
        skip_line_end();
    line_ = next_line_;
    if (left_.empty())
        return false;
    std::size_t count = 0;
    for (;;) {
        std::string& field = field_at(fields, count++);
        if (!left_.empty() && left_.front() == '"') {
            read_quoted(field);
        } else {
            const std::size_t length = std::min(left_.find_first_of(",\r\n"), left_.size());
            field = left_.substr(0, length);
            left_.remove_prefix(length);
        }
        if (left_.empty() || left_.front() != ',')
            break;
        left_.remove_prefix(1);
    }
    if (!left_.empty() && !at_line_end())
        throw InputError(file_, next_line_,
                         "expected a comma or the line's end after a quoted field");
    if (!left_.empty())
        skip_line_end();
    fields.resize(count);
    return true;
}

void Reader::read_quoted(std::string& field) {
    for (;;) {
        left_.remove_prefix(1); // the opening quote, or the first of a doubled one
        const std::size_t length = left_.find('"');
        if (length == std::string_view::npos)
            throw InputError(file_, line_, "a quoted field has no closing quote");
        const std::string_view part = left_.substr(0, length);
        field += part;
        next_line_ += static_cast<std::size_t>(std::count(part.begin(), part.end(), '\n'));
        left_.remove_prefix(length + 1);
        if (left_.empty() || left_.front() != '"')
            return;
        field += '"';
    }
}

bool Reader::at_line_end() const { return left_.front() == '\n' || left_.front() == '\r'; }

void Reader::skip_line_end() {
    const bool two = left_.substr(0, 2) == "\r\n";
    left_.remove_prefix(two ? 2 : 1);
    ++next_line_;
}

} // namespace hemilux::csv
