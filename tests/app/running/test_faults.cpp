// What the system does to a run: signals, full disks, closed files, little memory.
#include "app/memory/memory.h"
#include "app/program.h"
#include "app/running.h"
#include "radiosity/paper/scene/mesh.h"
#include "support/catch.h"
#include "support/scenes.h"

#include <algorithm>
#include <chrono>
#include <filesystem>

using Catch::Contains;
using test::Running;
using test::wait_for;
using test::Workplace;

namespace {

namespace fs = std::filesystem;

/// By the shell, inside the folder; what is not redirected goes to stderr.txt.
int shell(const Workplace& place, const std::string& command) {
    const int status =
        std::system(("cd '" + place.path("").string() + "' && H='" HEMILUX_PROGRAM "' && { " +
                     command + "; } >>out.txt 2>>stderr.txt </dev/null")
                        .c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

std::vector<std::string> files_of(const Workplace& place) {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(place.path("")))
        names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end());
    return names;
}

/// A glowing sheet of n x n quads under a faint one: no patch shoots more than its share. Or a
/// dark one under a lamp, which shoots all.
void write_large(const Workplace& place, int n, bool one_lamp = false) {
    std::string text = "mtllib large.mtl\nusemtl white\n";
    for (int i = 0; i <= n; ++i)
        for (int j = 0; j <= n; ++j)
            text += "v " + std::to_string(i) + " 0 " + std::to_string(j) + "\n";
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            const int a = i * (n + 1) + j + 1;
            text += "f";
            for (const int corner : {a, a + 1, a + n + 2, a + n + 1})
                text += " " + std::to_string(corner);
            text += "\n";
        }
    const std::string side = std::to_string(n);
    text += "v 0 9 0\nv " + side + " 9 0\nv " + side + " 9 " + side + "\nv 0 9 " + side +
            "\nusemtl lamp\nf -4 -3 -2 -1\n";
    place.write("large.obj", text);
    place.write("large.mtl",
                one_lamp
                    ? "newmtl white\nKd .5 .5 .5\nnewmtl lamp\nKe 1 1 1\nKd 0 0 0\n"
                    : "newmtl white\nKd .5 .5 .5\nKe 1 1 1\nnewmtl lamp\nKe 1e-6 0 0\nKd 0 0 0\n");
}

std::ptrdiff_t lines_of_message(const std::string& text) {
    return std::count(text.begin(), text.end(), '\n');
}

/// Seconds that processors work on reading the scene.
double seconds_of_reading(const Workplace& place, const std::string& scene) {
    Running reading(place, "info " + scene + " >info.txt", place.path("info_talk.txt").c_str());
    REQUIRE(reading.wait() == 0);
    return reading.seconds_of_processors();
}

/// Sends SIGTERM once processors have worked on the run for so long, and checks that what is then
/// still done is little: they work on it no longer than on reading the scene. A step of such a run
/// would take them a hundred times as long.
void check_ends_soon(Running& run, double seconds, double reading) {
    REQUIRE(test::wait_until([&] { return run.seconds_of_processors() >= seconds; }));
    const double before = run.seconds_of_processors();
    run.send(SIGTERM);
    CHECK(run.wait() == 143);
    CHECK(run.seconds_of_processors() - before < reading);
}

} // namespace

TEST_CASE("SIGTERM writes what was computed and ends with 143") {
    const Workplace place;
    place.write_room();
    Running run(place, "solve room.obj --steps 4000000000 -v -o a.csv",
                place.path("stderr.txt").c_str());
    REQUIRE(wait_for(place, "stderr.txt", "step 2:"));
    run.send(SIGTERM);
    CHECK(run.wait() == 143);
    CHECK_THAT(place.read("stderr.txt"), Contains("interrupted; the outputs hold"));
    CHECK(place.has("a.csv"));
}

#if !defined(__SANITIZE_THREAD__) // which keeps signals back while a file is being opened
TEST_CASE("a signal while the scene is read ends the program at once") {
    const Workplace place;
    place.write_room();
    REQUIRE(shell(place, "mkfifo slow.obj") == 0);
    const int signal = GENERATE(SIGINT, SIGTERM);
    Running run(place, "solve slow.obj -o a.csv", place.path("stderr.txt").c_str());
    // There is a writer as soon as there is a reader. It writes nothing, so reading has no end.
    int writer = -1;
    CHECK(test::wait_until([&] {
        writer = open(place.path("slow.obj").c_str(), O_WRONLY | O_NONBLOCK);
        return writer >= 0;
    }));
    run.send(signal);
    CHECK(test::wait_until([&] { return run.ended(); }));
    close(writer);
    CHECK(run.wait() == 128 + signal);
    CHECK_THAT(place.read("stderr.txt"), Contains("interrupted before there was a result"));
    CHECK_FALSE(place.has("a.csv"));
}
#endif

