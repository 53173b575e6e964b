#pragma once
// An independent reader of files of VTK in XML whose arrays are raw bytes at the end.

#include "support/catch.h"

#include <cstdint>
#include <cstring>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace hemilux::test {

/// A quoted attribute of an element; empty where it has none.
inline std::string attribute(const std::string& element, const std::string& name) {
    const std::size_t at = element.find(" " + name + "=\"");
    if (at == element.npos)
        return {};
    const std::size_t begin = at + name.size() + 3;
    return element.substr(begin, element.find('"', begin) - begin);
}

template <class Number>
std::vector<double> numbers_at(const std::string& bytes) {
    std::uint64_t length = 0;
    REQUIRE(bytes.size() >= sizeof length);
    std::memcpy(&length, bytes.data(), sizeof length);
    REQUIRE(sizeof length + length <= bytes.size());
    std::vector<Number> numbers(length / sizeof(Number));
    std::memcpy(numbers.data(), bytes.data() + sizeof length, length);
    return {numbers.begin(), numbers.end()};
}

/// Returns all arrays of a file's content by name, those of texts as their letters' numbers.
inline std::map<std::string, std::vector<double>> arrays_of(const std::string& file) {
    const std::string mark = "<AppendedData encoding=\"raw\">\n_";
    const std::size_t begin = file.find(mark) + mark.size();
    REQUIRE(file.ends_with("\n</AppendedData>\n</VTKFile>\n"));
    std::map<std::string, std::vector<double>> arrays;
    for (std::size_t at = file.find("<DataArray"); at < begin;
         at = file.find("<DataArray", at + 1)) {
        const std::string element = file.substr(at, file.find('>', at) - at);
        std::vector<double>& array = arrays[attribute(element, "Name")];
        const std::string type = attribute(element, "type");
        if (type == "String") {
            std::istringstream letters(file.substr(at + element.size() + 1));
            for (double letter = 0; letters >> letter;)
                array.push_back(letter);
            continue;
        }
        const std::string bytes = file.substr(begin + std::stoul(attribute(element, "offset")));
        array = type == "Float64"  ? numbers_at<double>(bytes)
                : type == "UInt8"  ? numbers_at<std::uint8_t>(bytes)
                : type == "UInt32" ? numbers_at<std::uint32_t>(bytes)
                                   : numbers_at<std::uint64_t>(bytes);
    }
    return arrays;
}

} // namespace hemilux::test
