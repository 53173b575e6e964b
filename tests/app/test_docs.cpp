// What the documents name exists: files, links between pages, and in docs/paper_map.md also names
// of the code and test cases.
#include "app/program.h"
#include "support/catch.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

const fs::path root = HEMILUX_SOURCE_DIR;

std::string text_of(const fs::path& path) {
    std::ostringstream text;
    text << std::ifstream(path, std::ios::binary).rdbuf();
    return text.str();
}

/// The lines outside of fenced blocks.
std::vector<std::string> prose_of(const std::string& markdown) {
    std::vector<std::string> lines;
    std::istringstream stream(markdown);
    bool fenced = false;
    for (std::string line; std::getline(stream, line);) {
        if (line.rfind("```", 0) == 0)
            fenced = !fenced;
        else if (!fenced)
            lines.push_back(line);
    }
    return lines;
}

/// What stands between `open` and the next `close`, again and again.
std::vector<std::string> between(const std::string& text, const std::string& open,
                                 const std::string& close) {
    std::vector<std::string> found;
    for (std::size_t at = text.find(open); at != std::string::npos;) {
        const std::size_t begin = at + open.size(), end = text.find(close, begin);
        if (end == std::string::npos)
            break;
        found.push_back(text.substr(begin, end - begin));
        at = text.find(open, end + close.size());
    }
    return found;
}

/// A path of this repository, as opposed to a name, a command, a pattern or a file that is made.
bool is_source_path(const std::string& span) {
    const std::vector<std::string> folders{"src/",     "tests/", "examples/",     "docs/",
                                           "scripts/", "cmake/", "CMakeLists.txt"};
    const bool begins = std::ranges::any_of(
        folders, [&](const std::string& folder) { return span.rfind(folder, 0) == 0; });
    return begins && span.find_first_of(" <>*{}") == std::string::npos;
}

bool is_relative(const std::string& link) {
    return !link.empty() && link.find("://") == std::string::npos && link[0] != '#';
}

/// What a page names and is not there.
std::vector<std::string> missing_in(const std::string& markdown, const fs::path& folder) {
    std::vector<std::string> missing;
    for (const std::string& line : prose_of(markdown)) {
        for (const std::string& span : between(line, "`", "`"))
            if (is_source_path(span) && !fs::exists(root / span))
                missing.push_back(span);
        for (const std::string& link : between(line, "](", ")"))
            if (is_relative(link) && !fs::exists(folder / link.substr(0, link.find('#'))))
                missing.push_back(link);
    }
    return missing;
}

/// Whether all parts of a name such as Mesh::patch_at occur.
bool names_something_in(const std::string& code, const std::string& name) {
    const std::size_t colons = name.find("::");
    if (colons != std::string::npos)
        return names_something_in(code, name.substr(0, colons)) &&
               names_something_in(code, name.substr(colons + 2));
    return code.find(name) != std::string::npos;
}

/// In a text that gives files: names in `` and test cases in "" that none of them has.
std::vector<std::string> unknown_in(const std::string& reference) {
    std::string code;
    std::vector<std::string> names, unknown;
    for (const std::string& span : between(reference, "`", "`")) {
        if (is_source_path(span))
            code += text_of(root / span);
        else
            names.push_back(span);
    }
    if (code.empty())
        return {};
    for (const std::string& name : names)
        if (!names_something_in(code, name))
            unknown.push_back(name);
    for (const std::string& test : between(reference, "\"", "\""))
        if (code.find("TEST_CASE(\"" + test + '"') == std::string::npos)
            unknown.push_back(test);
    return unknown;
}

std::vector<std::string> cells_of(const std::string& row) {
    std::vector<std::string> cells;
    std::istringstream stream(row);
    for (std::string cell; std::getline(stream, cell, '|');)
        cells.push_back(cell);
    return cells;
}

/// The rows of the page's tables, each cell of which names only what is there.
int checked_rows_of(const char* page) {
    int rows = 0;
    for (const std::string& line : prose_of(text_of(root / page))) {
        if (line.rfind("| ", 0) != 0)
            continue;
        ++rows;
        for (const std::string& cell : cells_of(line))
            CHECK(unknown_in(cell) == std::vector<std::string>{});
    }
    return rows;
}

} // namespace

TEST_CASE("what documents name is told from what is not there") {
    CHECK(missing_in("see `src/app/main.cpp`, [this](README.md#a) and `hemilux solve`, `src/*.h`",
                     root)
              .empty());
    CHECK(missing_in("[far](https://example.org/a), [near](#part)", root).empty());
    CHECK(missing_in("```\n`src/no.cpp`\n```", root).empty());
    CHECK(missing_in("`src/no.cpp` and [no](docs/no.md)", root) ==
          std::vector<std::string>{"src/no.cpp", "docs/no.md"});
    CHECK(unknown_in("`is_source_path` in `tests/app/test_docs.cpp` \"what a page names exists\"")
              .empty());
    const std::string absent = std::string("no_such_") + "name";
    CHECK(unknown_in("`" + absent + "` in `src/app/main.cpp` \"x\"") ==
          std::vector<std::string>{absent, "x"});
}

TEST_CASE("what a page names exists") {
    std::vector<fs::path> pages{root / "README.md", root / "DEVELOPERS.md"};
    for (const fs::directory_entry& entry : fs::directory_iterator(root / "docs"))
        if (entry.path().extension() == ".md")
            pages.push_back(entry.path());
    CHECK(pages.size() > 3);
    for (const fs::path& page : pages) {
        CAPTURE(page);
        REQUIRE(fs::exists(page));
        CHECK(missing_in(text_of(page), page.parent_path()) == std::vector<std::string>{});
    }
}

TEST_CASE("the code that decisions refer to exists") {
    const std::vector<std::string> references =
        between(text_of(root / "docs/decisions.md"), "Code: ", ".\n");
    CHECK(references.size() >= 29);
    for (const std::string& reference : references)
        CHECK(unknown_in(reference) == std::vector<std::string>{});
}

TEST_CASE("the map of the paper names code and tests that exist") {
    CHECK(checked_rows_of("docs/paper_map.md") > 30);
}

TEST_CASE("the reading guide names code that exists") {
    CHECK(checked_rows_of("docs/reading-guide.md") > 30);
}

TEST_CASE("the page of options is what the program says") {
    const std::string script = (root / "scripts/options_page.sh").string();
    const test::Workplace place;
    const std::string page = place.path("options.md").string();
    REQUIRE(std::system(("'" + script + "' '" HEMILUX_PROGRAM "' >'" + page + "'").c_str()) == 0);
    INFO("scripts/options_page.sh build/release/hemilux >docs/options.md makes the page anew");
    CHECK((text_of(page) == text_of(root / "docs/options.md")));
}
