// Includes go one way, geometry <- bvh <- radiosity <- io <- app, and each dependency has one
// place.
#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

const std::array<std::string, 5> layers{"geometry", "bvh", "radiosity", "io", "app"};

std::ptrdiff_t layer_of(const std::string& path) {
    const std::string folder = path.substr(0, path.find('/'));
    const auto found = std::find(layers.begin(), layers.end(), folder);
    return found == layers.end() ? -1 : found - layers.begin();
}

/// Whether `file` (relative to src/) may say #include <header>.
bool may_include_system(const std::string& file, const std::string& header) {
    const auto begins = [&](const char* text) { return header.rfind(text, 0) == 0; };
    const bool source = fs::path(file).extension() == ".cpp";
    const std::string layer = layers.at(static_cast<std::size_t>(layer_of(file)));
    if (begins("glm/"))
        return true;
    if (begins("stb") || begins("nlohmann/"))
        return layer == "io" && source;
    if (begins("CLI/"))
        return layer == "app";
    if (header == "immintrin.h" || header == "sys/mman.h")
        return layer == "bvh"; // intrinsics and huge pages
    const bool standard = header.find_first_of("./") == std::string::npos;
    const bool posix =
        header.ends_with(".h") && (header.find('/') == std::string::npos || begins("sys/"));
    return standard || (posix && source && (layer == "io" || layer == "app"));
}

/// The header of an #include line and whether it stands in quotes; empty for any other line.
std::string included(const std::string& line, bool& quoted) {
    const std::size_t hash = line.find_first_not_of(" \t");
    if (hash == std::string::npos || line[hash] != '#' ||
        line.find("include", hash) == std::string::npos)
        return {};
    const std::size_t open = line.find_first_of("\"<", hash);
    if (open == std::string::npos)
        return {};
    quoted = line[open] == '"';
    return line.substr(open + 1, line.find_first_of("\">", open + 1) - open - 1);
}

bool allowed(const std::string& file, const std::string& line) {
    bool quoted = false;
    const std::string header = included(line, quoted);
    if (header.empty())
        return true;
    if (!quoted)
        return may_include_system(file, header);
    return layer_of(header) >= 0 && layer_of(header) <= layer_of(file);
}

} // namespace

TEST_CASE("the rule about includes tells right from wrong") {
    CHECK(allowed("bvh/build.cpp", "#include \"geometry/box.h\""));
    CHECK(allowed("bvh/build.cpp", "#include <vector>"));
    CHECK(allowed("geometry/vector.h", "#include <glm/glm.hpp>"));
    CHECK(allowed("io/image.cpp", "#include <stb_image_write.h>"));
    CHECK(allowed("app/main.cpp", "#include <CLI/CLI.hpp>"));
    CHECK(allowed("app/main.cpp", "int include = 3; // \"io/obj.h\""));
    CHECK_FALSE(allowed("geometry/box.h", "#include \"bvh/tracer.h\""));
    CHECK_FALSE(allowed("radiosity/mesh.cpp", "  #  include \"io/error.h\""));
    CHECK_FALSE(allowed("bvh/build.cpp", "#include \"build.h\""));
    CHECK_FALSE(allowed("io/image.h", "#include <stb_image_write.h>"));
    CHECK_FALSE(allowed("radiosity/solver.h", "#include <nlohmann/json.hpp>"));
    CHECK_FALSE(allowed("io/obj.cpp", "#include <CLI/CLI.hpp>"));
    CHECK_FALSE(allowed("geometry/box.h", "#include <unistd.h>"));
    CHECK_FALSE(allowed("app/main.cpp", "#include <catch2/catch.hpp>"));
}

TEST_CASE("includes go one way: geometry <- bvh <- radiosity <- io <- app") {
    const fs::path root = fs::path(HEMILUX_SOURCE_DIR) / "src";
    int files = 0;
    std::vector<std::string> wrong;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root)) {
        const std::string extension = entry.path().extension().string();
        if (extension != ".h" && extension != ".cpp")
            continue;
        ++files;
        const std::string file = fs::relative(entry.path(), root).generic_string();
        REQUIRE(layer_of(file) >= 0);
        std::ifstream stream(entry.path());
        for (std::string line; std::getline(stream, line);)
            if (!allowed(file, line))
                wrong.push_back(file + ": " + line);
    }
    CHECK(files > 50);
    CAPTURE(wrong);
    CHECK(wrong.empty());
}