TEST_CASE("a signal ends a large run soon, whatever it is at", "[slow]") {
    // No picture and no table is written, as they take their time.
    const Workplace place;
    write_large(place, 320);
    const double reading = seconds_of_reading(place, "large.obj");
    for (const std::string method : {"hemisphere", "stratified", "monte-carlo", "progressive",
                                     "matrix", "progressive-monte-carlo"})
        // Within the file, the mesh, the tree, and what is the method's own.
        for (const double moment : {0., .5, 1.2, 3.}) {
            CAPTURE(method, moment);
            Running run(place, "solve large.obj --rays 1000 -o a.json --method " + method,
                        place.path("stderr.txt").c_str());
            REQUIRE(test::wait_until([&] { return run.handles(SIGTERM); }));
            check_ends_soon(run, moment * reading, reading);
        }
}

TEST_CASE("a signal ends the shot of a lamp that lights a hundred thousand patches", "[slow]") {
    const Workplace place;
    write_large(place, 320, true);
    const double reading = seconds_of_reading(place, "large.obj");
    for (const std::string method : {"hemisphere", "monte-carlo"}) {
        CAPTURE(method);
        Running run(place, "solve large.obj --rays 10000 -v -o a.json --method " + method,
                    place.path("stderr.txt").c_str());
        REQUIRE(wait_for(place, "stderr.txt", "BVH:"));
        check_ends_soon(run, run.seconds_of_processors() + 2 * reading, reading); // within the shot
    }
}

TEST_CASE("a full disk leaves nothing half-written") {
    const Workplace place;
    place.write_room();
    place.write("keep.csv", "old");
    const std::string limited =
        "ulimit -f 4 && \"$H\" solve room.obj --max-edge .05 --steps 1 " + test::camera_in_room;
    CHECK(shell(place, limited + "-o keep.csv -o new.ply -o small.png --size 4x4") == 3);
    CHECK_THAT(place.read("stderr.txt"), Contains("keep.csv: cannot write: File too large"));
    CHECK(place.read("keep.csv") == "old");
    CHECK(files_of(place) == std::vector<std::string>{"keep.csv", "out.txt", "room.mtl", "room.obj",
                                                      "small.png", "stderr.txt"});
    for (const char* kind : {"csv", "png", "hdr", "ply", "json"}) {
        const std::string name = std::string("full.") + kind;
        fs::create_symlink("/dev/full", place.path(name));
        CHECK(shell(place, "\"$H\" solve room.obj --steps 1 --size 9x9 " + test::camera_in_room +
                               "-o " + name) == 3);
        CHECK_THAT(place.read("stderr.txt"), Contains(name + ": cannot write: No space left"));
    }
    for (const char* option : {"--stats full.csv", "--steps-log full.csv"})
        CHECK(shell(place, std::string("\"$H\" solve room.obj --steps 1 -o a.csv ") + option) == 3);
    CHECK(shell(place, "\"$H\" density room.obj -o full.png") == 3);
    CHECK(shell(place, "\"$H\" formfactors room.obj -o full.csv") == 3);
}

TEST_CASE("folders that cannot be written to or are files are refused before any work") {
    const Workplace place;
    place.write("slow.obj", "not even read");
    fs::create_directory(place.path("folder.csv"));
    place.write("file", "");
    for (const std::string arguments :
         {"solve slow.obj -o folder.csv", "solve slow.obj -o file/a.csv",
          "solve slow.obj -o none/a.csv", "solve slow.obj -o a.png --stats folder.csv",
          "solve slow.obj -o a.png --steps-log none/a.csv",
          "solve slow.obj -o a.png --checkpoint folder.csv", "compare slow.obj -o file",
          "density slow.obj -o none/a.png", "formfactors slow.obj -o folder.csv"}) {
        CAPTURE(arguments);
        const auto outcome = place.hemilux(arguments);
        CHECK(outcome.code == 3);
        CHECK(lines_of_message(outcome.err) == 1);
    }
}

TEST_CASE("a reference that cannot be read is refused before the patches are divided") {
    const Workplace place;
    place.write_room();
    place.write("bad.csv", "not,a,table\n1,2,3\n");
    const std::string endless =
        "solve room.obj --divide auto --error 0.0001% --max-rays 1000000000000000 -v -o a.csv ";
    for (const auto& [arguments, code] :
         {std::pair{"--reference none.csv", 2}, std::pair{"--reference bad.csv", 2},
          std::pair{"--reference bad.csv --detail nothing", 2}, std::pair{"--detail nothing", 1}}) {
        CAPTURE(arguments);
        const auto outcome = place.hemilux(endless + arguments);
        CHECK(outcome.code == code);
        CHECK_THAT(outcome.err, !Contains("BVH"));
        CHECK_FALSE(place.has("a.csv"));
    }
}

TEST_CASE("a closed stdout or stderr is an error to report, or none at all") {
    const Workplace place;
    place.write_room();
    CHECK(shell(place, "\"$H\" info room.obj >&-") == 3);
    CHECK(shell(place, "\"$H\" --help >&-") == 3);
    CHECK(shell(place, "\"$H\" solve --help >/dev/full") == 3);
    CHECK_THAT(place.read("stderr.txt"), Contains("standard output: cannot be written"));
    // No output file takes the number of a closed one, and what is said goes nowhere.
    CHECK(shell(place, "\"$H\" solve room.obj --steps 1 -v -o a.csv <&- >&- 2>&-") == 0);
    CHECK(shell(place, "\"$H\" solve room.obj --steps 1 -o b.csv") == 0);
    CHECK(place.read("a.csv") == place.read("b.csv"));
    CHECK(shell(place, "\"$H\" solve none.obj -o a.csv 2>&-") == 2);
}

