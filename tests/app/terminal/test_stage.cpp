// What a terminal shows while a stage lasts, and what is said of the time at the end.
#include "app/program.h"
#include "app/running.h"
#include "app/terminal/stage.h"
#include "app/terminal/summary.h"
#include "app/watched_terminal.h"
#include "support/catch.h"

#include <string>

using namespace hemilux;
using Catch::Contains;
using test::Running;
using test::Workplace;

TEST_CASE("a stage shows its name and how long it lasts, and fits the terminal") {
    CHECK(stage_line("reading", 0, 200) == "[####....................] reading  0 ms");
    const std::string later = stage_line("reading", 1, 200);
    CHECK(later == "[.......####.............] reading  1.00 s");
    const std::string turned = stage_line("reading", 27. / 7, 200); // 13 from the left again
    CHECK(turned.starts_with("[.............####.......] reading"));
    CHECK(stage_line("reading", 1, 10).size() == 10);
}

TEST_CASE("a stage whose end is known shows how much is done, and the time that is left") {
    CHECK(stage_line("measuring pairs", 0, 2, 200) ==
          "[........................]   0 %  measuring pairs  2.00 s");
    CHECK(stage_line("measuring pairs", .25, 2, 200) ==
          "[######..................]  25 %  measuring pairs  2.00 s, 6.00 s left");
    CHECK(stage_line("measuring pairs", 1, 2, 200).starts_with("[########################] 100 %"));
    CHECK(stage_line("measuring pairs", .5, 1, 10).size() == 10);
}

TEST_CASE("the whole time is told with the stages that matter") {
    Statistics statistics;
    statistics.seconds_total = 10;
    statistics.seconds_solve = .2;
    statistics.seconds_learn = 3;
    statistics.seconds_gather = 6;
    CHECK(
        time_text(statistics) ==
        "whole time 10.0 s: learning and judging light 3.00 s, gathering 6.00 s, all else 1.00 s");
    statistics.seconds_gather = statistics.seconds_learn = statistics.seconds_solve = .1;
    CHECK(time_text(statistics) == "whole time 10.0 s");
}

TEST_CASE("a terminal sees each long stage of a run, and nothing of it at the end", "[slow]") {
    test::WatchedTerminal terminal;
    const Workplace place;
    place.write_room();
    Running run(place,
                "solve room.obj --steps 1 -o a.png --gather 1024 --size 600x450 -t 1 " +
                    test::camera_in_room,
                terminal.name());
    const int code = run.wait();
    const std::string seen = terminal.end();

    CHECK(code == 0);
    CHECK_THAT(seen, Contains(" %  gathering the picture  "));
    const std::size_t summary = seen.find("stored-transport: ");
    REQUIRE(summary != std::string::npos);
    CHECK(seen.find(']', summary) == std::string::npos);
    CHECK_THAT(seen.substr(summary), Contains("whole time"));
}
