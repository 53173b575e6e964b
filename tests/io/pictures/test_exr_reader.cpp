// Pictures of many layers come back as they were written; broken ones are refused.
#include "io/files/error.h"
#include "io/pictures/exr_reader.h"
#include "io/png_reader.h"
#include "support/catch.h"
#include "support/temporary_folder.h"

#include <cmath>
#include <fstream>
#include <random>

using namespace hemilux;
using namespace hemilux::test;

namespace {

Image picture(int width, int height, float scale) {
    Image image(width, height);
    for (std::size_t k = 0; k < image.pixels.size(); ++k)
        image.pixels[k] = {scale * float(k), scale / float(k + 1), scale * float(k % 7)};
    return image;
}

void write_bytes(const std::string& path, const std::string& bytes) {
    std::ofstream(path, std::ios::binary) << bytes;
}

} // namespace

TEST_CASE("layers that were written are read, in single and in half precision") {
    const auto [width, height] = GENERATE(std::pair(1, 1), std::pair(37, 16), std::pair(20, 50));
    const TemporaryFolder folder;
    const Image whole = picture(width, height, .5f), lamp = picture(width, height, .25f);
    std::vector<ExrChannel> channels;
    add_half_exr_channels(channels, whole);
    add_exr_channels(channels, "a lamp", lamp);
    std::vector<std::uint32_t> numbers(whole.pixels.size(), 4'000'000'000u);
    channels.push_back({"patch", ExrChannel::Kind::whole, numbers});
    write_exr(folder.path("a.exr"), width, height, channels);
    const ExrFile file = read_exr(folder.path("a.exr"));
    CHECK(file.width == width);
    CHECK(file.height == height);
    CHECK(file.channels.size() == 7);
    CHECK(image_of(file, "a lamp").pixels == lamp.pixels);
    const Image half = image_of(file, "");
    for (std::size_t k = 0; k < half.pixels.size(); ++k)
        for (int c = 0; c < 3; ++c)
            CHECK(std::abs(half.pixels[k][c] - whole.pixels[k][c]) <=
                  5e-4f * whole.pixels[k][c] + 1e-7f);
    CHECK(image_of(file, "none").pixels == Image(width, height).pixels);
}

TEST_CASE("a broken picture is refused, wherever it breaks off and whatever is changed") {
    const TemporaryFolder folder;
    std::vector<ExrChannel> channels;
    add_exr_channels(channels, "", picture(40, 40, 1));
    write_exr(folder.path("a.exr"), 40, 40, channels);
    const std::string bytes = content_of(folder.path("a.exr"));
    for (std::size_t size = 0; size < bytes.size(); size += size < 600 ? 1 : 97) {
        write_bytes(folder.path("b.exr"), bytes.substr(0, size));
        CHECK_THROWS_AS(read_exr(folder.path("b.exr")), InputError);
    }
    std::mt19937 random(5);
    for (int run = 0; run < 2000; ++run) { // which may be read or refused, no more
        std::string changed = bytes;
        const std::size_t range = run % 2 == 0 ? 400 : changed.size();
        changed[random() % range] = static_cast<char>(random());
        write_bytes(folder.path("b.exr"), changed);
        try {
            (void)read_exr(folder.path("b.exr"));
        } catch (const InputError&) {
        }
    }
    write_bytes(folder.path("b.exr"), "no picture at all");
    CHECK_THROWS_WITH(read_exr(folder.path("b.exr")), Catch::Contains("expected an OpenEXR"));
}
