// Each scene file of tests/io/hostile ends the program with one message that names the file, and
// exit code 2.
#include "app/program.h"
#include "support/catch.h"

#include <algorithm>
#include <filesystem>

namespace fs = std::filesystem;
using test::Workplace;

TEST_CASE("every hostile scene gets one message and exit code 2") {
    const Workplace place;
    std::size_t files = 0;
    for (const fs::directory_entry& entry :
         fs::directory_iterator(fs::path(HEMILUX_SOURCE_DIR) / "tests/io/hostile")) {
        const std::string extension = entry.path().extension().string();
        if (extension == ".mtl" || extension == ".png")
            continue;
        ++files;
        const auto run = place.hemilux("info " + entry.path().string());
        CAPTURE(entry.path().filename().string(), run.err);
        CHECK(run.code == 2);
        CHECK(run.out.empty());
        CHECK(std::ranges::count(run.err, '\n') == 1);
        CHECK(run.err.find("tests/io/hostile/") != std::string::npos);
    }
    CHECK(files > 25);
}
