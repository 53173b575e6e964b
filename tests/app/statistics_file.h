#pragma once
// Numbers of a file that --stats wrote.

#include "support/catch.h"

#include <cmath>
#include <string>

namespace test {

/// Of a line `"key": number,`; NaN for null.
inline double statistic(const std::string& json, const std::string& key) {
    const std::size_t at = json.find("\"" + key + "\": ");
    REQUIRE(at != std::string::npos);
    const std::string value = json.substr(at + key.size() + 4);
    return value.rfind("null", 0) == 0 ? std::nan("") : std::stod(value);
}

} // namespace test
