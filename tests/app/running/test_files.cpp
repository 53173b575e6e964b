// The files of a run: none is lost, none is read without end, and no wait outlasts a signal.
#include "app/program.h"
#include "app/running.h"
#include "support/catch.h"

#include <cstdlib>
#include <filesystem>
#include <poll.h>
#include <tuple>

using Catch::Contains;
using test::Running;
using test::wait_for;
using test::Workplace;

namespace {

namespace fs = std::filesystem;

void link(const Workplace& place, const std::string& target, const std::string& name) {
    fs::create_symlink(target, place.path(name));
}

/// One message that names both files, and nothing is changed.
void check_refused(const Workplace& place, const std::string& arguments, const std::string& a,
                   const std::string& b) {
    CAPTURE(arguments);
    const std::string scene = place.read("room.obj"), library = place.read("room.mtl");
    const Workplace::Outcome outcome = place.hemilux(arguments);
    CHECK(outcome.code == 1);
    CHECK_THAT(outcome.err,
               Contains("'" + a + "'") && Contains("'" + b + "'") && Contains("are one file"));
    CHECK(place.read("room.obj") == scene);
    CHECK(place.read("room.mtl") == library);
}

constexpr const char* solve = "solve room.obj --method stratified --steps 1 --size 16x12 ";

/// A room whose library names a texture.
void write_textured_room(const Workplace& place) {
    place.write_room();
    place.write("room.mtl", place.read("room.mtl") + "map_Ke -s 2 2 wood.png\nbump dents.hdr\n");
    place.write("wood.png", "a texture");
    place.write("dents.hdr", "another");
}

} // namespace

TEST_CASE("an output that is the scene, a library or a texture by another name is refused") {
    const Workplace place;
    write_textured_room(place);
    link(place, "room.obj", "x.csv");
    check_refused(place, solve + std::string("-o x.csv"), "x.csv", "room.obj");
    check_refused(place, solve + std::string("-o a.csv --stats x.csv"), "x.csv", "room.obj");
    check_refused(place, solve + std::string("-o a.csv --steps-log x.csv"), "x.csv", "room.obj");
    check_refused(place, solve + std::string("-o a.csv --checkpoint x.csv"), "x.csv", "room.obj");
    check_refused(place, solve + std::string("-o a.csv --stats room.mtl"), "room.mtl", "room.mtl");
    check_refused(place, solve + std::string("-o a.csv --steps-log ././room.mtl"), "././room.mtl",
                  "room.mtl");
    check_refused(place, solve + std::string("-o a.csv --checkpoint room.mtl"), "room.mtl",
                  "room.mtl");
    check_refused(place, solve + std::string("-o wood.png"), "wood.png", "wood.png");
    check_refused(place, solve + std::string("-o dents.hdr"), "dents.hdr", "dents.hdr");
    fs::create_hard_link(place.path("room.mtl"), place.path("hard.json"));
    check_refused(place, solve + std::string("-o hard.json"), "hard.json", "room.mtl");
    link(place, "room.obj", "x.svg");
    check_refused(place, "density room.obj -o x.svg", "x.svg", "room.obj");
    check_refused(place, "formfactors room.obj -o x.csv", "x.csv", "room.obj");
    fs::create_directory(place.path("compared"));
    link(place, "../room.mtl", "compared/error.svg");
    check_refused(place, "compare room.obj -o compared", "compared/error.svg", "room.mtl");
    fs::create_directories(place.path("full/reference.png"));
    CHECK(place.hemilux("compare none.obj -o full").code == 3); // before the scene is read
    CHECK(place.read("wood.png") == "a texture");
    CHECK_FALSE(place.has("a.csv"));
}

