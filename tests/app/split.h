#pragma once
// Tables of text.

#include <sstream>
#include <string>
#include <vector>

namespace test {

/// The fields of each line; fields in quotes are not known here.
inline std::vector<std::vector<std::string>> split(const std::string& text, char separator) {
    std::vector<std::vector<std::string>> rows;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        std::istringstream stream(line);
        std::vector<std::string>& row = rows.emplace_back();
        for (std::string field; std::getline(stream, field, separator);)
            row.push_back(field);
    }
    return rows;
}

} // namespace test
