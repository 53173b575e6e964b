#pragma once
// Fields and records of CSV (RFC 4180).

#include "geometry/vector.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hemilux {
class Workers;
}

namespace hemilux::csv {

/// Appends the shortest text that gives back the same double, or `nan`, `inf`, `-inf`.
void append_number(std::string& line, double value);
void append_number(std::string& line, std::uint64_t value);
/// Appends a text, quoted where it needs that. A spreadsheet takes a cell for a formula that begins
/// with = + - or @, or with a tab or line end. Such a name gets an apostrophe in front. Numbers are
/// written by append_number, which adds none.
void append_text(std::string& line, std::string_view text);

/// Appends a comma and a field.
void append_field(std::string& line, double value);
void append_field(std::string& line, std::uint64_t value);
void append_field(std::string& line, std::string_view text);
/// Appends a comma and, unless it is NaN, a number.
void append_known(std::string& line, double value);
/// Appends a comma and a number three times.
void append_fields(std::string& line, const Vec3& v);

/// Three columns NAME.r, NAME.g and NAME.b that a table may end with.
struct ColourColumns {
    std::string name;
    std::function<Vec3(std::size_t row)> value;
};
/// What a table may end with: a column of words, and columns of colours.
struct MoreColumns {
    std::string word_name = {}; ///< empty: there are no words
    std::function<std::string_view(std::size_t row)> word = {};
    std::vector<ColourColumns> colours = {};
};
/// Appends their names, and their fields of a row, each after a comma.
void append_names(std::string& header, const MoreColumns& columns);
void append_fields(std::string& line, const MoreColumns& columns, std::size_t row);

/// Writes a table: a header, and rows that `append_row` appends to a text with their line ends.
/// Threads append some while others are written; the bytes are the same for any number of threads.
/// Throws OutputError.
void write_table(const std::string& path, const std::string& header, std::size_t rows,
                 const Workers& workers,
                 const std::function<void(std::size_t row, std::string& text)>& append_row);

/// Reads records one after the other. Accepts CRLF and a missing final newline.
class Reader {
  public:
    /// `file` is for messages. Both must outlive the reader.
    Reader(const std::string& file, std::string_view content);

    /// Reads the next record that is not an empty line; false at the end. Throws InputError.
    bool next(std::vector<std::string>& fields);
    /// Returns the line where the last record began, from 1.
    [[nodiscard]] std::size_t line() const { return line_; }

  private:
    void read_quoted(std::string& field);
    [[nodiscard]] bool at_line_end() const;
    void skip_line_end();

    const std::string& file_;
    std::string_view left_;
    std::size_t line_ = 0, next_line_ = 1;
};

} // namespace hemilux::csv