TEST_CASE("outputs that are one another or another file of the run are refused") {
    const Workplace place;
    place.write_room();
    REQUIRE(place.hemilux(solve + std::string("-o reference.csv --checkpoint saved")).code == 0);
    link(place, "reference.csv", "x.csv");
    link(place, "saved", "x.json");
    fs::create_directory(place.path("a"));
    link(place, "a", "b");
    const std::string reference = place.read("reference.csv"), saved = place.read("saved");
    for (const auto& [arguments, one, other] :
         {std::array{"-o x.csv --reference reference.csv", "x.csv", "reference.csv"},
          {"-o x.json --resume saved", "x.json", "saved"},
          {"-o x.json --checkpoint saved", "x.json", "saved"},
          {"-o a/n.csv -o b/n.csv", "a/n.csv", "b/n.csv"}, // none of them exists
          {"-o a.png -o a-0001.png --every-step", "a-0001.png", "a-0001.png"}})
        check_refused(place, solve + std::string(arguments), one, other);
    link(place, "room.obj", "p-0001.png");
    check_refused(place, solve + std::string("-o p.png --every-step"), "p-0001.png", "room.obj");
    fs::create_directory(place.path("compared"));
    fs::create_hard_link(place.path("reference.csv"), place.path("compared/error.csv"));
    check_refused(place, "compare room.obj -o compared --reference reference.csv",
                  "compared/error.csv", "reference.csv");
    CHECK(place.read("reference.csv") == reference);
    CHECK(place.read("saved") == saved);
    // The checkpoint that a run goes on from may be renewed, under any name, and terminals and
    // pipes may be named twice.
    CHECK(place
              .hemilux("solve room.obj --method stratified --steps 2 -o a.csv --resume saved "
                       "--checkpoint x.json")
              .code == 0);
    CHECK(place.read("saved") != saved);
    link(place, "/dev/null", "null.csv");
    CHECK(place.hemilux(solve + std::string("-o null.csv --stats /dev/null")).code == 0);
}

TEST_CASE("a replaced file keeps its mode, and a link as an output is followed") {
    const Workplace place;
    place.write_room();
    place.write("secret.csv", "old");
    fs::permissions(place.path("secret.csv"), fs::perms::owner_read | fs::perms::owner_write);
    link(place, "secret.csv", "link.csv");
    fs::create_directory(place.path("there"));
    link(place, "there/new.json", "dangling.json");
    REQUIRE(place.hemilux(solve + std::string("-o link.csv -o dangling.json")).code == 0);
    CHECK(fs::status(place.path("secret.csv")).permissions() ==
          (fs::perms::owner_read | fs::perms::owner_write));
    CHECK_THAT(place.read("secret.csv"), Contains("radiosity_r"));
    CHECK(fs::is_symlink(place.path("link.csv")));
    CHECK(fs::is_symlink(place.path("dangling.json")));
    CHECK(fs::is_regular_file(place.path("there/new.json")));

    link(place, "nowhere/new.csv", "lost.csv");
    const auto lost = place.hemilux(solve + std::string("-o lost.csv"));
    CHECK(lost.code == 3);
    CHECK_THAT(lost.err, Contains("lost.csv: the folder 'nowhere' does not exist"));
    link(place, "circle.csv", "circle.csv");
    CHECK(place.hemilux(solve + std::string("-o circle.csv")).code == 3);
    link(place, "there/both.csv", "one.csv");
    link(place, "there/both.csv", "two.csv");
    check_refused(place, solve + std::string("-o one.csv -o two.csv"), "one.csv", "two.csv");
}

TEST_CASE("devices, folders and files of the kernel are no input") {
    const Workplace place;
    place.write_room();
    for (const char* target :
         {"/dev/zero", "/dev/null", "/proc/self/mem", "/proc/self/status", "."}) {
        CAPTURE(target);
        if (!fs::exists(target))
            continue;
        const auto table = place.hemilux(solve + std::string("-o a.csv --reference ") + target);
        CHECK(table.code == 2);
        CHECK_THAT(table.err, Contains(std::string(target) + ": expected a file, this is a"));
        const auto resumed = place.hemilux(solve + std::string("-o a.csv --resume ") + target);
        CHECK(resumed.code == 2);
        CHECK_THAT(resumed.err, Contains(std::string(target) + ": expected a file, this is a"));
        link(place, target, "link.obj");
        CHECK(place.hemilux("info link.obj").code == 2);
        fs::remove(place.path("link.obj"));
    }
    const auto compared = place.hemilux("compare none.obj -o a --reference /dev/zero");
    CHECK(compared.code == 2); // before the scene is read
    CHECK_THAT(compared.err, Contains("/dev/zero: expected a file"));
}

