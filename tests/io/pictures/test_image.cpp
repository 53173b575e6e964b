#include "io/files/atomic_file.h"
#include "io/files/error.h"
#include "io/pictures/exr_reader.h"
#include "io/pictures/picture_files.h"
#include "io/png_reader.h"
#include "radiosity/answers/images/image.h"
#include "support/catch.h"
#include "support/temporary_folder.h"

#include <atomic>
#include <cmath>
#include <limits>
#include <thread>

using namespace hemilux;
using namespace hemilux::test;

namespace {

/// Every row and column differs.
Image gradient(int width, int height) {
    Image image(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            image.at(x, y) = {static_cast<float>(x) / static_cast<float>(width),
                              static_cast<float>(y) / static_cast<float>(height),
                              static_cast<float>(x * y % 7) / 6};
    return image;
}

/// The pixels of an HDR file whose rows are too short for run lengths.
std::vector<glm::vec3> short_rows_of_hdr(const std::string& path, std::size_t pixels) {
    const std::string file = content_of(path);
    const std::string data = file.substr(file.size() - 4 * pixels);
    std::vector<glm::vec3> result;
    for (std::size_t i = 0; i < pixels; ++i) {
        const auto byte = [&](std::size_t k) { return static_cast<std::uint8_t>(data[4 * i + k]); };
        const float unit = byte(3) == 0 ? 0 : std::ldexp(1.0f, byte(3) - 136);
        result.push_back(unit * glm::vec3(byte(0), byte(1), byte(2)));
    }
    return result;
}

/// The CRC of a PNG chunk by division of polynomials, bit after bit from the lowest.
std::uint32_t crc_of(const std::string& bytes) {
    std::uint32_t remainder = 0xffffffff;
    for (const char c : bytes)
        for (int bit = 0; bit < 8; ++bit) {
            const bool odd = ((remainder ^ static_cast<unsigned char>(c) >> bit) & 1u) != 0;
            remainder = remainder >> 1 ^ (odd ? 0xedb88320 : 0);
        }
    return ~remainder;
}

std::uint32_t big_endian_at(const std::string& file, std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i)
        value = value << 8 | static_cast<unsigned char>(file.at(at + i));
    return value;
}

/// The contents of the chunks of a PNG, each with its type in front.
std::vector<std::string> chunks_of(const std::string& file) {
    std::vector<std::string> chunks;
    for (std::size_t at = 8; at < file.size();) {
        const std::size_t length = big_endian_at(file, at);
        chunks.push_back(file.substr(at + 4, 4 + length));
        CHECK(big_endian_at(file, at + 8 + length) == crc_of(chunks.back()));
        at += 12 + length;
    }
    return chunks;
}

} // namespace

TEST_CASE("a PNG says how it was made") {
    const TemporaryFolder folder;
    const Image image = gradient(9, 5);
    write_png(folder.path("a.png"), image, 1, {"hemilux 1", "hemilux solve k\xC3\xBC.obj\n", 42});
    const auto chunks = chunks_of(content_of(folder.path("a.png")));
    REQUIRE(chunks.size() == 6);
    CHECK(chunks[0].starts_with("IHDR"));
    CHECK(chunks[1] == std::string("tEXtSoftware\0hemilux 1", 22));
    CHECK(chunks[2] == std::string("tEXtCommand\0hemilux solve k??.obj?", 34));
    CHECK(chunks[3] == std::string("tEXtSeed\x00", 9) + "42");
    CHECK(chunks[5] == "IEND");
    write_png(folder.path("b.png"), image, 1);
    CHECK(chunks_of(content_of(folder.path("b.png"))).size() == 3);
    CHECK(read_png(folder.path("a.png")).bytes == read_png(folder.path("b.png")).bytes);
}

TEST_CASE("the header of an HDR file says how it was made") {
    const TemporaryFolder folder;
    const Image image = gradient(4, 2);
    write_hdr(folder.path("a.hdr"), image, {"hemilux 1", "hemilux solve a.obj", 42});
    CHECK_THAT(content_of(folder.path("a.hdr")),
               Catch::StartsWith("#?RADIANCE\nSOFTWARE=hemilux 1\nhemilux solve a.obj\nSEED=42\n"));
    write_hdr(folder.path("b.hdr"), image);
    CHECK(short_rows_of_hdr(folder.path("a.hdr"), 8) == short_rows_of_hdr(folder.path("b.hdr"), 8));
}

