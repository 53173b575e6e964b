// The commands that README.md, the reading guide and pages for users print work: every line of a
// block that is fenced as ```sh run is executed in the repository's folder, with hemilux in the
// PATH.
#include "support/catch.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <istream>
#include <sstream>
#include <string>
#include <vector>

namespace {

/// The commands of all blocks, lines that end with a backslash joined to the next.
std::vector<std::string> runnable_commands(std::istream& markdown) {
    std::vector<std::string> commands;
    bool inside = false, continued = false;
    for (std::string line; std::getline(markdown, line);) {
        if (line.rfind("```", 0) == 0) {
            inside = line == "```sh run";
            continued = false;
        } else if (inside && !line.empty()) {
            if (continued)
                commands.back() += "\n" + line;
            else
                commands.push_back(line);
            continued = line.back() == '\\';
        }
    }
    return commands;
}

} // namespace

TEST_CASE("runnable commands are told from other blocks") {
    std::istringstream text("text\n```sh\nnot this\n```\n```sh run\none\n\ntwo \\\n  more\n```\n"
                            "```\nnor this\n```\n```sh run\nthree\n```\n");
    CHECK(runnable_commands(text) == std::vector<std::string>{"one", "two \\\n  more", "three"});
}

TEST_CASE("the commands of README.md, the reading guide and the pages for users work", "[slow]") {
    const std::string root = HEMILUX_SOURCE_DIR;
    const std::string programs = std::filesystem::path(HEMILUX_PROGRAM).parent_path().string();
    for (const char* name :
         {"/README.md", "/docs/paper/reading-guide.md", "/docs/paper/core.md",
          "/docs/use/tutorial.md", "/docs/use/how-to.md", "/docs/use/exchange.md"}) {
        std::ifstream page(root + name);
        const std::vector<std::string> commands = runnable_commands(page);
        CAPTURE(name);
        CHECK_FALSE(commands.empty());
        for (const std::string& command : commands) {
            CAPTURE(command);
            const std::string line =
                "cd '" + root + "' && PATH='" + programs + "':$PATH && { " + command + "; }";
            CHECK(std::system((line + " </dev/null >/dev/null").c_str()) == 0);
        }
    }
}

TEST_CASE("README names both commands within its first 30 lines") {
    std::ifstream page(std::string(HEMILUX_SOURCE_DIR) + "/README.md");
    std::string head;
    int lines = 0;
    for (std::string line; lines < 30 && std::getline(page, line); ++lines)
        head += line + "\n";
    for (const char* command : {"./demo.sh", "./test.sh"}) {
        CAPTURE(command);
        CHECK(head.find(command) != std::string::npos);
    }
}