TEST_CASE("a reader that closes its pipe has read enough of what is printed, but not of results") {
    const Workplace place;
    place.write_room();
    const std::string nobody_reads =
        "rm -f pipe; mkfifo pipe && exec 3<>pipe 4>pipe 3<&- && \"$H\" ";
    for (const char* const printed :
         {"--help", "help", "solve --help", "--version", "compare --version", "--print man",
          "--print bash", "--print fish", "info room.obj", "info room.obj --json",
          "compare room.obj --methods monte-carlo --rays 10 --runs 1 --reference-error .2 -o a "
          "-q"}) {
        CAPTURE(printed);
        CHECK(shell(place, nobody_reads + printed + " >&4") == 0);
        CHECK(place.read("stderr.txt").empty());
    }
    // The reader closes the pipe before the program begins.
    CHECK(shell(place, "mkfifo gate && { read go <gate; \"$H\" solve room.obj --steps 1 -q -o -; "
                       "echo $? >code; } | { exec <&-; echo go >gate; }") == 0);
    CHECK(place.read("code") == "3\n");
    CHECK_THAT(place.read("stderr.txt"), Contains("cannot write: Broken pipe"));
}

TEST_CASE("a scene too large for --memory stops with what it would need") {
    const Workplace place;
    place.write_room();
    const auto outcome =
        place.hemilux("solve room.obj --max-edge .001 --memory 500M -o a.csv --steps 1 "
                      "--method hemisphere");
    CHECK(outcome.code == 3);
    CHECK_THAT(outcome.err, Contains("room.obj: needs about 3.") && Contains("GB (scene") &&
                                Contains("--memory is 524 MB"));
    CHECK(place.hemilux("compare room.obj --max-edge .01 --memory 50M -o a").code == 3);
    CHECK(place.hemilux("solve room.obj --memory 1M -o a.csv").code == 3);
    CHECK(place.hemilux("solve room.obj --memory 100M -o a.csv --steps 1").code == 0);
    for (const char* bad : {"0", "-1", "lots", "1X", "", "nan", "1e300", "1 G"}) {
        CAPTURE(bad);
        const auto usage =
            place.hemilux("solve room.obj -o a.csv --memory '" + std::string(bad) + "'");
        CHECK(usage.code == 1);
        CHECK_THAT(usage.err, Contains("--memory"));
    }
}

TEST_CASE("bytes are read with their units") {
    CHECK(hemilux::parse_bytes("800") == 800u);
    CHECK(hemilux::parse_bytes("1.5k") == 1536u);
    CHECK(hemilux::parse_bytes("2M") == 2u << 20);
    CHECK(hemilux::parse_bytes("1G") == 1u << 30);
    CHECK(hemilux::parse_bytes("1T") == std::uint64_t{1} << 40);
    for (const char* bad : {"", "k", "-1k", "1kk", "1m", "0.5", "1e30", "inf"})
        CHECK_FALSE(hemilux::parse_bytes(bad));
}

TEST_CASE("the patches of a division are foreseen") {
    for (const double max_edge : {0.0, .5, .21, .07})
        for (const bool two_sided : {false, true}) {
            const hemilux::MeshOptions options{.max_edge = max_edge, .two_sided = two_sided};
            const hemilux::Scene scene =
                GENERATE(hemilux::test::room_with_block(), hemilux::test::sphere(2, 1, .5, 1));
            const auto made = static_cast<double>(hemilux::Mesh(scene, options).patches().size());
            CHECK(hemilux::patches_of(scene, options) >= made);
            CHECK(hemilux::patches_of(scene, options) <= 1.5 * made + 10);
        }
}

TEST_CASE("the estimate of memory is near what a run takes", "[slow]") {
    const Workplace place;
    place.write_room();
    const std::string run = "solve room.obj --max-edge .0035 --rays 1 --steps 1 --method " +
                            std::string(GENERATE("monte-carlo", "stratified", "hemisphere"));
    CAPTURE(run);
    const std::string message = place.hemilux(run + " -o a.json --memory 13M").err;
    double need = 0;
    REQUIRE(std::sscanf(message.c_str(), "hemilux: room.obj: needs about %lf MB", &need) == 1);
    REQUIRE(place.hemilux(run + " -o a.json").code == 0);
    const std::string statistics = place.read("a.json");
    const double peak = std::stod(statistics.substr(statistics.find("bytes_peak\":") + 12)) / 1e6;
    CHECK(peak > 1);
#if !defined(__SANITIZE_ADDRESS__)
    CHECK(need > .9 * peak);
    CHECK(need < 1.6 * peak);
#endif
}
