// The storeys that the lesson compiles for browsers use only those algorithms over ranges that its
// library has: Debian's emscripten has an old one, which lesson/module/cxx20 completes.

#include "support/catch.h"

#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace fs = std::filesystem;

namespace {

std::vector<std::string> lines_of(const fs::path& file) {
    std::vector<std::string> lines;
    std::ifstream stream(file);
    for (std::string line; std::getline(stream, line);)
        lines.push_back(line);
    return lines;
}

} // namespace

TEST_CASE("what browsers run uses no algorithm that the lesson's library lacks") {
    const fs::path root = HEMILUX_SOURCE_DIR;
    static const std::regex defined("^constexpr (?:auto|bool|void) (\\w+)\\(|^void (\\w+)\\(");
    static const std::regex used("std::ranges::(\\w+)\\([^)]");
    std::set<std::string> known;
    for (const std::string& line : lines_of(root / "lesson/module/cxx20/algorithm"))
        if (std::smatch found; std::regex_search(line, found, defined))
            known.insert(found[1].matched ? found[1] : found[2]);
    CHECK(known.size() > 15);
    std::size_t uses = 0;
    for (const char* const folder :
         {"src/geometry", "src/bvh", "src/parallel", "src/radiosity/paper", "src/radiosity/engine"})
        for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root / folder))
            for (const std::string& line : lines_of(entry.path()))
                for (std::sregex_iterator at(line.begin(), line.end(), used), end; at != end;
                     ++at) {
                    ++uses;
                    CAPTURE(entry.path().string(), line);
                    CHECK(known.contains((*at)[1]));
                }
    CHECK(uses > 50);
}
