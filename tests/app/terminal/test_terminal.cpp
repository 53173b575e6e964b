// What a terminal shows: lines of at most 80 columns. Files and pipes get each message as one line.
#include "app/commands/compare_summary.h"
#include "app/program.h"
#include "app/split.h"
#include "app/terminal/summary.h"
#include "app/terminal/wrap.h"
#include "support/catch.h"

#include <algorithm>
#include <cstdlib>
#include <fcntl.h>
#include <sstream>
#include <string>
#include <sys/ioctl.h>
#include <thread>
#include <unistd.h>
#include <vector>

using Catch::Contains;
using hemilux::wrapped;
using test::lines_of;
using test::Workplace;

namespace {

const std::string scenes = HEMILUX_SOURCE_DIR "/examples/scenes/";

std::vector<std::string> words_of(const std::string& text) {
    std::vector<std::string> words;
    std::istringstream stream(text);
    for (std::string word; stream >> word;)
        words.push_back(word);
    return words;
}

std::size_t longest_line(const std::string& text) {
    std::size_t longest = 0;
    for (const std::string& line : lines_of(text))
        longest = std::max(longest, line.size());
    return longest;
}

/// A terminal without a progress bar.
class Terminal {
  public:
    explicit Terminal(unsigned short columns) : master_(posix_openpt(O_RDWR | O_NOCTTY)) {
        REQUIRE(master_ >= 0);
        REQUIRE(grantpt(master_) == 0);
        REQUIRE(unlockpt(master_) == 0);
        name_ = ptsname(master_);
        slave_ = open(name_.c_str(), O_WRONLY | O_NOCTTY);
        const winsize size{.ws_row = 24, .ws_col = columns, .ws_xpixel = 0, .ws_ypixel = 0};
        REQUIRE(ioctl(slave_, TIOCSWINSZ, &size) == 0);
    }
    ~Terminal() {
        close(slave_);
        close(master_);
    }
    Terminal(const Terminal&) = delete;
    Terminal& operator=(const Terminal&) = delete;

    /// What the program writes to it; a redirection among the arguments comes first.
    std::string shows(const Workplace& place, const std::string& arguments) {
        constexpr char end = '\x1e';
        std::string seen;
        std::thread reader([&] {
            for (char c = 0; read(master_, &c, 1) == 1 && c != end;)
                if (c != '\r')
                    seen += c;
        });
        const std::string command = "cd '" + place.path("").string() +
                                    "' && { TERM=dumb '" HEMILUX_PROGRAM "' " + arguments +
                                    "; } >'" + name_ + "' 2>&1 </dev/null";
        const bool started = std::system(command.c_str()) != -1;
        const bool ended = write(slave_, &end, 1) == 1;
        reader.join();
        REQUIRE(started);
        REQUIRE(ended);
        return seen;
    }

  private:
    int master_, slave_;
    std::string name_;
};

void check_lines(const Workplace& place, const std::vector<std::string>& commands) {
    Terminal terminal(200);
    for (const std::string& arguments : commands) {
        const std::string shown = terminal.shows(place, arguments);
        CAPTURE(arguments, shown);
        CHECK_FALSE(shown.empty());
        CHECK(longest_line(shown) <= 80);
    }
}

/// A triangle in a folder whose name is longer than a line and has spaces.
std::string write_far_scene(const Workplace& place) {
    const std::string folder = "a folder with a name/" + std::string(60, 'x') + " and more";
    std::filesystem::create_directories(place.path(folder));
    place.write(folder + "/room.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n");
    return folder + "/room.obj";
}

} // namespace

TEST_CASE("prose is broken at spaces and loses no word") {
    CHECK(wrapped("one two three four", 9, 2) == "one two\n  three\n  four");
    CHECK(wrapped("one two", 7, 2) == "one two");
    CHECK(wrapped("", 7, 2).empty());
    CHECK(wrapped("one\n\ntwo three\n", 5, 1) == "one\n\ntwo\n three\n");
    CHECK(wrapped("\xc3\xa9\xc3\xa9 \xc3\xa9\xc3\xa9 a", 5, 0) ==
          "\xc3\xa9\xc3\xa9 \xc3\xa9\xc3\xa9\na");
    const std::string text = "the light of each of them differs by so much that a division helps";
    for (std::size_t width = 1; width <= text.size(); ++width) {
        CAPTURE(width);
        CHECK(words_of(wrapped(text, width, 2)) == words_of(text));
        if (width >= std::string("  division").size())
            CHECK(longest_line(wrapped(text, width, 2)) <= width);
    }
}