TEST_CASE("the sRGB curve has its published values") {
    CHECK(srgb_from_linear(0) == 0);
    CHECK(srgb_from_linear(1) == 1);
    CHECK(srgb_from_linear(2) == 1);
    CHECK(srgb_from_linear(-1) == 0);
    CHECK(srgb_from_linear(std::numeric_limits<float>::quiet_NaN()) == 0);
    CHECK(srgb_from_linear(0.002f) == Approx(0.02584));
    CHECK(srgb_from_linear(0.5f) == Approx(0.735357).epsilon(1e-5));
    CHECK(srgb_from_linear(0.0031308f) == Approx(srgb_from_linear(0.0031309f)).epsilon(1e-3));
}

TEST_CASE("a PNG gives back every pixel through the curve") {
    const TemporaryFolder folder;
    const Image image = gradient(37, 23);
    const double exposure = 0.5;
    write_png(folder.path("a.png"), image, exposure);
    const Png png = read_png(folder.path("a.png"));
    REQUIRE(png.width == 37);
    REQUIRE(png.height == 23);
    int wrong = 0;
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
        for (int c = 0; c < 3; ++c)
            wrong += png.bytes[3 * i + static_cast<std::size_t>(c)] !=
                     std::lround(255 * srgb_from_linear(0.5f * image.pixels[i][c]));
    CHECK(wrong == 0);
}

TEST_CASE("files that are compressed little, or in a hurry that comes at any time, are the same") {
    const TemporaryFolder folder;
    Image image = gradient(701, 503); // more than is compressed at a time
    for (int y = 200; y < 400; ++y)
        for (int x = 0; x < 701; ++x)
            image.at(x, y) = image.at(x / 6 * 6, y / 6 * 6);
    const auto png = [&](const char* name, Compression compression = Compression::usual) {
        write_png(folder.path(name), image, 1, {}, compression);
        return read_png(folder.path(name)).bytes;
    };
    const auto exr = [&](const char* name) {
        std::vector<ExrChannel> channels;
        add_exr_channels(channels, "", image);
        write_exr(folder.path(name), image.width, image.height, channels, {});
        return image_of(read_exr(folder.path(name)), "").pixels;
    };
    const auto usual = png("a.png");
    const auto light = exr("a.exr");
    CHECK(png("b.png", Compression::little) == usual);
    CHECK(content_of(folder.path("b.png")) != content_of(folder.path("a.png")));
    std::atomic<bool> hurry{false};
    compress_little_on(&hurry);
    for (int turn = 0; turn < 2; ++turn) {
        std::thread signal([&] { hurry = true; });
        CHECK(png("c.png") == usual);
        CHECK(exr("c.exr") == light);
        signal.join();
        hurry = false;
    }
    hurry = true;
    CHECK(png("d.png") == usual);
    CHECK(content_of(folder.path("d.png")) == content_of(folder.path("b.png")));
    CHECK(exr("d.exr") == light);
    compress_little_on(nullptr);
}

TEST_CASE("an HDR file keeps linear light over many decades") {
    const TemporaryFolder folder;
    Image image(4, 1); // rows below 8 pixels are not packed
    image.pixels = {{1, 0.5f, 0.25f}, {1e-6f, 2e-6f, 3e-6f}, {1e6f, 5e5f, 0}, {0, 0, 0}};
    write_hdr(folder.path("a.hdr"), image);
    const auto read = short_rows_of_hdr(folder.path("a.hdr"), 4);
    for (std::size_t i = 0; i < 4; ++i) {
        const float largest = std::max({image.pixels[i].x, image.pixels[i].y, image.pixels[i].z});
        for (int c = 0; c < 3; ++c)
            CHECK(std::abs(read[i][c] - image.pixels[i][c]) <= largest / 128);
    }
}

