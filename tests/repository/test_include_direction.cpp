// Includes go one way: down the storeys, within a storey from later rooms of this list to earlier
// ones, and each dependency has one place.
#include "support/catch.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

/// Folders of src/; those of radiosity, io and app have no files of their own but main.cpp.
const std::vector<std::string> rooms{
    "geometry",
    "bvh",
    "radiosity/paper/sampling",
    "radiosity/paper/scene",
    "radiosity/paper/rays",
    "radiosity/paper/hemisphere",
    "radiosity/paper/solution",
    "radiosity/paper/solving",
    "radiosity/paper/pages",
    "parallel",
    "bvh/wide",
    "radiosity/engine/cells",
    "radiosity/engine/sampling",
    "radiosity/engine/rays",
    "radiosity/engine/target",
    "radiosity/engine/sparse",
    "radiosity/engine/needs",
    "radiosity/engine/solving",
    "radiosity/engine/saving",
    "radiosity/engine/factors/pairs",
    "radiosity/engine/factors/rows",
    "radiosity/engine/factors/points",
    "radiosity/engine/form_factors",
    "radiosity/engine/heat",
    "radiosity/engine/linear",
    "radiosity/engine/densities",
    "radiosity/engine/shooting",
    "radiosity/engine/progressive",
    "radiosity/engine/emitters",
    "radiosity/engine/stored_transport",
    "radiosity/engine/methods",
    "radiosity/engine/checks",
    "radiosity/research/hierarchy",
    "radiosity/research/guiding",
    "radiosity/research/targets",
    "radiosity/research/guides",
    "radiosity/research/aimers",
    "radiosity/research/methods",
    "radiosity/light/polygons",
    "radiosity/light/textures",
    "radiosity/light/lamps",
    "radiosity/light/layers",
    "radiosity/light/sides",
    "radiosity/light/rooms",
    "radiosity/light/cached_light",
    "radiosity/light/final_gather",
    "radiosity/light/light_error",
    "radiosity/light/division",
    "radiosity/answers/asked",
    "radiosity/answers/images",
    "radiosity/answers/views",
    "radiosity/answers/run",
    "radiosity/answers/division",
    "radiosity/answers/vertices",
    "radiosity/answers/pictures",
    "radiosity/answers/picture_check",
    "radiosity/answers/charts",
    "radiosity/answers/lightmaps",
    "radiosity/answers/gathering",
    "radiosity/answers/lamps",
    "radiosity/answers/surfaces",
    "mpi",
    "io/files",
    "io/textures",
    "io/scene_files",
    "io/results",
    "io/pictures",
    "io/meshes",
    "io/gltf/document",
    "io/gltf",
    "io/drawings",
    "app/settings",
    "app/memory",
    "app/rendering",
    "app/ranks",
    "app/terminal",
    "app/loading",
    "app/report",
    "app/division",
    "app/gathering",
    "app/lamps",
    "app/running",
    "app/outputs",
    "app/factors",
    "app/commands",
    "app/command_line",
    "app/subcommands",
    "app",
};

/// The storeys with the folders that they are made of; the longest folder around a file decides.
const std::map<std::string, std::string> storey_of_folder{
    {"geometry", "paper"},
    {"bvh", "paper"},
    {"radiosity/paper", "paper"},
    {"bvh/wide", "engine"},
    {"parallel", "engine"},
    {"radiosity/engine", "engine"},
    {"radiosity/light", "light"},
    {"radiosity/answers", "answers"},
    {"radiosity/research", "research"},
    {"mpi", "shell"},
    {"io", "shell"},
    {"app", "shell"},
};
/// The storeys on which each stands. Nothing stands on the shelf of research.
const std::map<std::string, std::set<std::string>> stands_on{
    {"paper", {"paper"}},
    {"engine", {"paper", "engine"}},
    {"light", {"paper", "engine", "light"}},
    {"research", {"paper", "engine", "research"}},
    {"answers", {"paper", "engine", "light", "answers"}},
    {"shell", {"paper", "engine", "light", "answers", "shell"}},
};