TEST_CASE("a value stays below the value that it continues") {
    CHECK(wrapped("open edges    4 (edges of one face)", 24, 14) ==
          "open edges    4 (edges\n              of one\n              face)");
}

TEST_CASE("numbers, options, paths and names between quotation marks are not broken") {
    const auto is_kept = [](const std::string& text, const std::string& kept) {
        CAPTURE(text);
        for (std::size_t width = 1; width < text.size(); ++width)
            CHECK_THAT(wrapped(text, width, 2), Contains(kept));
    };
    is_kept("it is off by 1 234 567 patches in all", "1 234 567 patches");
    is_kept("in 0.32 s (3.28 M rays/s) or more", "(3.28 M rays/s)");
    is_kept("with it --divide auto makes that less", "--divide auto");
    is_kept("all that is known (-v shows more of it)", "(-v shows");
    is_kept("the folder 'my own scenes' does not exist", "'my own scenes'");
    is_kept("material \"white wall\" is not there", "\"white wall\"");
    is_kept("hemilux: my own/scenes here/a.obj:3: expected a face",
            "hemilux: my own/scenes here/a.obj:3:");
    is_kept("warning: --error: was 1 % meant", "warning: --error:");
    CHECK(wrapped("the patches' own light and walls' too", 16, 0) ==
          "the patches' own\nlight and walls'\ntoo");
}

TEST_CASE("summaries have lines of at most 80 columns on a terminal", "[slow]") {
    const Workplace place;
    place.write_room();
    place.write("open.obj",
                "mtllib room.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\n"
                "usemtl white\nf 1 2 3 4\nf 1 2 3\nusemtl lamp\nf 5 6 2 1\n");
    check_lines(
        place,
        {"info room.obj", "info open.obj", "solve room.obj -o a.png --error 10% --size 16x12",
         "solve room.obj -o a.csv -v --error 9%", "solve room.obj -o a.csv --time 1e-6",
         "solve room.obj -o a.csv --max-rays 100 --error 1%",
         "solve room.obj -o a.csv --method hemisphere --steps 3 -v",
         "solve room.obj -o a.csv --for group:walls", "solve room.obj -o a.csv --sky 1 --steps 1",
         "solve open.obj -o a.csv --sides front --steps 1", "density room.obj -o a.svg",
         "formfactors room.obj -o a.csv", "density room.obj -o a.png --size 16x12",
         "compare room.obj -o b --methods hemisphere,stratified --size 16x12 -v "
         ">table.txt"});
}

TEST_CASE("a table that is too wide goes on below, without columns in which nothing is known") {
    const std::vector<std::vector<std::string>> rows{{"method", "rays", "seconds", "detail %"},
                                                     {"a", "12.3 k", "-", "1.2"},
                                                     {"other", "-", "-", "34"}};
    const std::string whole = "method    rays  seconds  detail %\n"
                              "a       12.3 k        -       1.2\n"
                              "other        -        -        34\n";
    CHECK(hemilux::aligned_for(0, rows) == whole);
    CHECK(hemilux::aligned_for(33, rows) == whole);
    CHECK(hemilux::aligned_for(32, rows) == "method    rays  detail %\n"
                                            "a       12.3 k       1.2\n"
                                            "other        -        34\n");
    const std::string narrow = "method    rays\na       12.3 k\nother        -\n\n"
                               "method  detail %\na            1.2\nother         34\n";
    CHECK(hemilux::aligned_for(23, rows) == narrow);
    CHECK(hemilux::aligned_for(1, rows) == narrow); // a column at a time, however narrow
}

