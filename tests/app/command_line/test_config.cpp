// --config FILE: options of a file, and what is said of a bad one.
#include "app/check_fails.h"
#include "app/statistics_file.h"
#include "support/catch.h"

#include <nlohmann/json.hpp>

#include <string>

using Catch::Contains;
using test::Workplace;

TEST_CASE("a run by a file of options is that by the command line") {
    const Workplace place;
    place.write_room();
    place.write("run.toml", "# common\n"
                            "steps = 2\r\n"
                            "keep-all = true\n"
                            "literal = false\n"
                            "quiet = true # hushed\n"
                            "emission = [ \"la*=8,7,6\",\n  'wh*=0.5', ]\n"
                            "[compare]\n"
                            "runs = 2\n"
                            "[solve]\n"
                            "output = \"a.csv\"\n"
                            "seed = 3\n"
                            "sun = [0, -1, 0, 2]\n"
                            "stats = \"a.json\"\n");
    REQUIRE(place.hemilux("solve room.obj --config run.toml --seed 4").code == 0);
    REQUIRE(place
                .hemilux("solve room.obj --steps 2 --keep-all -q --emission 'la*=8,7,6' "
                         "--emission 'wh*=0.5' --sun 0,-1,0,2 --seed 4 -o b.csv -o b.png "
                         "--size 8x6")
                .code == 0);
    CHECK(place.read("a.csv") == place.read("b.csv"));
    REQUIRE(
        place.hemilux("solve room.obj -o a.png --size 8x6 --config=run.toml -t2 --seed 4").code ==
        0);
    CHECK(place.read("a.png") == place.read("b.png")); // the command line in it, too

    const nlohmann::json settings = nlohmann::json::parse(place.read("a.json"))["settings"];
    CHECK(settings["seed"] == "4");
    CHECK(settings["keep-all"] == true);
    CHECK_FALSE(settings.contains("literal"));
    CHECK(settings["emission"] == nlohmann::json({"la*=8,7,6", "wh*=0.5"}));
    CHECK(settings["SCENE"] == "room.obj");
}

TEST_CASE("options of a file that contradict the command line are left out") {
    const Workplace place;
    place.write_room();
    place.write("run.toml", "max-edge = 0.25\ntwo-sided = true\nquiet = true\nsteps = 1\n");
    const auto outcome = place.hemilux("solve room.obj --config run.toml --divide=none "
                                       "--sides front -v -o a.csv --stats a.json");
    CHECK(outcome.code == 0);
    CHECK_THAT(outcome.err, Contains("step 1:"));
    CHECK(test::statistic(place.read("a.json"), "patches") == 24);
    test::check_fails(place, 1, "solve room.obj -q -v -o a.csv", "contradict each other");
}

TEST_CASE("a bad file of options ends with its line") {
    const Workplace place;
    place.write_room();
    const auto refused = [&place](const std::string& text, const std::string& message) {
        place.write("bad.toml", text);
        test::check_fails(place, 2, "solve room.obj -o a.csv --config bad.toml", message);
    };
    refused("\nstepz = 2\n", "bad.toml:2: unknown option 'stepz'; did you mean 'steps'?");
    refused("steps = 2\nerror = \"much\"\n", "bad.toml:2: error: expected an error above 0");
    refused("steps = 0\n", "bad.toml:1: steps: expected a whole number from 1");
    refused("steps = 1\nthreads = -1\n", "bad.toml:2: threads: expected a whole number from 0");
    refused("steps = two\n", "bad.toml:1: expected a number, true, false or a text in quotes");
    refused("steps = 2 3\n", "bad.toml:1: expected the end of the line, found \"3\"");
    refused("steps 2\n", "bad.toml:1: expected '=' after the name of an option");
    refused("steps = 2\nsteps = 3\n", "bad.toml:2: 'steps' is set in line 1 already");
    refused("two-sided = 1\n", "bad.toml:1: 'two-sided': expected true or false");
    refused("steps = true\n", "bad.toml:1: 'steps': expected N");
    refused("[solv]\nsteps = 1\n", "bad.toml:2: unknown subcommand 'solv'; did you mean 'solve'?");
    refused("[solve\n", "bad.toml:1: expected ']' after the name of a subcommand");
    refused("output = \"a.csv\n", "bad.toml:1: expected a text that ends with its quote");
    refused("output = [\"a.csv\"\n", "expected ',' or ']' in an array");
    refused("output = [\"a.csv\", 1]\n", "bad.toml:1: expected a text in quotes, as before it");
    refused("output = \"a\\tb\"\n", "bad.toml:1: expected \\\\ or \\\" after a backslash");
    refused(std::string("steps = 1\0", 10), "bad.toml:1: expected the end of the line");
    refused("config = \"other.toml\"\n", "bad.toml:1: unknown option 'config'");
    test::check_fails(place, 2, "solve room.obj -o a.csv --config missing.toml", "missing.toml: ");
    test::check_fails(place, 1, "solve room.obj -o a.csv --config", "--config: expected a value");
    place.write("a.toml", "steps = 1\n");
    test::check_fails(place, 1, "solve room.obj --steps-log a.toml --config a.toml", "named twice");
}
