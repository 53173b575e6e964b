#include "io/files/text_reader.h"

#include "io/files/error.h"
#include "io/files/other_format.h"
#include "io/files/text_words.h"

#include <algorithm>

namespace hemilux {

std::string read_text_file(const std::string& path, InputKind kind) {
    std::size_t checked = 0;
    const auto check = [&](std::string_view content) {
        if (const std::string_view other = other_format(content); !other.empty())
            throw InputError(path, "expected text, the file is " + std::string(other));
        const std::size_t nul = content.find('\0', checked);
        checked = content.size();
        if (nul == std::string_view::npos)
            return;
        const auto lines =
            std::count(content.begin(), content.begin() + static_cast<std::ptrdiff_t>(nul), '\n') +
            1;
        throw InputError(path, static_cast<std::size_t>(lines),
                         "expected text, found a NUL byte (a binary or UTF-16 file?)");
    };
    std::string content = read_input(path, kind, check);
    if (content.starts_with(byte_order_mark))
        content.erase(0, byte_order_mark.size());
    return content;
}

std::size_t TextReader::after_line_end(std::size_t at) const {
    if (at >= content_.size())
        return content_.size();
    return at + (content_.compare(at, 2, "\r\n") == 0 ? 2 : 1);
}

/// Joins lines in place, blanks replacing the backslash and the line's end.
std::string_view TextReader::next_line() {
    line_ += lines_joined_;
    lines_joined_ = 1;
    const std::size_t begin = at_;
    bool has_comment = false;
    for (std::size_t i = begin;; ++i) {
        const char c = i < content_.size() ? content_[i] : '\n';
        has_comment |= c == '#';
        if (c != '\n' && c != '\r')
            continue;
        at_ = after_line_end(i);
        const bool joined = !has_comment && i > begin && content_[i - 1] == '\\' && at_ > i;
        if (!joined)
            return std::string_view(content_).substr(begin, i - begin);
        ++lines_joined_;
        std::fill(content_.begin() + static_cast<std::ptrdiff_t>(i - 1),
                  content_.begin() + static_cast<std::ptrdiff_t>(at_), ' ');
        i = at_ - 1;
    }
}

Vec3 point_of(const Statement& statement, const std::string& path) {
    std::string_view rest = statement.rest;
    Vec3 point;
    for (int axis = 0; axis < 3; ++axis) {
        const std::string_view word = take_word(rest);
        const std::optional<double> number = parse_decimal(word);
        if (!number)
            throw InputError(path, statement.line,
                             "expected three numbers after " + std::string(statement.keyword) +
                                 ", " + found_instead_of_number(word));
        point[axis] = *number;
    }
    return point;
}

bool TextReader::next(Statement& statement) {
    while (at_ < content_.size()) {
        std::string_view text = next_line();
        statement.keyword = take_word(text);
        if (statement.keyword.empty())
            continue;
        statement.rest = trimmed(text);
        statement.line = line_;
        return true;
    }
    return false;
}

} // namespace hemilux
