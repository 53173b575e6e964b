// What the documents name exists: files, links between pages, numbers of decisions; and in the map
// of the paper, the reading guide and decisions also what the named files declare, and test cases.
#include "app/program.h"
#include "support/catch.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
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
    const std::vector<std::string> folders{"src/",      "tests/",  "bench/",
                                           "examples/", "docs/",   "scripts/",
                                           "cmake/",    "python/", "CMakeLists.txt"};
    const bool begins = std::ranges::any_of(
        folders, [&](const std::string& folder) { return span.rfind(folder, 0) == 0; });
    return begins && span.find_first_of(" <>*{}") == std::string::npos;
}

bool is_relative(const std::string& link) {
    return !link.empty() && link.find("://") == std::string::npos && link[0] != '#';
}

/// As web pages make it of a heading: "D7. Counts" is #d7-counts.
std::string anchor_of(const std::string& heading) {
    std::string anchor;
    for (const char c : heading.substr(std::min(heading.find_first_not_of("# "), heading.size())))
        if (std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '_')
            anchor += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
        else if (c == ' ')
            anchor += '-';
    return anchor;
}

/// Whether a link's file is there, and in a page the heading after #.
bool leads_somewhere(const fs::path& folder, const std::string& link) {
    const std::size_t mark = link.find('#');
    const fs::path file = folder / link.substr(0, mark);
    if (mark == std::string::npos || file.extension() != ".md" || !fs::exists(file))
        return fs::exists(file);
    return std::ranges::any_of(prose_of(text_of(file)), [&](const std::string& line) {
        return line.rfind('#', 0) == 0 && anchor_of(line) == link.substr(mark + 1);
    });
}

/// What a page names and is not there.
std::vector<std::string> missing_in(const std::string& markdown, const fs::path& folder) {
    std::vector<std::string> missing;
    for (const std::string& line : prose_of(markdown)) {
        for (const std::string& span : between(line, "`", "`"))
            if (is_source_path(span) && !fs::exists(root / span))
                missing.push_back(span);
        for (const std::string& link : between(line, "](", ")"))
            if (is_relative(link) && !leads_somewhere(folder, link))
                missing.push_back(link);
    }
    return missing;
}

bool is_word_character(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }

bool is_identifier(const std::string& name) {
    return !name.empty() && !std::isdigit(static_cast<unsigned char>(name[0])) &&
           std::ranges::all_of(name, is_word_character);
}

/// C++ without what compilers pass over: comments, and the text of strings on one line.
std::string code_of(const std::string& text) {
    std::string code;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text.compare(i, 2, "//") == 0)
            i = std::min(text.find('\n', i), text.size() - 1);
        else if (text.compare(i, 2, "/*") == 0)
            i = std::min(text.find("*/", i), text.size() - 2) + 1;
        else if (text[i] == '"' && (i == 0 || text[i - 1] != '\''))
            for (++i; i < text.size() && text[i] != '"' && text[i] != '\n'; ++i)
                i += text[i] == '\\';
        else {
            code += text[i];
            continue;
        }
        code += ' ';
    }
    return code;
}

/// The word, or the other character, that ends before `end`, spaces left out.
std::string before(const std::string& code, std::size_t end) {
    while (end > 0 && std::isspace(static_cast<unsigned char>(code[end - 1])))
        --end;
    std::size_t begin = end;
    while (begin > 0 && is_word_character(code[begin - 1]))
        --begin;
    return begin < end ? code.substr(begin, end - begin) : code.substr(end - (end > 0), end > 0);
}

/// What may stand before a name that is used, not declared.
bool leads_to_use(const std::string& word) {
    static const std::vector<std::string> words{"return", "else", "throw", "case", "goto", "new"};
    return std::ranges::find(words, word) != words.end();
}

/// Whether the code declares or defines the name: a whole word after a type, a keyword of types or
/// a class (`Class::`), or in a list of declarations, and not after an operator.
bool declares(const std::string& code, const std::string& name) {
    for (std::size_t at = code.find(name); at != std::string::npos; at = code.find(name, at + 1)) {
        const std::size_t end = at + name.size();
        if ((at > 0 && is_word_character(code[at - 1])) ||
            (end < code.size() && is_word_character(code[end])))
            continue;
        const std::size_t next = code.find_first_not_of(" \n", end);
        const char follows = next == std::string::npos ? ' ' : code[next];
        const std::string word = before(code, at);
        const bool after_type = !word.empty() && !leads_to_use(word) &&
                                (is_word_character(word[0]) || word == ">" || word == "&" ||
                                 word == "*" || word == "]");
        const bool of_class = code.compare(at < 2 ? 0 : at - 2, 2, "::") == 0 && follows == '(';
        const bool in_list =
            (word == "," || word == "{") && std::string(",=;{}").find(follows) != std::string::npos;
        if (after_type || of_class || in_list)
            return true;
    }
    return false;
}

