// The limits that a shell sets (ulimit): the program works, or ends with one message.
#include "app/program.h"
#include "support/catch.h"

#include <filesystem>

using test::Workplace;

namespace {

const std::vector<std::string>& commands() {
    static const std::vector<std::string> all{
        "info room.obj",
        "solve room.obj --steps 2 -q -o a.csv --stats a.json",
        "solve room.obj --error 30% -q -o a.png --size 32x24 " + test::camera_in_room,
        "solve room.obj --steps 1 -q -o a.glb --lightmap 256",
        "compare room.obj --methods stratified --runs 1 --budget-rays 1e4 --reference-error 0.2 -q "
        "-o c --size 16x12",
        "density room.obj -q -o d.svg",
        "formfactors room.obj --rays 64 -q -o f.csv",
        "viewfactors room.obj --error 10% -q -o f.npz",
        "solve room.obj --error 30% -q --points points --points-output p.csv"};
    return all;
}

void write_inputs(const Workplace& place) {
    place.write_room();
    place.write("points", ".5 .5 .5 0 0 1\n");
}

/// The program ends by itself: with success, or with one message and exit code 3.
void check(const Workplace& place, const std::string& limit, const std::string& command) {
    CAPTURE(limit, command);
    const Workplace::Outcome outcome =
        place.hemilux("--version && ulimit " + limit + " && '" HEMILUX_PROGRAM "' " + command);
    CHECK((outcome.code == 0 || outcome.code == 3));
    CHECK(outcome.err.empty() == (outcome.code == 0));
}

} // namespace

TEST_CASE("on a small stack every command works", "[slow]") {
    const Workplace place;
    write_inputs(place);
    for (const std::string& command : commands())
        for (const char* const limit : {"-s 64", "-s 256"}) {
            CAPTURE(limit, command);
            const Workplace::Outcome outcome =
                place.hemilux(std::string("--version && ulimit ") + limit +
                              " && '" HEMILUX_PROGRAM "' " + command);
            CHECK(outcome.code == 0);
            CHECK(outcome.err.empty());
        }
}

TEST_CASE("few files, short files and little memory end with a message or not at all", "[slow]") {
    const Workplace place;
    write_inputs(place);
    for (const std::string& command : commands()) {
        check(place, "-n 16", command);
        check(place, "-n 5", command);
        check(place, "-f 1", command);
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
        check(place, "-v 60000", command);
#endif
    }
    for (const auto& entry : std::filesystem::directory_iterator(place.path("")))
        CHECK_FALSE(entry.path().filename().string().starts_with(".hemilux-"));
}