std::string storey_of(const std::string& path) {
    for (fs::path folder = fs::path(path).parent_path(); !folder.empty();
         folder = folder.parent_path()) {
        const auto found = storey_of_folder.find(folder.generic_string());
        if (found != storey_of_folder.end())
            return found->second;
    }
    return {};
}

std::string layer_of(const std::string& path) { return path.substr(0, path.find('/')); }

/// The place in the list of the folder that holds `path`, or of the nearest folder around it; -1:
/// none.
std::ptrdiff_t room_of(const std::string& path) {
    for (fs::path folder = fs::path(path).parent_path(); !folder.empty();
         folder = folder.parent_path()) {
        const auto found = std::find(rooms.begin(), rooms.end(), folder.generic_string());
        if (found != rooms.end())
            return found - rooms.begin();
    }
    return -1;
}

/// Whether `file` (relative to src/) may say #include <header>.
bool may_include_system(const std::string& file, const std::string& header) {
    const auto begins = [&](const char* text) { return header.rfind(text, 0) == 0; };
    const bool source = fs::path(file).extension() == ".cpp";
    const std::string layer = layer_of(file);
    if (begins("glm/"))
        return true;
    if (begins("webp/"))
        return file == "io/textures/webp.cpp";
    if (begins("stb"))
        return layer == "io" && source;
    if (header == "nlohmann/json_fwd.hpp")
        return layer == "io";
    if (begins("nlohmann/")) // these take long to compile: few files include them
        return file == "io/results/statistics.cpp" || file == "io/results/scene_info_json.cpp" ||
               file == "io/meshes/glb.cpp" || file == "io/gltf/document/json_value.cpp" ||
               file == "io/gltf/open_document.h" || file == "app/report/run_data.cpp";
    if (begins("CLI/"))
        return file == "app/command_line/arguments.cpp";
    if (header == "mpi.h")
        return layer == "mpi" && source;
    if (header == "immintrin.h")
        return file.starts_with("bvh/wide/");
    for (const char* of_threads : {"thread", "mutex", "condition_variable", "stop_token"})
        if (header == of_threads) // the paper is read line after line, and needs none
            return storey_of(file) != "paper";
    if (header == "sys/mman.h") // huge pages, memory of several ranks
        return file.starts_with("bvh/wide/") || file == "mpi/memory_of_ranks.cpp";
    const bool standard = header.find_first_of("./") == std::string::npos;
    const bool posix =
        header.ends_with(".h") && (header.find('/') == std::string::npos || begins("sys/"));
    return standard || (posix && source && (layer == "io" || layer == "app" || layer == "mpi"));
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
    const std::string from = storey_of(file), to = storey_of(header);
    return room_of(header) >= 0 && stands_on.at(from).contains(to) &&
           (from != to || room_of(header) <= room_of(file));
}

} // namespace