/// Whether a file has what is named of it. Of Class::member it has both; a constructor is where its
/// class is. What is no C++ name (an option) and what is in no C++ file occurs as it is.
bool has_name(const fs::path& file, const std::string& name) {
    const std::string text = text_of(root / file);
    const std::size_t colons = name.find("::");
    if (colons != std::string::npos)
        return text.find(name.substr(0, colons)) != std::string::npos &&
               has_name(file, name.substr(name.rfind("::") + 2));
    const bool cpp = file.extension() == ".cpp" || file.extension() == ".h";
    return cpp && is_identifier(name) ? declares(code_of(text), name)
                                      : text.find(name) != std::string::npos;
}

/// The names of a text, each with its file: that in the brackets of which it stands, else the next
/// one, else the last.
std::vector<std::pair<std::string, std::string>> names_with_files(const std::string& text) {
    std::vector<std::pair<std::string, std::string>> found;
    std::vector<std::string> waiting;
    std::string file;
    std::size_t at = 0, bracket = std::string::npos; // bracket: where that of the file begins
    for (std::size_t open; (open = text.find('`', at)) != std::string::npos;) {
        const std::size_t close = text.find('`', open + 1);
        if (close == std::string::npos)
            break;
        const std::string span = text.substr(open + 1, close - open - 1);
        if (is_source_path(span)) {
            file = span;
            for (const std::string& name : waiting)
                found.emplace_back(name, file);
            waiting.clear();
            const std::size_t next = text.find_first_not_of(" \n", close + 1);
            bracket = next != std::string::npos && text[next] == '(' ? next : std::string::npos;
        } else if (bracket != std::string::npos && text.find(')', bracket) > open) {
            found.emplace_back(span, file);
        } else {
            waiting.push_back(span);
        }
        at = close + 1;
    }
    if (!file.empty())
        for (const std::string& name : waiting)
            found.emplace_back(name, file);
    return found;
}

/// In a text that gives files: names in `` that their file does not declare, and test cases in ""
/// that none of the files has.
std::vector<std::string> unknown_in(const std::string& reference) {
    std::vector<std::string> unknown;
    for (const auto& [name, file] : names_with_files(reference))
        if (!has_name(file, name))
            unknown.push_back(name);
    std::string tests;
    for (const std::string& span : between(reference, "`", "`"))
        if (is_source_path(span))
            tests += text_of(root / span);
    if (tests.empty())
        return unknown;
    for (const std::string& test : between(reference, "\"", "\""))
        if (tests.find("TEST_CASE(\"" + test + '"') == std::string::npos)
            unknown.push_back(test);
    return unknown;
}

/// All pages of a folder and of the folders in it.
std::vector<fs::path> pages_below(const fs::path& folder) {
    std::vector<fs::path> pages;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root / folder))
        if (entry.path().extension() == ".md")
            pages.push_back(entry.path());
    return pages;
}

bool has_test(const std::string& name) {
    const fs::recursive_directory_iterator tests(root / "tests");
    return std::any_of(begin(tests), end(tests), [&](const fs::directory_entry& entry) {
        return entry.path().extension() == ".cpp" &&
               text_of(entry.path()).find("TEST_CASE(\"" + name + '"') != std::string::npos;
    });
}

/// The pages whose sections are decisions.
constexpr std::array pages_of_decisions{"docs/paper/decisions.md", "docs/making/design.md",
                                        "docs/making/engineering.md"};

/// The sections "### D7. ..." of a page: their headings by their numbers, as they follow each
/// other.
std::vector<std::pair<int, std::string>> decisions_in(const fs::path& page) {
    std::vector<std::pair<int, std::string>> sections;
    for (const std::string& line : prose_of(text_of(root / page))) {
        constexpr std::string_view mark = "### D";
        if (line.starts_with(mark))
            sections.emplace_back(std::stoi(line.substr(mark.size())), line);
    }
    return sections;
}

/// The row of a decision in the index, which stands in docs/README.md.
std::string index_row(const fs::path& page, const std::string& heading) {
    const std::string file = page.lexically_relative("docs").generic_string();
    const std::size_t dot = heading.find(". ");
    return "| " + heading.substr(4, dot - 4) + " | [" + file + "](" + file + "#" +
           anchor_of(heading) + ") | " + heading.substr(dot + 2) + " |";
}