TEST_CASE("a picture with numbers that are none can be written") {
    const TemporaryFolder folder;
    Image image(2, 1);
    image.pixels = {glm::vec3(std::numeric_limits<float>::quiet_NaN()),
                    glm::vec3(std::numeric_limits<float>::infinity())};
    CHECK_NOTHROW(write_hdr(folder.path("a.hdr"), image));
    write_png(folder.path("a.png"), image, 1);
    CHECK(read_png(folder.path("a.png")).bytes ==
          std::vector<std::uint8_t>{0, 0, 0, 255, 255, 255});
    CHECK(auto_exposure(image) == 1);
}

TEST_CASE("exposure brings walls to .8, whatever the lamp and the background") {
    CHECK(auto_exposure(Image(10, 10)) == 1);
    Image image(20, 10);
    for (glm::vec3& pixel : image.pixels)
        pixel = glm::vec3(0.4f);
    CHECK(auto_exposure(image) == Approx(2));
    for (int i = 0; i < 9; ++i)
        image.at(i, 0) = glm::vec3(1000); // a sun over a twentieth of what is lit
    for (int i = 0; i < 20; ++i)
        image.at(i, 5) = glm::vec3(0);
    CHECK(auto_exposure(image) == Approx(2));
    for (int i = 0; i < 20; ++i)
        image.at(i, 1) = image.at(i, 2) = glm::vec3(1000); // suns over a quarter
    CHECK(auto_exposure(image) == Approx(0.8 / 4.8));
    Image emission(20, 10);
    for (std::size_t k = 0; k < image.pixels.size(); ++k)
        if (image.pixels[k].r == 1000)
            emission.pixels[k] = glm::vec3(999.999f); // that was lamps
    CHECK(auto_exposure(image, emission) == Approx(2));
    CHECK(auto_exposure(image, image) == auto_exposure(image));
}

TEST_CASE("lamps that fill the view have no part in its exposure by what they reflect") {
    Image image(20, 10), emission(20, 10);
    for (int x = 0; x < 20; ++x)
        for (int y = 0; y < 10; ++y) {
            emission.at(x, y) = glm::vec3(y < 9 ? 1.0f : 0.0f);
            image.at(x, y) = glm::vec3(y < 9 ? 1.001f : 0.4f);
        }
    CHECK(auto_exposure(image, emission) == Approx(2));
    emission.at(3, 9) = glm::vec3(0.3f); // hardly anything but lamps is left
    for (int x = 0; x < 19; ++x)
        image.at(x, 9) = glm::vec3(0);
    image.at(19, 9) = glm::vec3(0.4f);
    CHECK(auto_exposure(image, emission) == Approx(0.8 / 0.001).epsilon(1e-3));
}

TEST_CASE("a file appears complete or not at all") {
    const TemporaryFolder folder;
    const std::string path = folder.path("out.txt");
    write_atomically(path, "old");
    {
        AtomicFile file(path);
        file.write(std::string(3'000'000, 'x')); // more than the buffer
        CHECK(content_of(path) == "old");
    } // abandoned
    CHECK(content_of(path) == "old");
    write_atomically(path, "new");
    CHECK(content_of(path) == "new");
    CHECK(folder.files() == 1);
}

TEST_CASE("a link to a file stays a link") {
    const TemporaryFolder folder;
    write_atomically(folder.path("file"), "old");
    std::filesystem::create_symlink(folder.path("file"), folder.path("link"));
    write_atomically(folder.path("link"), "new");
    CHECK(std::filesystem::is_symlink(folder.path("link")));
    CHECK(content_of(folder.path("file")) == "new");
}

TEST_CASE("what cannot be written is an OutputError that names the file") {
    const TemporaryFolder folder;
    CHECK_THROWS_AS(write_png(folder.path("missing/a.png"), Image(1, 1), 1), OutputError);
    CHECK_THROWS_WITH(write_atomically(folder.path(""), "x"), Catch::Contains("is a folder"));
    if (std::filesystem::exists("/dev/full"))
        CHECK_THROWS_WITH(write_atomically("/dev/full", "x"), Catch::StartsWith("/dev/full: "));
}
