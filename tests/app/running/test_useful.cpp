// --useful: a run ends once its picture looks as the one without noise would.
#include "app/check_fails.h"
#include "app/program.h"
#include "app/split.h"
#include "io/png_reader.h"
#include "radiosity/answers/images/ssim.h"
#include "support/catch.h"

#include <string>

using namespace test;
using namespace hemilux;

namespace {

/// A room whose patches are small in the picture, so that their noise shows.
const std::string room = HEMILUX_SOURCE_DIR "/examples/scenes/room_1002.obj -q ";
const std::string view = "--exposure .25 --size 640x480 "
                         "--camera 5,2.1,3.666667,0.250476,1.19353,1.69935,60 ";

LumaPicture picture(const Workplace& place, const std::string& name) {
    const hemilux::test::Png png = hemilux::test::read_png(place.path(name));
    return luma_of(png.width, png.height, png.bytes);
}

} // namespace

TEST_CASE("--useful ends a run once its picture is alike to the one without noise") {
    const Workplace place;
    REQUIRE(
        place.hemilux("solve " + room + view + "--divide none --no-gather --error .5% -o best.png")
            .code == 0);
    const std::string method = GENERATE("progressive-monte-carlo", "hemisphere");
    const std::string solve = "solve " + room + view + "--rays 1 --method " + method + " ";
    REQUIRE(place.hemilux(solve + "--useful -o useful.png --steps-log steps.csv").code == 0);
    const std::size_t steps = split(place.read("steps.csv"), ',').size() - 1;
    CHECK(steps > 2);
    CHECK(steps < 10);
    const LumaPicture best = picture(place, "best.png");
    CHECK(ssim(picture(place, "useful.png"), best) > .94);
    // It ends no later than it must, and alike for any number of threads.
    REQUIRE(place.hemilux(solve + "--steps 2 --no-gather -o before.png").code == 0);
    CHECK(ssim(picture(place, "before.png"), best) < ssim(picture(place, "useful.png"), best));
    REQUIRE(place.hemilux(solve + "--useful -t 3 -o again.png").code == 0);
    CHECK(place.read("again.png") == place.read("useful.png"));
    REQUIRE(place.hemilux(solve + "--useful --steps 2 -o less.png").code == 0);
    CHECK(picture(place, "less.png").values == picture(place, "before.png").values);
}

TEST_CASE("--useful needs a method that knows its error") {
    const Workplace place;
    place.write_room();
    check_fails(place, 1, "solve room.obj --method matrix --factors hemicube --useful -o a.png",
                "--useful");
}