TEST_CASE("a pipe may be the scene or the reference") {
    const Workplace place;
    place.write_room();
    REQUIRE(place.hemilux(solve + std::string("-o reference.csv")).code == 0);
    const std::string in = "cd '" + place.path("").string() + "' && ";
    const std::string program = "'" HEMILUX_PROGRAM "' ";
    CHECK(std::system(
              (in + "cat reference.csv | " + program + solve + "-q -o a.csv --reference /dev/stdin")
                  .c_str()) == 0);
    link(place, "/dev/stdin", "in.obj");
    CHECK(std::system(
              (in + "cat room.obj | " + program + "solve in.obj --steps 1 -q -o b.csv").c_str()) ==
          0);
    CHECK(place.has("b.csv"));
}

TEST_CASE("a pipe to which nobody writes is not waited for", "[slow]") {
    const Workplace place;
    place.write_room();
    REQUIRE(mkfifo(place.path("pipe.obj").c_str(), 0600) == 0);
    const std::string arguments = GENERATE(
        "solve pipe.obj", "solve room.obj --config pipe.obj", "solve room.obj --reference pipe.obj",
        "solve room.obj --points pipe.obj --points-output light.csv");
    CAPTURE(arguments);
    const auto result = place.hemilux(arguments + " -o a.csv");
    CHECK(result.code == 2);
    CHECK_THAT(result.err,
               Contains("pipe.obj: expected a file, this is a pipe that nobody writes"));
    CHECK(!place.has("a.csv"));
}

TEST_CASE("an error in a scene from a pipe names the line, and the pipe is not opened again") {
    const Workplace place;
    // A closed room of reflectance 1 that emits has no solution.
    place.write_room();
    std::string text = place.read("room.obj");
    place.write("scene.obj", text);
    REQUIRE(mkfifo(place.path("pipe.obj").c_str(), 0600) == 0);
    const std::string arguments = " --reflectance '*=1' --method matrix --steps 1 -o a.csv";
    const auto expected = place.hemilux("solve scene.obj" + arguments);
    REQUIRE(expected.code == 2);
    REQUIRE_THAT(expected.err, Contains("scene.obj:"));
    Running run(place, "solve pipe.obj" + arguments, place.path("stderr.txt").c_str());
    place.write("pipe.obj", text); // waits for the program to read
    CHECK(test::wait_until([&] { return run.ended(); }));
    CHECK(run.wait() == 2);
    std::string message = place.read("stderr.txt");
    const std::size_t name = message.find("pipe.obj:");
    REQUIRE(name != std::string::npos);
    message.replace(name, 4, "scene");
    CHECK_THAT(expected.err, Contains(message.substr(name, message.find('\n', name) - name)));
}

TEST_CASE("a signal ends a wait for the reader of an output", "[slow]") {
    const Workplace place;
    place.write_room();
    REQUIRE(mkfifo(place.path("pipe.csv").c_str(), 0600) == 0);
    const int signal = GENERATE(SIGINT, SIGTERM);
    const bool has_reader = GENERATE(false, true); // one that reads nothing, and the pipe fills up
    const std::string command =
        GENERATE("solve room.obj --method stratified --steps 1 --max-edge .02 -o a.ply -o pipe.csv",
                 "formfactors room.obj --max-edge .1 --rays 64 -o a.csv -o pipe.csv");
    CAPTURE(signal, has_reader, command);
    const int reader =
        has_reader ? open(place.path("pipe.csv").c_str(), O_RDONLY | O_NONBLOCK) : -1;
    Running run(place, command, place.path("stderr.txt").c_str());
    const bool solves = command.starts_with("solve");
    REQUIRE(test::wait_until([&] { return place.has(solves ? "a.ply" : "a.csv"); }));
    run.send(signal);
    CHECK(test::wait_until([&] { return run.ended(); }));
    CHECK(run.wait() == 128 + signal);
    CHECK_THAT(place.read("stderr.txt"), Contains("left out pipe.csv"));
    CHECK(place.has(solves ? "a.ply" : "a.csv"));
    if (reader >= 0)
        close(reader);
}

