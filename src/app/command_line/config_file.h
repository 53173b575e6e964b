#pragma once
// Options kept in a file: the part of TOML 1.0 that options need.
//
//     # for all subcommands that have the option
//     error = "1%"
//     sides = "both"
//     [solve]
//     output = ["room.png", "room.csv"]
//     sky = [1, 1, 1.2]
//
// Keys are bare; values are strings of one line, numbers, true, false, and arrays of strings and
// numbers. Tables are subcommands.

#include <cstddef>
#include <string>
#include <vector>

namespace hemilux {

/// One `key = value` of the file.
struct ConfigEntry {
    std::string table; ///< empty: before the first table
    std::string key;
    std::vector<std::string> values; ///< numbers as they are written; `true` and `false` too
    bool truth = false;              ///< the value is true or false
    bool list = false;               ///< the value is an array of strings; numbers make one value
    std::size_t line = 0;            ///< number of the line, from 1
};

/// Reads a file. Throws InputError with the line, also where a key stands twice in a table.
[[nodiscard]] std::vector<ConfigEntry> read_config(const std::string& path);

} // namespace hemilux