TEST_CASE("the rule about includes tells right from wrong") {
    CHECK(allowed("bvh/build.cpp", "#include \"geometry/box.h\""));
    CHECK(allowed("bvh/build.cpp", "#include <vector>"));
    CHECK(allowed("geometry/vector.h", "#include <glm/glm.hpp>"));
    CHECK(allowed("io/pictures/image.cpp", "#include <stb_image_write.h>"));
    CHECK(allowed("app/command_line/arguments.cpp", "#include <CLI/CLI.hpp>"));
    CHECK(allowed("app/main.cpp", "int include = 3; // \"io/scene_files/obj.h\""));
    CHECK_FALSE(allowed("geometry/box.h", "#include \"bvh/tracer.h\""));
    CHECK_FALSE(allowed("radiosity/paper/scene/mesh.cpp", "  #  include \"io/files/error.h\""));
    CHECK_FALSE(allowed("bvh/build.cpp", "#include \"build.h\""));
    CHECK_FALSE(
        allowed("radiosity/paper/scene/mesh.h", "#include \"radiosity/paper/solving/solver.h\""));
    CHECK_FALSE(allowed("bvh/tracer.h", "#include \"bvh/wide/wide_bvh.h\""));
    CHECK_FALSE(
        allowed("radiosity/paper/rays/shot.h", "#include \"radiosity/engine/sampling/sobol.h\""));
    CHECK_FALSE(allowed("radiosity/light/sides/shells.h",
                        "#include \"radiosity/research/hierarchy/links.h\""));
    CHECK_FALSE(
        allowed("app/commands/solve.cpp", "#include \"radiosity/research/guiding/guide.h\""));
    CHECK_FALSE(allowed("radiosity/paper/solving/solver.h", "#include <thread>"));
    CHECK_FALSE(allowed("io/pictures/image.h", "#include <stb_image_write.h>"));
    CHECK_FALSE(allowed("radiosity/paper/solving/solver.h", "#include <nlohmann/json.hpp>"));
    CHECK_FALSE(allowed("app/main.cpp", "#include <CLI/CLI.hpp>"));
    CHECK_FALSE(allowed("io/scene_files/obj.cpp", "#include <CLI/CLI.hpp>"));
    CHECK_FALSE(allowed("geometry/box.h", "#include <unistd.h>"));
    CHECK_FALSE(allowed("app/main.cpp", "#include <catch2/catch.hpp>"));
}

TEST_CASE("includes go one way, from room to room") {
    const fs::path root = fs::path(HEMILUX_SOURCE_DIR) / "src";
    std::map<std::string, int> files_in;
    std::vector<std::string> wrong;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root)) {
        const std::string extension = entry.path().extension().string();
        if (extension != ".h" && extension != ".cpp")
            continue;
        const std::string file = fs::relative(entry.path(), root).generic_string();
        REQUIRE(room_of(file) >= 0);
        ++files_in[fs::path(file).parent_path().generic_string()];
        std::ifstream stream(entry.path());
        for (std::string line; std::getline(stream, line);)
            if (!allowed(file, line))
                wrong.push_back(file + ": " + line);
    }
    CHECK(files_in.size() > 20);
    CAPTURE(wrong);
    CHECK(wrong.empty());
    for (const auto& [folder, files] : files_in) {
        CAPTURE(folder);
        CHECK(files <= 24); // a reader can take in so many
    }
}

TEST_CASE("the paper does without the algorithms of ranges, which libc++ 14 lacks") {
    const fs::path root = fs::path(HEMILUX_SOURCE_DIR) / "src";
    std::size_t files = 0;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root)) {
        const std::string extension = entry.path().extension().string();
        const std::string file = fs::relative(entry.path(), root).generic_string();
        if ((extension != ".h" && extension != ".cpp") || storey_of(file) != "paper")
            continue;
        ++files;
        std::ifstream stream(entry.path());
        for (std::string line; std::getline(stream, line);) {
            CAPTURE(file, line);
            REQUIRE(line.find("ranges::") == std::string::npos);
            REQUIRE(line.find("views::") == std::string::npos);
        }
    }
    CHECK(files > 50);
}

TEST_CASE("no two headers define types of one name: the linker would take one for the other") {
    const std::regex definition(
        "(?:struct|class) (?:alignas\\(\\w+\\) )?(\\w+)(?: final)?(?: : .*)? \\{.*");
    std::map<std::string, std::set<std::string>> headers_of;
    for (const fs::directory_entry& entry :
         fs::recursive_directory_iterator(fs::path(HEMILUX_SOURCE_DIR) / "src")) {
        if (entry.path().extension() != ".h")
            continue;
        std::ifstream stream(entry.path());
        std::smatch match;
        std::string inside;
        for (std::string line; std::getline(stream, line);)
            if (line.starts_with("namespace "))
                inside = line;
            else if (std::regex_match(line, match, definition)) // others are indented
                headers_of[inside + match[1].str()].insert(entry.path().string());
    }
    CHECK(headers_of.size() > 100);
    for (const auto& [type, headers] : headers_of) {
        CAPTURE(type, headers);
        CHECK(headers.size() == 1);
    }
}
