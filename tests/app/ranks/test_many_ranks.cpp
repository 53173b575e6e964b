// Several processes that mpirun starts: the same bytes as one, and one of them speaks and writes.
// Without mpirun, or where the program has no module for MPI, there is nothing to test.

#include "app/program.h"
#include "app/running.h"
#include "support/catch.h"

#include <cstdlib>
#include <regex>

using test::Workplace;

namespace {

/// Sanitizers would report what Open MPI never gives back.
bool can_start_ranks() {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    return false;
#else
    return std::system("command -v mpirun >/dev/null") == 0 &&
           std::filesystem::exists(
               std::filesystem::path(HEMILUX_PROGRAM).replace_filename("hemilux_mpi.so"));
#endif
}

/// The steps log but for its fifth column, the seconds.
std::string without_seconds(const std::string& log) {
    std::string kept;
    int column = 0;
    for (const char c : log) {
        column = c == '\n' ? 0 : column + (c == ',' ? 1 : 0);
        if (column != 4)
            kept += c;
    }
    return kept;
}

} // namespace

TEST_CASE("mpirun starts ranks that write the bytes of one process", "[slow]") {
    if (!can_start_ranks())
        return;
    const Workplace place;
    place.write_room();
    for (const char* const method :
         {"--divide .1 --steps 3", "--error .06", "--divide .1 --method stratified --steps 4"}) {
        const std::string solve = "solve room.obj --size 40x30 " + test::camera_in_room + method;
        const auto outputs = [](const std::string& name) {
            return " -o " + name + ".csv -o " + name + ".png --steps-log " + name + "_log.csv";
        };
        REQUIRE(place.hemilux(solve + " -t 1" + outputs("one")).code == 0);
        for (const auto& [ranks, threads] : {std::pair{2, 2}, {3, 1}}) {
            CAPTURE(method, ranks, threads);
            const auto outcome =
                place.hemilux_on(ranks, solve + " -t " + std::to_string(threads) + outputs("some"));
            CHECK(outcome.code == 0);
            CHECK(outcome.err.find("wrote some.csv") == outcome.err.rfind("wrote some.csv"));
            CHECK((place.read("some.csv") == place.read("one.csv")));
            CHECK((place.read("some.png") == place.read("one.png")));
            CHECK(without_seconds(place.read("some_log.csv")) ==
                  without_seconds(place.read("one_log.csv")));
        }
    }
}

TEST_CASE("compare on ranks writes the bytes of one process, but for times", "[slow]") {
    if (!can_start_ranks())
        return;
    const Workplace place;
    place.write_room();
    const std::string compare = "compare room.obj --methods monte-carlo,stored-transport "
                                "--budget-rays 20000 --runs 1 --size 40x30 -t 1 " +
                                test::camera_in_room;
    REQUIRE(place.hemilux(compare + "-o one").code == 0);
    const auto outcome = place.hemilux_on(2, compare + "-o two");
    CHECK(outcome.code == 0);
    CHECK(without_seconds(place.read("two/error.csv")) ==
          without_seconds(place.read("one/error.csv")));
    CHECK(!place.read("one/error.csv").empty());
}

TEST_CASE("A checkpoint of three ranks goes on at two, and at one alone", "[slow]") {
    if (!can_start_ranks())
        return;
    const Workplace place;
    place.write_room();
    const std::string solve = "solve room.obj --max-edge .1 --steps ";
    REQUIRE(place.hemilux(solve + "4 -o whole.csv").code == 0);
    REQUIRE(place.hemilux_on(3, solve + "2 --checkpoint state -o half.csv").code == 0);
    REQUIRE(place.hemilux_on(2, solve + "4 --resume state -o two.csv").code == 0);
    REQUIRE(place.hemilux(solve + "4 --resume state -o one.csv").code == 0);
    CHECK((place.read("two.csv") == place.read("whole.csv")));
    CHECK((place.read("one.csv") == place.read("whole.csv")));
}

TEST_CASE("What is wrong for all ranks is said once, with the program's exit code", "[slow]") {
    if (!can_start_ranks())
        return;
    const Workplace place;
    place.write_room();
    const auto times = [](const std::string& text, const std::string& part) {
        int count = 0;
        for (std::size_t at = 0; (at = text.find(part, at)) != text.npos; ++at)
            ++count;
        return count;
    };
    const auto no_scene = place.hemilux_on(3, "solve none.obj -o x.csv");
    CHECK(no_scene.code == 2);
    CHECK(times(no_scene.err, "hemilux: none.obj: ") == 1);
    const auto usage = place.hemilux_on(2, "solve room.obj --nonsense");
    CHECK(usage.code == 1);
    CHECK(times(usage.err, "unknown option") == 1);
    const auto output = place.hemilux_on(2, "solve room.obj --steps 1 -o none/x.csv");
    CHECK(output.code == 3);
}

TEST_CASE("Where a rank dies all end with one message and exit code 3, and no half output",
          "[slow]") {
    if (!can_start_ranks())
        return;
    const Workplace place;
    place.write_room();
    // mpirun's children watch over the ranks, which are theirs.
    const auto outcome =
        place.hemilux_on(3, "solve room.obj --max-edge .05 --error 1e-5 -o out.csv & "
                            "last_child() { [ $1 ] && pgrep -P $1 | tail -1; }; "
                            "until rank=$(last_child $(last_child $!)) && [ \"$rank\" ]; "
                            "do sleep .1; done; sleep .5; kill -9 $rank; wait $!");
    CHECK(outcome.code == 3);
    // Open MPI itself may tell that it could not read the memory of the dead rank.
    const std::regex of_mpi("\\[[^\n]*\\] Read -1, expected [0-9]+, errno = [0-9]+\n");
    CHECK(std::regex_replace(outcome.err, of_mpi, "") ==
          "hemilux: a rank was killed by signal 9 (Killed)\n");
    CHECK_FALSE(place.has("out.csv"));
}