/// "design.md, D57" in a text: numbers that stand behind the name of a page without such a section.
std::vector<std::string> decisions_of_other_pages(const std::string& text) {
    std::vector<std::string> wrong;
    constexpr std::string_view mark = ".md, D";
    for (std::size_t at = text.find(mark); at != std::string::npos; at = text.find(mark, at + 1)) {
        std::size_t begin = at;
        while (begin > 0 && (is_word_character(text[begin - 1]) || text[begin - 1] == '-'))
            --begin;
        const std::string file = text.substr(begin, at + 3 - begin),
                          digits = text.substr(at + mark.size(), 2);
        const bool right = std::ranges::any_of(pages_of_decisions, [&](const fs::path& page) {
            return page.filename() == file &&
                   std::ranges::any_of(decisions_in(page), [&](const auto& section) {
                       return section.first == std::atoi(digits.c_str());
                   });
        });
        if (!right)
            wrong.push_back(file + ", D" + digits);
    }
    return wrong;
}

/// "D7" in a text: the numbers of decisions that it refers to.
std::set<int> decisions_named_in(const std::string& text) {
    std::set<int> numbers;
    for (std::size_t at = text.find('D'); at != std::string::npos; at = text.find('D', at + 1)) {
        const std::size_t end = std::min(text.find_first_not_of("0123456789", at + 1), text.size());
        const bool word = (at == 0 || !is_word_character(text[at - 1])) &&
                          (end == text.size() || !is_word_character(text[end]));
        if (word && end > at + 1 && end < at + 4)
            numbers.insert(std::stoi(text.substr(at + 1, end - at - 1)));
    }
    return numbers;
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
    CHECK(
        missing_in(
            "see `src/app/main.cpp`, [this](README.md#limits) and `hemilux solve`, `src/*.h`", root)
            .empty());
    CHECK(missing_in("[far](https://example.org/a), [near](#part)", root).empty());
    CHECK(missing_in("```\n`src/no.cpp`\n```", root).empty());
    CHECK(missing_in("`src/no.cpp` and [no](docs/no.md), [no](README.md#no)", root) ==
          std::vector<std::string>{"src/no.cpp", "docs/no.md", "README.md#no"});
    CHECK(anchor_of("### D7. The paper's own, and `x`") == "d7-the-papers-own-and-x");
    CHECK(unknown_in(
              "`is_source_path` in `tests/repository/test_docs.cpp` \"what a page names exists\"")
              .empty());
    const std::string absent = std::string("no_such_") + "name";
    CHECK(unknown_in("`" + absent + "` in `src/app/main.cpp` \"x\"") ==
          std::vector<std::string>{absent, "x"});
}

TEST_CASE("a name that is declared is told from one that is used") {
    const std::string code = code_of("// int a(); \nint b(int c) { return d(c) + e::f(1); }\n"
                                     "struct g; \"int h\"; g i = 0, j; void k::l() {} mn();");
    for (const char* declared : {"b", "c", "g", "i", "j", "l"})
        CHECK(declares(code, declared));
    for (const char* used : {"a", "d", "h", "m", "n"})
        CHECK_FALSE(declares(code, used));
    using Names = std::vector<std::pair<std::string, std::string>>;
    CHECK(names_with_files("`a`, `b` in `src/x.h`; `src/y.h` (`c`), `d` in `src/z.h`: `e`") ==
          Names{{"a", "src/x.h"},
                {"b", "src/x.h"},
                {"c", "src/y.h"},
                {"d", "src/z.h"},
                {"e", "src/z.h"}});
    CHECK(decisions_named_in("(D1, D2) D10; SD3 D4x 2D5 D678") == std::set<int>{1, 2, 10});
    CHECK(index_row("docs/a/b.md", "### D7. The paper's `x`") ==
          "| D7 | [a/b.md](a/b.md#d7-the-papers-x) | The paper's `x` |");
    CHECK(decisions_of_other_pages("(docs/paper/decisions.md, D1, D57), numerics.md, not D1")
              .empty());
    CHECK(decisions_of_other_pages(std::string("see decisions") + ".md, D57") ==
          std::vector<std::string>{"decisions.md, D57"});
}

TEST_CASE("what a page names exists") {
    std::vector<fs::path> pages{root / "README.md", root / "DEVELOPERS.md"};
    for (const fs::path& page : pages_below("docs"))
        pages.push_back(page);
    CHECK(pages.size() > 20);
    for (const fs::path& page : pages) {
        CAPTURE(page);
        REQUIRE(fs::exists(page));
        CHECK(missing_in(text_of(page), page.parent_path()) == std::vector<std::string>{});
    }
}

TEST_CASE("the code that decisions refer to exists") {
    for (const char* page : pages_of_decisions) {
        CAPTURE(page);
        const std::vector<std::string> references = between(text_of(root / page), "Code: ", ".\n");
        CHECK(references.size() == decisions_in(page).size());
        for (const std::string& reference : references)
            CHECK(unknown_in(reference) == std::vector<std::string>{});
    }
}

