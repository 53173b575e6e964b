// Ctrl-C, and the progress bar that only a terminal gets to see.
#include "app/program.h"
#include "app/running.h"
#include "app/running/signals.h"
#include "app/watched_terminal.h"
#include "support/catch.h"

#include <atomic>
#include <chrono>
#include <csignal>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <utility>

using Catch::Contains;
using test::Running;
using test::wait_for;
using test::Workplace;

TEST_CASE("the first interrupt sets the flag, the second ends the program with 130") {
    const pid_t child = fork();
    if (child == 0) {
        std::atomic<bool> flag{false};
        hemilux::InterruptGuard guard;
        guard.watch(flag);
        raise(SIGINT);
        if (!flag)
            _exit(1);
        raise(SIGINT);
        _exit(2); // not reached
    }
    int status = 0;
    REQUIRE(waitpid(child, &status, 0) == child);
    REQUIRE(WIFEXITED(status));
    CHECK(WEXITSTATUS(status) == 130);
}

TEST_CASE("Ctrl-C writes what was computed and ends with 130") {
    const Workplace place;
    place.write_room();
    const std::string method = GENERATE("hemisphere", "stratified", "progressive-monte-carlo");
    Running run(place,
                "solve room.obj --steps 4000000000 -v -o a.csv -o a.png --size 16x12 "
                "--steps-log steps.csv --method " +
                    method,
                place.path("stderr.txt").c_str());
    REQUIRE(wait_for(place, "stderr.txt", "step 2:"));
    run.interrupt();
    CHECK(run.wait() == 130);
    CHECK_THAT(place.read("stderr.txt"), Contains("interrupted; the outputs hold"));
    CHECK(place.has("a.csv"));
    CHECK(place.has("a.png"));
    CHECK_THAT(place.read("steps.csv"), Contains(method + ",0,2,"));
}

TEST_CASE("Ctrl-C before the first step is done leaves emission alone, and says so") {
    const Workplace place;
    place.write_room();
    const std::string method =
        GENERATE("hemisphere", "stratified", "progressive-monte-carlo", "matrix");
    CAPTURE(method);
    Running run(place, "solve room.obj --max-edge .1 --rays 1e8 -v -o a.csv --method " + method,
                place.path("stderr.txt").c_str());
    REQUIRE(wait_for(place, "stderr.txt", "BVH:"));
    // Within the step, on most machines; it takes hours on any.
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    run.interrupt();
    CHECK(run.wait() == 130);
    CHECK_THAT(place.read("stderr.txt"), Contains("emission alone"));
    CHECK_THAT(place.read("a.csv"), Contains(",10,8,6,10,8,6,") && Contains(",0,0,0,0,0,0,"));
}

TEST_CASE("Ctrl-C ends a comparison with the files and the table of what was done") {
    const Workplace place;
    place.write_room();
    Running run(place,
                "compare room.obj -o a --methods hemisphere,stratified --runs 9 --budget-rays 1e9 "
                "--reference-error .05 --size 16x12 -v >table.txt",
                place.path("stderr.txt").c_str());
    REQUIRE(wait_for(place, "stderr.txt", "stratified, run 1, step 2:"));
    run.interrupt();
    CHECK(run.wait() == 130);
    CHECK_THAT(place.read("stderr.txt"), Contains("interrupted; the results are those"));
    CHECK_THAT(place.read("a/error.csv"), Contains("stratified,0,2,"));
    CHECK_THAT(place.read("table.txt"), Contains("hemisphere  ") && Contains("stratified  "));
    CHECK(place.has("a/stratified_difference.png"));
}

TEST_CASE("Ctrl-C before there is a reference ends a comparison without one") {
    const Workplace place;
    place.write_room();
    Running run(place, "compare room.obj -o a --max-edge .05 --rays 1e7 -v",
                place.path("stderr.txt").c_str());
    REQUIRE(wait_for(place, "stderr.txt", "BVH:"));
    run.interrupt();
    CHECK(run.wait() == 130);
    CHECK_THAT(place.read("stderr.txt"), Contains("before there was a reference"));
    CHECK_FALSE(place.has("a/reference.csv"));
}

TEST_CASE("a terminal gets a progress bar, which is gone at the end", "[slow]") {
    test::WatchedTerminal terminal;
    const Workplace place;
    place.write_room();
    // An interrupt ends it as soon as the bar was there; the time that is left is shown after 2 %.
    Running run(place, "solve room.obj --method hemisphere --time 60 -o a.csv", terminal.name());
    CHECK(test::wait_until(
        [&] { return terminal.seen().find(" left") != std::string::npos || run.ended(); }));
    run.interrupt();
    const int code = run.wait();
    const std::string seen = terminal.end();

    CHECK(code == 130);
    CHECK_THAT(seen, Contains("rays/s") && Contains(" %  ") && Contains("left"));
    const std::size_t summary = seen.find("hemisphere: 24 patches");
    REQUIRE(summary != std::string::npos);
    CHECK(seen.substr(0, summary).ends_with("\r\033[K"));
    CHECK(seen.find('[', summary) == std::string::npos);
}