TEST_CASE("the table of compare fits the terminal; a pipe gets all columns in one") {
    const Workplace place;
    place.write_room();
    const std::string command = "compare room.obj -o out --methods hemisphere,progressive-monte-"
                                "carlo --size 16x12 --runs 2 --budget-rays 3e5 -q";
    const std::string piped = place.hemilux(command).out;
    CAPTURE(piped);
    CHECK(lines_of(piped).size() == 3);
    CHECK(longest_line(piped) > 100);
    for (const std::size_t columns : {60, 80, 100, 400}) {
        Terminal terminal(static_cast<unsigned short>(columns));
        const std::string shown = terminal.shows(place, command);
        CAPTURE(columns, shown);
        CHECK(longest_line(shown) <= columns);
        CHECK((shown.find("\n\n") == std::string::npos) == (columns == 400));
        for (const char* const head : {"rays", "seconds", "error %", "detail %", "rest %",
                                       "estimated %", "estimated/error", "time gain", "ray gain"})
            CHECK_THAT(shown, Contains(head));
    }
}

TEST_CASE("errors have lines of at most 80 columns on a terminal") {
    const Workplace place;
    place.write_room();
    check_lines(place, {"", "other", "solve", "solve room.obj", "solve room.obj -o",
                        "solve room.obj -o a.txt", "solve room.obj -o a.csv --error 1",
                        "solve room.obj -o a.csv --light x", "solve room.obj -o a.csv --other",
                        "solve room.obj -o a.csv --method other", "info missing.obj",
                        "solve room.obj -o a.csv --reflectance '*=1'", "info room.mtl",
                        "solve room.obj -o a.csv --emission lamp=0"});
}

TEST_CASE("info of example scenes has lines of at most 80 columns on a terminal") {
    const Workplace place;
    Terminal terminal(80);
    for (const char* const scene :
         {"open_scene", "wall_before_crowd", "furnace_lshape", "room_1002", "cornell_box"}) {
        const std::string shown = terminal.shows(place, "info " + scenes + scene + ".obj");
        CAPTURE(shown);
        CHECK_THAT(shown, Contains("emitting materials"));
        CHECK(longest_line(shown) <= 80);
    }
}

TEST_CASE("a terminal shows the words that a pipe gets, where each message is a line") {
    const Workplace place;
    place.write_room();
    Terminal terminal(80);
    for (const char* const arguments :
         {"info room.obj", "density room.obj -o a.svg", "solve room.obj -o a.csv --light x",
          "solve room.obj -o a.txt", "solve room.obj -o a.csv --reflectance '*=2'"}) {
        const Workplace::Outcome piped = place.hemilux(arguments);
        const std::string shown = terminal.shows(place, arguments);
        CAPTURE(arguments, shown);
        CHECK(words_of(shown) == words_of(piped.out + piped.err));
    }
    CHECK(longest_line(place.hemilux("solve room.obj -o a.csv --light x").err) > 80);
    CHECK(longest_line(place.hemilux("info room.obj").out) > 80);
}

TEST_CASE("a narrow terminal gets shorter lines") {
    const Workplace place;
    place.write_room();
    Terminal terminal(50);
    CHECK(longest_line(terminal.shows(place, "info room.obj")) <= 50);
    CHECK(longest_line(terminal.shows(place, "solve room.obj -o a.csv --light x")) <= 50);
}

TEST_CASE("a terminal shows a path and the line within that file in one piece") {
    const Workplace place;
    const std::string scene = write_far_scene(place);
    Terminal terminal(80);
    CHECK_THAT(terminal.shows(place, "info '" + scene + "'"),
               Contains("hemilux: " + scene + ":4:\n  expected a vertex"));
    place.write_room();
    const std::string output = scene.substr(0, scene.rfind('/')) + "/a.csv";
    CHECK_THAT(terminal.shows(place, "solve room.obj --steps 1 -o '" + output + "'"),
               Contains("\nwrote " + output + '\n'));
    CHECK_THAT(terminal.shows(place, "solve room.obj -o '" + scene + "/a.csv'"),
               Contains("hemilux: " + scene + "/a.csv:\n"));
}

TEST_CASE("Where the error of the division was not measured, that of sampling is still said") {
    hemilux::Statistics run;
    run.steps = 2;
    run.estimated_error = run.error_division = hemilux::Statistics::unknown;
    run.error_sampling = .0191;
    CHECK_THAT(hemilux::run_text(run),
               Contains("estimated error unknown: the run ended before that of the "
                        "division was measured; sampling 1.91 %"));
    run.error_sampling = hemilux::Statistics::unknown;
    CHECK_THAT(hemilux::run_text(run),
               Contains("estimated error unknown") && !Contains("sampling"));
}
