// No result hangs on what a C or C++ library makes of it: elementary functions and random numbers
// of a range are this project's own.

#include "support/catch.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <regex>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

/// Places where the last bit does not show.
const std::array<std::string, 4> exceptions{
    "geometry/elementary.",      // the project's own
    "io/drawings/",              // numbers of a few digits
    "app/rendering/view.cpp",    // the whole part of a logarithm to base 10
    "app/terminal/progress.cpp", // a time that remains
};

bool is_exception(const std::string& file) {
    return std::ranges::any_of(exceptions,
                               [&](const auto& place) { return file.starts_with(place); });
}

/// Whether a line calls what libraries do in different ways.
bool depends_on_library(const std::string& line) {
    static const std::string names = "a?(sin|cos|tan)h?|atan2|log(2|10|1p)|exp(2|m1)?|pow|cbrt|"
                                     "hypot|[lt]gamma|erfc?";
    // As a member or of elementary:: it is this project's own; log() is often a member's
    // definition.
    static const std::regex functions("((std|glm)::|(^|[^\\w:])::)(log|" + names +
                                      ")[fl]?\\(|(^|[^\\w:.>])(" + names + ")[fl]?\\(");
    static const std::regex others("(std::(shuffle|hash)\\b|_distribution\\b|"
                                   "glm::(angle|orientedAngle|rotate|slerp)\\b)");
    const std::string code = line.substr(0, line.find("//"));
    return std::regex_search(code, functions) || std::regex_search(code, others);
}

} // namespace

TEST_CASE("the rule about library functions tells right from wrong") {
    CHECK(depends_on_library("    return std::sin(x);"));
    CHECK(depends_on_library("    return 2 * (1 + std::atan2(y, x));"));
    CHECK(depends_on_library("x = std::powf(x, 2) + glm::acos(y);"));
    CHECK(depends_on_library("x = ::log1p(x);"));
    CHECK(depends_on_library("x = ::log(x);"));
    CHECK(depends_on_library("pow(x, y)"));
    CHECK(depends_on_library("std::uniform_real_distribution<double> u(0, 1);"));
    CHECK(depends_on_library("glm::angle(a, b)"));
    CHECK_FALSE(depends_on_library("    return elementary::sin(x) + std::sqrt(y);"));
    CHECK_FALSE(depends_on_library("    x = 3; // as std::sin(x)"));
    CHECK_FALSE(depends_on_library("x = first_log(x) + own.exp(x) + to->pow(x, y);"));
    CHECK_FALSE(depends_on_library("report.log(verbosity); std::floor(x); std::max(a, b);"));
}

TEST_CASE("results depend on no elementary function of a library") {
    const fs::path root = fs::path(HEMILUX_SOURCE_DIR) / "src";
    std::vector<std::string> wrong;
    std::size_t files = 0;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root)) {
        const std::string extension = entry.path().extension().string();
        const std::string file = fs::relative(entry.path(), root).generic_string();
        if ((extension != ".h" && extension != ".cpp") || is_exception(file))
            continue;
        ++files;
        std::ifstream stream(entry.path());
        for (std::string line; std::getline(stream, line);)
            if (depends_on_library(line))
                wrong.push_back(file + ": " + line);
    }
    CHECK(files > 300);
    CAPTURE(wrong);
    CHECK(wrong.empty());
}
