// The script that compares two builds finds no difference between instruction sets, and any other.

#include "app/program.h"
#include "radiosity/engine/solving/method.h"
#include "support/catch.h"

#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

using Catch::Contains;
using test::Workplace;

namespace {

const std::string root = HEMILUX_SOURCE_DIR;

/// A program that runs hemilux after lines of shell, which may change its arguments.
std::string other_program(const Workplace& place, const std::string& prepare) {
    place.write("other", "#!/bin/sh\n" + prepare + "\nexec '" HEMILUX_PROGRAM "' \"$@\"\n");
    const std::filesystem::path path = place.path("other");
    std::filesystem::permissions(path, std::filesystem::perms::owner_all);
    return path.string();
}

/// What scripts/same_bytes.sh says of hemilux and the other program in some example scenes.
std::string compared(const Workplace& place, const std::string& other,
                     const std::vector<std::string>& scenes, bool same) {
    std::string command =
        "'" + root + "/scripts/same_bytes.sh' '" HEMILUX_PROGRAM "' '" + other + "'";
    for (const std::string& scene : scenes)
        command += " '" + root + "/examples/scenes/" + scene + ".obj'";
    command += " >'" + place.path("said").string() + "'";
    CHECK((std::system(command.c_str()) == 0) == same);
    return place.read("said");
}

} // namespace

TEST_CASE("all methods write the same bytes by the kernels of any instruction set", "[slow]") {
    const Workplace place;
    const std::string baseline = other_program(place, "export HEMILUX_KERNELS=baseline");
    CHECK_THAT(compared(place, baseline, {"room_1002", "open_scene"}, true),
               Contains("the same bytes for ") && Contains("in 2 scenes"));
}

TEST_CASE("another seed is found by scripts/same_bytes.sh in each method", "[slow]") {
    const Workplace place;
    const std::string other = other_program(place, "last= rest=$#\n"
                                                   "while [ $rest -gt 0 ]; do\n"
                                                   "  word=$1; shift; rest=$((rest - 1))\n"
                                                   "  [ \"$last\" = --seed ] && word=2\n"
                                                   "  last=$word; set -- \"$@\" \"$word\"\n"
                                                   "done");
    const std::string said = compared(place, other, {"cube_6"}, false);
    for (const hemilux::Method* method : hemilux::methods())
        CHECK_THAT(said, Contains(std::string(method->name) + " differs in cube_6.obj\n"));
}