#if !defined(__SANITIZE_THREAD__) // which keeps signals back while a file is being opened
TEST_CASE("a signal ends the reading of a scene or a reference for every subcommand") {
    const Workplace place;
    place.write_room();
    REQUIRE(mkfifo(place.path("slow.obj").c_str(), 0600) == 0);
    REQUIRE(mkfifo(place.path("slow.csv").c_str(), 0600) == 0);
    const std::string command =
        GENERATE("density slow.obj -o a.svg", "formfactors slow.obj -o a.csv",
                 "compare slow.obj -o compared", "solve room.obj -o a.csv --reference slow.csv");
    CAPTURE(command);
    Running run(place, command, place.path("stderr.txt").c_str());
    const std::string pipe = command.ends_with("slow.csv") ? "slow.csv" : "slow.obj";
    int writer = -1;
    CHECK(test::wait_until([&] {
        writer = open(place.path(pipe).c_str(), O_WRONLY | O_NONBLOCK);
        return writer >= 0;
    }));
    run.send(SIGTERM);
    CHECK(test::wait_until([&] { return run.ended(); }));
    CHECK(run.wait() == 143);
    close(writer);
}
#endif

TEST_CASE("a signal while a picture is rendered leaves it and the other outputs", "[slow]") {
    const Workplace place;
    place.write_room();
    // One thread writes the table or the drawing first and works on the picture for long.
    const auto [command, other, picture] = GENERATE(
        std::tuple("solve room.obj --method stratified --steps 1 --no-gather -o huge.png "
                   "-o a.csv --size 8192x6144",
                   "a.csv", "huge.png"),
        std::tuple("density room.obj -o a.svg -o huge.png --size 8192x6144", "a.svg", "huge.png"),
        std::tuple("compare room.obj -o huge --methods stratified --runs 1 "
                   "--budget-rays 1e4 --reference-error .1 --size 8192x6144",
                   "huge/error.svg", "huge/reference.png"));
    CAPTURE(command);
    Running run(place, std::string(command) + " --threads 1 >table.txt",
                place.path("stderr.txt").c_str());
    REQUIRE(test::wait_until([&] { return place.has(other); }));
    run.send(SIGTERM);
    CHECK(test::wait_until([&] { return run.ended(); }));
    CHECK(run.wait() == 143);
    CHECK_THAT(place.read("stderr.txt"), !Contains("left out"));
    CHECK(place.has(other));
    CHECK(place.has(picture));
}

TEST_CASE("a signal ends a wait for the reader of stderr") {
    const Workplace place;
    place.write_room();
    const std::string path = place.path("talk").string();
    REQUIRE(mkfifo(path.c_str(), 0600) == 0);
    const int reader = open(path.c_str(), O_RDONLY | O_NONBLOCK); // reads nothing
    const int writer = open(path.c_str(), O_WRONLY | O_NONBLOCK);
    const auto is_full = [&] {
        pollfd pipe{.fd = writer, .events = POLLOUT, .revents = 0};
        return poll(&pipe, 1, 0) == 0;
    };
    const bool full_from_the_start = GENERATE(false, true);
    CAPTURE(full_from_the_start);
    while (full_from_the_start && write(writer, "full", 4) > 0)
        continue;
    Running run(place, "solve room.obj --method stratified --rays 1 --steps 4000000000 -v -o a.csv",
                path.c_str());
    REQUIRE(test::wait_until([&] { return is_full() && run.handles(SIGTERM); }));
    run.send(SIGTERM);
    CHECK(test::wait_until([&] { return run.ended(); }));
    CHECK(run.wait() == 143);
    CHECK(place.has("a.csv") != full_from_the_start);
    close(reader);
    close(writer);
}
