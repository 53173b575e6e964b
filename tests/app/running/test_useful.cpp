// --useful: a run ends once its picture looks as the one without noise would.
#include "app/check_fails.h"
#include "app/program.h"
#include "app/split.h"
#include "io/pictures/ssim.h"
#include "io/png_reader.h"
#include "support/catch.h"

#include <string>

using namespace test;
using namespace hemilux;

namespace {

const std::string view = "--max-edge .1 --exposure 1 --size 160x120 " + camera_in_room;

LumaPicture picture(const Workplace& place, const std::string& name) {
    const hemilux::test::Png png = hemilux::test::read_png(place.path(name));
    return luma_of(png.width, png.height, png.bytes);
}

} // namespace

TEST_CASE("--useful ends a run once its picture is alike to the one without noise") {
    const Workplace place;
    place.write_room();
    REQUIRE(place.hemilux("solve room.obj -q --no-gather --error .5% -o best.png " + view).code ==
            0);
    const std::string few_rays =
        GENERATE("--method progressive-monte-carlo --rays 1 ", "--method hemisphere --rays 1 ");
    const std::string solve = "solve room.obj -q " + few_rays + view;
    REQUIRE(place.hemilux(solve + "--useful -o useful.png --steps-log steps.csv").code == 0);
    REQUIRE(place.hemilux(solve + "--steps 2 --no-gather -o first.png").code == 0);
    const LumaPicture best = picture(place, "best.png");
    CHECK(ssim(picture(place, "first.png"), best) < .9);
    CHECK(ssim(picture(place, "useful.png"), best) > .93);
    const std::size_t steps = split(place.read("steps.csv"), ',').size() - 1;
    CHECK(steps > 2);
    CHECK(steps < 1000);
    // One step less is not useful yet, whatever the number of threads.
    REQUIRE(place.hemilux(solve + "--useful -t 3 -o again.png").code == 0);
    CHECK(place.read("again.png") == place.read("useful.png"));
    const std::string before = std::to_string(steps - 1);
    REQUIRE(place.hemilux(solve + "--useful --steps " + before + " -o less.png").code == 0);
    CHECK(place.read("less.png") != place.read("useful.png"));
}

TEST_CASE("--useful needs a method that knows its error") {
    const Workplace place;
    place.write_room();
    check_fails(place, 1, "solve room.obj --method matrix --factors hemicube --useful -o a.png",
                "--useful");
}
