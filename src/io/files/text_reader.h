#pragma once
// Text files that consist of statements, one a line: OBJ and MTL. A statement is a keyword and the
// rest of its line; what the rest means is read by text_words.h.

#include "geometry/vector.h"
#include "io/files/input_file.h"

#include <cstddef>
#include <string>
#include <string_view>

namespace hemilux {

inline constexpr std::string_view byte_order_mark = "\xef\xbb\xbf"; ///< mark of UTF-8

/// Returns the content of a text file without its byte order mark. Throws InputError for what is no
/// such file: a directory, a device, UTF-16, anything with a NUL byte (where reading ends).
[[nodiscard]] std::string read_text_file(const std::string& path, InputKind kind);

struct Statement {
    std::string_view keyword;
    std::string_view rest; ///< rest without blanks around it; a comment is still there
    std::size_t line = 0;  ///< line where it begins, from 1
};

/// Reads the three numbers that a statement begins with. Throws InputError for anything else.
[[nodiscard]] Vec3 point_of(const Statement& statement, const std::string& path);

/// Lines end with LF, CRLF or CR. A backslash at the end of a line joins it with the next, unless a
/// comment stands before it. Lines that are empty or comments are left out.
class TextReader {
  public:
    explicit TextReader(std::string content) : content_(std::move(content)) {}

    /// Finds the next statement, which is valid as long as the reader; false at the end.
    bool next(Statement& statement);
    /// Returns all of the text, which statements are parts of.
    [[nodiscard]] std::string_view content() const { return content_; }

  private:
    [[nodiscard]] std::string_view next_line();
    [[nodiscard]] std::size_t after_line_end(std::size_t at) const;

    std::string content_;
    std::size_t at_ = 0, line_ = 0, lines_joined_ = 1;
};

} // namespace hemilux
