#pragma once
// Text by lines, and tables of text.

#include <sstream>
#include <string>
#include <vector>

namespace test {

inline std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);)
        lines.push_back(line);
    return lines;
}

/// The fields of each line; fields in quotes are not known here.
inline std::vector<std::vector<std::string>> split(const std::string& text, char separator) {
    std::vector<std::vector<std::string>> rows;
    for (const std::string& line : lines_of(text)) {
        std::istringstream stream(line);
        std::vector<std::string>& row = rows.emplace_back();
        for (std::string field; std::getline(stream, field, separator);)
            row.push_back(field);
    }
    return rows;
}

} // namespace test
