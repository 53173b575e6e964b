// Whatever a run is at, a signal ends it with what there is: stages x signals x commands. Each
// command would be at its stage for hours.
#include "app/program.h"
#include "app/running.h"
#include "app/running/signals.h"
#include "io/files/atomic_file.h"
#include "support/catch.h"

#include <atomic>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

using Catch::Contains;
using test::Running;
using test::wait_for;
using test::Workplace;

namespace {

/// A command, what it says or writes when its stage begins, and the output that is there at the
/// end; empty where there is none.
struct Stage {
    std::string command, message, output;
};

const std::vector<Stage>& stages() {
    static const std::vector<Stage> all{
        // Steps.
        {"solve room.obj --steps 4000000000 -v -o a.csv", "step 2:", "a.csv"},
        {"solve room.obj --method matrix --steps 4000000000 -v -o a.csv", "step 1:", "a.csv"},
        // Division, to an error that is out of reach.
        {"solve room.obj --divide auto --error 0.0001% --max-rays 1000000000000000 -v -o a.ply",
         "division:", "a.ply"},
        // The error of what patches leave out.
        {"solve room.obj --divide auto --error 0.0001% --max-rays 1000000000000000 -v -o a.ply",
         "BVH", "a.ply"},
        // Gathering at points and in a picture.
        {"solve room.obj --points points --points-output p.csv --gather 1024 --max-rays 1000000 -v "
         "-o "
         "a.csv",
         "step 1:", "p.csv"},
        {"solve room.obj --gather 1024 --size 8192x8192 --max-rays 1000000 -v -o a.csv -o a.png " +
             test::camera_in_room,
         "step 1:", "a.png"},
        // What is made for a mesh.
        {"solve room.obj --method stratified --steps 1 --max-edge .02 --bake indirect --gather "
         "1024 -v -o a.csv -o a.glb",
         "step 1:", "a.csv"},
        {"bake room.glb --emission *=1,1,1 --reflectance *=.5,.5,.5 --texels-per-metre 400 "
         "--gather 1024 --max-rays "
         "100000000000 -v -o lit.glb",
         "step 1:", "lit.glb"},
        // Factors, densities, comparisons.
        {"formfactors room.obj --max-edge .005 --rays 1048576 -v -o f.csv", "", ""},
        {"viewfactors room.obj --max-edge .2 --error 0.0001% -v -o f.csv", "", ""},
        {"density room.obj --max-edge .002 --depth 4 --threshold 0 -v -o d.svg", "", ""},
        {"compare room.obj --methods stratified --runs 1 --reference-error 0.0001% -v -o c",
         "reference, step 1", ""},
    };
    return all;
}

void write_inputs(const Workplace& place) {
    place.write_room();
    std::string points;
    for (int i = 0; i < 20000; ++i)
        points += ".5,.5," + std::to_string(.1 + i * 4e-5) + ",0,0,1\n";
    place.write("points", points);
    REQUIRE(place.hemilux("solve room.obj --divide none --steps 1 -q -o room.glb").code == 0);
}

} // namespace

TEST_CASE("a signal ends every stage of every command with what there is, and says so", "[slow]") {
    const Workplace place;
    write_inputs(place);
    const Stage& stage = GENERATE(from_range(stages()));
    const int signal = GENERATE(SIGINT, SIGTERM, SIGHUP);
    CAPTURE(stage.command, signal);
    Running run(place, stage.command + " >table.txt", place.path("stderr.txt").c_str());
    REQUIRE(test::wait_until([&] { return run.handles(SIGXCPU); })); // the last of all
    if (!stage.message.empty())
        REQUIRE(wait_for(place, "stderr.txt", stage.message));
    run.send(signal);
    CHECK(test::wait_until([&] { return run.ended(); }));
    CHECK(run.wait() == 128 + signal);
    CHECK_THAT(place.read("stderr.txt"), Contains("interrupted"));
    if (!stage.output.empty())
        CHECK(place.has(stage.output));
    for (const auto& entry : std::filesystem::directory_iterator(place.path("")))
        CHECK_FALSE(entry.path().filename().string().starts_with(".hemilux-"));
}

TEST_CASE("a terminal that is closed sends SIGHUP twice, and the run still writes") {
    const Workplace place;
    place.write_room();
    Running run(place, "solve room.obj --steps 4000000000 -v -o a.csv",
                place.path("stderr.txt").c_str());
    REQUIRE(wait_for(place, "stderr.txt", "step 2:"));
    run.send(SIGHUP);
    run.send(SIGHUP);
    CHECK(run.wait() == 128 + SIGHUP);
    CHECK(place.has("a.csv"));
}

TEST_CASE("a run under nohup goes on after SIGHUP") {
    const Workplace place;
    place.write_room();
    CHECK(place
              .hemilux("--version; trap '' HUP; '" HEMILUX_PROGRAM
                       "' solve room.obj --steps 64 -q -o b.csv & sleep 0; kill -HUP $!; wait $!")
              .code == 0);
    CHECK(place.has("b.csv"));
}

TEST_CASE("a second signal takes away the file that is half-written") {
    const Workplace place;
    const pid_t child = fork();
    if (child == 0) {
        std::atomic<bool> flag{false};
        hemilux::InterruptGuard guard;
        guard.watch(flag);
        hemilux::AtomicFile file(place.path("a.csv").string());
        file.write(std::string(1 << 20, 'x'));
        raise(SIGTERM);
        raise(SIGTERM);
        _exit(2); // not reached
    }
    int status = 0;
    REQUIRE(waitpid(child, &status, 0) == child);
    CHECK(WEXITSTATUS(status) == 143);
    CHECK(std::filesystem::is_empty(place.path("")));
}