TEST_CASE("decisions stand in their order, each in one place, and all that are referred to exist") {
    std::set<int> all;
    std::size_t count = 0;
    for (const char* page : pages_of_decisions) {
        CAPTURE(page);
        const auto sections = decisions_in(page);
        CHECK_FALSE(sections.empty());
        CHECK(std::ranges::is_sorted(sections, {},
                                     [](const auto& section) { return section.first; }));
        count += sections.size();
        for (const auto& [number, heading] : sections)
            all.insert(number);
    }
    CHECK(all.size() == count);
    for (const char* folder : {"src", "tests", "bench", "examples", "docs"})
        for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root / folder)) {
            const fs::path& file = entry.path();
            if (file.filename() == fs::path(__FILE__).filename() ||
                (file.extension() != ".cpp" && file.extension() != ".h" &&
                 file.extension() != ".md"))
                continue;
            CAPTURE(file);
            CHECK(std::ranges::includes(all, decisions_named_in(text_of(file))));
            CHECK(decisions_of_other_pages(text_of(file)) == std::vector<std::string>{});
        }
}

TEST_CASE("the index of decisions has each one once, with its page and its title") {
    std::vector<std::string> rows, expected;
    for (const std::string& line : prose_of(text_of(root / "docs/README.md")))
        if (line.starts_with("| D") && std::isdigit(static_cast<unsigned char>(line[3])) != 0)
            rows.push_back(line);
    for (const char* page : pages_of_decisions)
        for (const auto& [number, heading] : decisions_in(page))
            expected.push_back(index_row(page, heading));
    std::ranges::sort(expected, {},
                      [](const std::string& row) { return std::stoi(row.substr(3)); });
    CHECK(rows == expected);
}

TEST_CASE("the map of the paper names code and tests that exist") {
    CHECK(checked_rows_of("docs/paper/paper_map.md") > 30);
}

TEST_CASE("the reading guide names code that exists") {
    CHECK(checked_rows_of("docs/paper/reading-guide.md") > 30);
}

TEST_CASE("programs and tests that pages of results run are there") {
    const std::string bench = text_of(root / "bench/CMakeLists.txt"),
                      tests = text_of(root / "tests/CMakeLists.txt");
    std::string pages;
    for (const fs::path& page : pages_below("docs/measured"))
        pages += text_of(page);
    int programs = 0;
    std::istringstream page(pages);
    for (std::string line; std::getline(page, line);) {
        if (line.rfind("    ", 0) != 0)
            continue;
        CAPTURE(line);
        std::istringstream words(line);
        for (std::string word; words >> word;) {
            if (word.rfind("build/", 0) != 0 || word.find('/', 6) == std::string::npos)
                continue;
            ++programs;
            const fs::path program = word;
            const std::string name = program.filename().string(),
                              folder = program.parent_path().filename().string();
            if (folder == "bench")
                CHECK(bench.find("add_executable(" + name + ' ') != std::string::npos);
            else if (folder == "tests")
                CHECK(tests.find("hemilux_test_program(" + name.substr(name.find('_') + 1) + ' ') !=
                      std::string::npos);
            else if (folder == "examples" || folder == "fuzz")
                CHECK(fs::exists(root / fs::path(folder == "fuzz" ? "tests/fuzz" : folder) /
                                 (name + ".cpp")));
            else
                CHECK(name == "hemilux");
            const std::vector<std::string> quoted = between(line, "\"", "\"");
            if (folder == "tests" && !quoted.empty() && std::isalpha(quoted[0][0]) != 0)
                CHECK(has_test(quoted[0]));
        }
    }
    CHECK(programs > 10);
}

TEST_CASE("README leads to the line that computes N_tr") {
    const std::string page = "src/radiosity/paper/pages/section_5_hemisphere.cpp",
                      line = "const Rays N_tr =";
    const std::string readme = text_of(root / "README.md");
    CHECK(readme.find("](" + page + ")") != std::string::npos);
    CHECK(readme.find("`" + line + "`") != std::string::npos);
    CHECK(text_of(root / page).find(line) != std::string::npos);
}

TEST_CASE("the page of options is what the program says") {
    const std::string script = (root / "scripts/options_page.sh").string();
    const test::Workplace place;
    const std::string page = place.path("options.md").string();
    REQUIRE(std::system(("'" + script + "' '" HEMILUX_PROGRAM "' >'" + page + "'").c_str()) == 0);
    INFO("scripts/options_page.sh build/release/hemilux >docs/use/options.md makes the page anew");
    CHECK((text_of(page) == text_of(root / "docs/use/options.md")));
}
