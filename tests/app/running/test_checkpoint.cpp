// --checkpoint and --resume: the same bytes as without an interruption, and no checkpoint that is
// not of this run.
#include "app/check_fails.h"
#include "app/running.h"
#include "io/results/checkpoint.h"
#include "radiosity/engine/solving/method.h"
#include "support/catch.h"
#include "support/guides.h"

#include <filesystem>
#include <limits>
#include <random>

using Catch::Contains;
using test::Running;
using test::wait_for;
using test::Workplace;

namespace {

const std::string run_of_8 =
    "solve room.obj --method hemisphere --rays 20 --max-edge .3 --steps 8 -o ";

void check_refused(const Workplace& place, const std::string& arguments,
                   const std::string& message) {
    test::check_fails(place, 2, arguments + " -o refused.csv", message);
    CHECK_FALSE(place.has("refused.csv"));
}

std::size_t lines_of(const std::string& text) {
    return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

/// Until the running program has renewed the file so many times, or has ended.
void wait_for_renewals(const Workplace& place, const Running& running, const std::string& file,
                       test::FileVersion last, int renewals) {
    REQUIRE(test::wait_until([&] {
        const test::FileVersion now = test::version_of(place, file);
        renewals -= now != last;
        last = now;
        return renewals <= 0 || running.ended();
    }));
}

/// Starts the run again and again, each time killed at a random moment after it has written a
/// random number of checkpoints: the first time at least one. Then it ends by itself. A slow
/// machine and a fast one differ in the steps that are done, not in what is checked.
void check_kills(const Workplace& place, int kills, const std::string& run, int max_renewals) {
    REQUIRE(place.hemilux(run + " -o whole.csv -o whole.ply").code == 0);
    std::mt19937 random(7); // moments and counts: statistics of no other test depend on it
    std::uniform_int_distribution<int> count(0, max_renewals);
    std::uniform_real_distribution<double> milliseconds(0, 30);
    const std::string kept = run + " --checkpoint saved --every 0 -o parts.csv -o parts.ply";
    for (int kill = 0; kill < kills; ++kill) {
        const int renewals = kill == 0 ? 1 : count(random);
        const test::FileVersion before = test::version_of(place, "saved");
        Running running(place, kept + (kill > 0 ? " --resume saved" : ""),
                        place.path("stderr.txt").c_str());
        wait_for_renewals(place, running, "saved", before, renewals);
        std::this_thread::sleep_for(
            std::chrono::duration<double, std::milli>(milliseconds(random)));
        running.send(SIGKILL);
        const int code = running.wait();
        CAPTURE(kill, renewals, place.read("stderr.txt"));
        REQUIRE((code == -1 || code == 0)); // a resumed run is not refused; it may be at its end
        REQUIRE(place.has("saved"));
    }
    const auto last = place.hemilux(kept + " --resume saved");
    CAPTURE(last.err);
    REQUIRE(last.code == 0);
    CHECK(place.read("parts.csv") == place.read("whole.csv"));
    CHECK(place.read("parts.ply") == place.read("whole.ply"));
}

} // namespace

TEST_CASE("a resumed run ends with the bytes of one that was not interrupted", "[slow]") {
    const Workplace place;
    place.write_room();
    const std::string method = GENERATE("stored-transport", "hemisphere", "hemisphere --literal",
                                        "hemisphere --guide pyramid", "hemisphere --guide visible",
                                        "hemisphere --guide learned", "hemisphere-1997",
                                        "hemisphere-1997 --literal --stored-steps 3 --parts 1",
                                        "monte-carlo", "progressive-monte-carlo", "stratified");
    if (method.find("--guide") != std::string::npos && !hemilux::test::has_research())
        return;
    CAPTURE(method);
    const std::string run = "solve room.obj --rays 20 --method " + method;
    REQUIRE(place.hemilux(run + " --steps 6 -o whole.csv --steps-log whole_steps.csv").code == 0);
    REQUIRE(place.hemilux(run + " --steps 1 --checkpoint saved -o a.csv").code == 0);
    REQUIRE(place.hemilux(run + " --steps 4 --resume saved --checkpoint saved -o a.csv").code == 0);
    REQUIRE(place
                .hemilux(run + " --steps 6 --resume saved -t 3 -o a.csv --steps-log steps.csv "
                               "--stats a.json")
                .code == 0);
    CHECK(place.read("a.csv") == place.read("whole.csv"));
    CHECK(lines_of(place.read("steps.csv")) == lines_of(place.read("whole_steps.csv")));
    CHECK_THAT(place.read("a.json"), Contains("\"steps\": 6"));

    SECTION("nothing is left to do") {
        REQUIRE(place.hemilux(run + " --steps 6 --resume saved --checkpoint saved -o a.csv").code ==
                0);
        REQUIRE(place.hemilux(run + " --steps 6 --resume saved -o again.csv").code == 0);
        CHECK(place.read("again.csv") == place.read("whole.csv"));
    }
}

TEST_CASE("a run to an error resumes, and the time before counts") {
    const Workplace place;
    place.write_room();
    const std::string run = "solve room.obj --method hemisphere --rays 20 --error .03";
    REQUIRE(place.hemilux(run + " -o whole.csv").code == 0);
    REQUIRE(place
                .hemilux("solve room.obj --method hemisphere --rays 20 --steps 3 --checkpoint "
                         "saved -o a.csv")
                .code == 0);
    REQUIRE(place.hemilux(run + " --resume saved -o a.csv").code == 0);
    CHECK(place.read("a.csv") == place.read("whole.csv"));

    // The three steps before have used up the time. If it did not count there would be a fourth.
    const std::string timed = "solve room.obj --method hemisphere --rays 20 --resume saved";
    const auto steps_log = [&](const std::string& arguments) {
        REQUIRE(place.hemilux(timed + " -o b.csv --steps-log steps.csv" + arguments).code == 0);
        return place.read("steps.csv");
    };
    const std::string before = steps_log(" --steps 3");
    REQUIRE(lines_of(before) == 1 + 3);
    double used = 0;
    REQUIRE(std::sscanf(before.c_str() + before.rfind("hemisphere,0,"), "hemisphere,0,%*u,%*u,%lf",
                        &used) == 1);
    CHECK(steps_log(" --time " + std::to_string(.99 * used)) == before);
    const std::string after = steps_log(" --steps 4");
    CHECK(after.starts_with(before));
    double last = 0;
    for (std::size_t row = after.find('\n'); row + 1 < after.size();
         row = after.find('\n', row + 1)) {
        double seconds = 0;
        REQUIRE(std::sscanf(after.c_str() + row + 1, "hemisphere,0,%*u,%*u,%lf", &seconds) == 1);
        CHECK(seconds > last);
        last = seconds;
    }
}

TEST_CASE("Ctrl-C leaves a checkpoint of all steps that were done") {
    const Workplace place;
    place.write_room();
    const std::string run =
        GENERATE("solve room.obj --rays 20", "solve room.obj --rays 20 --method hemisphere");
    Running running(place, run + " --steps 4000000000 -v --checkpoint saved -o a.csv",
                    place.path("stderr.txt").c_str());
    REQUIRE(wait_for(place, "stderr.txt", "step 3:"));
    running.interrupt();
    CHECK(running.wait() == 130);
    const std::string there = place.read("a.csv");
    REQUIRE(place.hemilux(run + " --steps 1 --resume saved -o b.csv").code == 0);
    CHECK(place.read("b.csv") == there);
}

TEST_CASE("checkpoints of other runs are refused") {
    const Workplace place;
    place.write_room();
    REQUIRE(place.hemilux(run_of_8 + "a.csv --checkpoint saved").code == 0);
    const std::string same =
        "solve room.obj --rays 20 --max-edge .3 --steps 8 --resume saved --method";
    std::vector<std::string> options{"--seed 2", "--depth 1", "--threshold 3", "--literal",
                                     "--keep-all"};
    if (hemilux::test::has_research())
        options.emplace_back("--guide learned");
    for (const std::string& option : options)
        check_refused(place, same + " hemisphere " + option,
                      "is a checkpoint of another run: expected " +
                          option.substr(0, option.find(' ')));
    check_refused(place, same + " stratified", "is a checkpoint of another run: expected --method");
    check_refused(place,
                  "solve room.obj --method hemisphere --rays 21 --max-edge .3 --resume saved",
                  "expected --rays 21, it has 20");
    for (const char* arguments :
         {"solve room.obj --method hemisphere --rays 20 --resume saved",
          "solve room.obj --method hemisphere --rays 20 --max-edge .2 --resume saved",
          "solve room.obj --method hemisphere --rays 20 --max-edge .3 --two-sided --resume saved",
          "solve room.obj --method hemisphere --rays 20 --max-edge .3 --reflectance white=.51 "
          "--resume saved",
          "solve room.obj --method hemisphere --rays 20 --max-edge .3 --emission lamp=1 --resume "
          "saved"})
        check_refused(place, arguments, "saved: is a checkpoint of another scene");
    check_refused(place, "solve room.obj --resume nothing", "nothing: cannot read");
    check_refused(place, "solve room.obj --resume room.mtl",
                  "expected a checkpoint written by hemilux --checkpoint");
    check_refused(place, "solve room.obj --resume .", "no regular file");
    check_refused(place, "solve room.obj --resume /dev/zero", "no regular file");
}

TEST_CASE("damaged checkpoints are refused") {
    const Workplace place;
    place.write_room();
    const std::string run = "solve room.obj --rays 5 --steps 2";
    REQUIRE(place.hemilux(run + " -o a.csv --checkpoint saved").code == 0);
    const std::string good = place.read("saved");
    for (const std::size_t length : {std::size_t{0}, std::size_t{5}, std::size_t{28},
                                     std::size_t{31}, good.size() / 2, good.size() - 1}) {
        place.write("saved", good.substr(0, length));
        check_refused(place, run + " --resume saved", "saved: ");
    }
    place.write("saved", good + "x");
    check_refused(place, run + " --resume saved", "is a damaged checkpoint: its length");
    std::string other = good;
    other[other.size() / 2] = static_cast<char>(other[other.size() / 2] ^ 4);
    place.write("saved", other);
    check_refused(place, run + " --resume saved", "is a damaged checkpoint: its checksum");
    other = good;
    other[good.find('\n') - 1] = '1'; // of before
    place.write("saved", other);
    check_refused(place, run + " --resume saved", "another version");
}

TEST_CASE("a sealed checkpoint with wrong rows is refused") {
    const Workplace place;
    place.write_room();
    const std::string run = "solve room.obj --rays 5 --method hemisphere";
    REQUIRE(place.hemilux(run + " --steps 2 --checkpoint saved -o a.csv").code == 0);
    const hemilux::Checkpoint good = hemilux::read_checkpoint(place.path("saved").string());
    const auto check = [&](const auto& change) {
        hemilux::Checkpoint bad = good;
        change(bad);
        place.write("saved", hemilux::to_bytes(bad));
        check_refused(place, run + " --steps 3 --resume saved", "is a damaged checkpoint");
    };
    const double nan = std::numeric_limits<double>::quiet_NaN();
    check([](hemilux::Checkpoint& c) { c.rows.pop_back(); });
    check([](hemilux::Checkpoint& c) { c.rows[1].record.step = 7; });
    check([](hemilux::Checkpoint& c) { c.rows[0].method = "matrix"; });
    check([](hemilux::Checkpoint& c) { c.rows[0].record.estimated_error = -1; });
    check([&](hemilux::Checkpoint& c) { c.rows[1].record.seconds = nan; });
    check([&](hemilux::Checkpoint& c) { c.seconds = -nan; });
    check([](hemilux::Checkpoint& c) { c.seconds = -1; });
    check([](hemilux::Checkpoint& c) { c.state += "x"; });
}

TEST_CASE("a checkpoint that cannot be written leaves the one before and ends with 3") {
    const Workplace place;
    place.write_room();
    const std::string run = "solve room.obj --rays 5 --max-edge .05 --checkpoint saved --every 0 " +
                            test::camera_in_room;
    REQUIRE(place.hemilux(run + " --steps 1 -o a.png --size 16x12").code == 0);
    const std::string good = place.read("saved");
    // Files of at most a few blocks: the picture fits, the checkpoint does not.
    const std::string limited = "(ulimit -f 40; exec '" HEMILUX_PROGRAM "' " + run +
                                " --steps 2 --resume saved -o b.png --size 16x12) 2>stderr.txt";
    const int status = std::system(("cd '" + place.path("").string() + "' && " + limited).c_str());
    CHECK(WEXITSTATUS(status) == 3);
    CHECK_THAT(place.read("stderr.txt"), Contains("saved: cannot write"));
    CHECK(place.has("b.png"));
    CHECK(place.read("saved") == good);
    for (const auto& entry : std::filesystem::directory_iterator(place.path("")))
        CHECK_THAT(entry.path().filename().string(), !Contains(".tmp"));
}

TEST_CASE("what contradicts a checkpoint is wrong usage") {
    const Workplace place;
    place.write_room();
    const auto check_usage = [&](const std::string& arguments, const std::string& message) {
        test::check_fails(place, 1, "solve room.obj -o a.png " + arguments, message);
    };
    check_usage("--every 3", "add it");
    check_usage("--checkpoint c --every -1", "--every");
    check_usage("--checkpoint a.png", "named twice");
    check_usage("--checkpoint room.obj", "named twice");
    check_usage("--resume a.png", "named twice");
    check_usage("--method matrix --checkpoint c", "these do: hemisphere, hemisphere-1997, ");
    check_usage("--method matrix --resume c", "monte-carlo");
    check_usage("--every-step --resume c", "--camera and --exposure");
    CHECK(place.hemilux("solve room.obj -o a.png --checkpoint no/where").code == 3);
}

TEST_CASE("runs killed at random moments resume", "[slow]") {
    const Workplace place;
    place.write_room();
    const std::string method = GENERATE("stored-transport", "hemisphere");
    check_kills(place, 6, "solve room.obj --rays 100 --max-edge .15 --steps 20 --method " + method,
                4);
}

TEST_CASE("runs of every method that saves resume, killed at 16 random moments", "[slow]") {
    const Workplace place;
    place.write_room();
    for (const hemilux::Method* const method : hemilux::methods()) {
        if (!method->can_resume())
            continue;
        const std::string steps = method->name == "stored-transport" ? "40" : "150";
        CAPTURE(method->name);
        check_kills(place, 16,
                    "solve room.obj --rays 100 --max-edge .1 --steps " + steps + " --method " +
                        std::string(method->name),
                    3);
        std::filesystem::remove(place.path("saved"));
    }
}
