// `hemilux help --print`: the manual page and the completions hold what --help does.
#include "app/check_fails.h"
#include "support/catch.h"

#include <cstdlib>
#include <regex>
#include <set>
#include <sstream>
#include <string>

using Catch::Contains;
using test::Workplace;

namespace {

bool has(const std::string& program) {
    return std::system(("command -v " + program + " >/dev/null 2>&1").c_str()) == 0;
}

/// What bash offers after these words, the last of which is being typed; a blank between each two.
std::string offered(const Workplace& place, const std::string& words) {
    return place
        .hemilux("--print bash >c.bash; bash -c '. ./c.bash; COMP_WORDS=(hemilux " + words +
                 "); COMP_CWORD=$((${#COMP_WORDS[@]}-1)); _hemilux; echo \"${COMPREPLY[@]}\"'")
        .out;
}

} // namespace

TEST_CASE("the manual and all completions know each option of --help") {
    const Workplace place;
    const std::string manual = place.hemilux("help --print man").out;
    const std::string bash = place.hemilux("help --print bash").out;
    const std::string zsh = place.hemilux("help --print zsh").out;
    const std::string fish = place.hemilux("help --print fish").out;
    std::set<std::string> names;
    for (const char* const command : {"solve", "bake", "compare", "density", "formfactors",
                                      "viewfactors", "exchange", "info"}) {
        const std::string help = place.hemilux(std::string(command) + " --help").out;
        const std::regex declared("\n  (?:-[a-zA-Z],)?--([a-z0-9-]+)");
        for (std::sregex_iterator match(help.begin(), help.end(), declared), end; match != end;
             ++match)
            names.insert((*match)[1]);
        CHECK_THAT(manual, Contains(".SH \"hemilux " + std::string(command) + "\""));
    }
    CHECK(names.size() > 50);
    for (const std::string& name : names) {
        CAPTURE(name);
        std::string escaped;
        for (const char c : "--" + name)
            escaped += c == '-' ? "\\-" : std::string(1, c);
        CHECK_THAT(manual, Contains("\\fB" + escaped + "\\fR"));
        CHECK_THAT(bash, Contains("--" + name + " ") || Contains("--" + name + "'"));
        CHECK_THAT(zsh, Contains("--" + name + "["));
        CHECK_THAT(fish, Contains(" -l " + name + " "));
    }
    test::check_fails(place, 1, "help --print powershell", "--print: unknown choice 'powershell'");
}

TEST_CASE("bash offers subcommands, options and choices") {
    if (!has("bash"))
        return;
    const Workplace place;
    CHECK(offered(place, "sol") == "solve\n");
    CHECK(offered(place, "info --js") == "--json\n");
    CHECK(offered(place, "solve room.obj --sides \"\"") == "auto front both\n");
    CHECK(offered(place, "compare room.obj --methods hemisphere-") == "hemisphere-1997\n");
    CHECK(offered(place, "solve \"\"") == "\n"); // files, then
}

TEST_CASE("other programs take the printed texts without a complaint") {
    const Workplace place;
    const auto silent = [&place](const std::string& text, const std::string& by) {
        if (!has(by.substr(0, by.find(' '))))
            return;
        const Workplace::Outcome outcome =
            place.hemilux("--print " + text + " >text; " + by + " text 2>&1");
        CHECK(outcome.code == 0);
        CHECK(outcome.out.empty());
    };
    silent("man", "groff -man -Tutf8 -ww -z");
    silent("bash", "bash -n");
    silent("zsh", "zsh -n");
    silent("fish", "fish -n");
}

TEST_CASE("help is 80 columns wide but for commands to copy") {
    const Workplace place;
    for (const char* const command : {"", "solve", "bake", "compare", "density", "formfactors",
                                      "viewfactors", "exchange", "info"}) {
        std::istringstream lines(place.hemilux(std::string(command) + " --help").out);
        for (std::string line; std::getline(lines, line);)
            if (!line.starts_with("  hemilux ")) {
                INFO(line);
                CHECK(line.size() <= 80);
            }
    }
}
