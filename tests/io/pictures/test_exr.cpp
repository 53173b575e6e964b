// .exr: an independent reader finds what was written. It knows what the format's layout page says.
#include "io/files/error.h"
#include "io/pictures/exr.h"
#include "io/png_reader.h"
#include "support/catch.h"
#include "support/temporary_folder.h"

#include <bit>
#include <cmath>
#include <cstring>
#include <map>

using namespace hemilux;
using namespace hemilux::test;

namespace {

class Bytes {
  public:
    explicit Bytes(std::string content) : content_(std::move(content)) {}
    template <class Number>
    Number take() {
        Number number;
        REQUIRE(at + sizeof number <= content_.size());
        std::memcpy(&number, content_.data() + at, sizeof number);
        at += sizeof number;
        return number;
    }
    std::string text() {
        const std::string result = content_.c_str() + at;
        at += result.size() + 1;
        return result;
    }
    std::string take(std::size_t count) {
        REQUIRE(at + count <= content_.size());
        at += count;
        return content_.substr(at - count, count);
    }
    [[nodiscard]] bool at_end() const { return at == content_.size(); }
    std::size_t at = 0;

  private:
    std::string content_;
};

struct Exr {
    std::map<std::string, std::string> attributes;
    std::vector<std::pair<std::string, std::int32_t>> types; ///< of channels, in the file's order
    std::map<std::string, std::vector<std::uint32_t>> channels;
};

std::string unpacked(const std::string& packed, std::size_t size) {
    if (packed.size() == size)
        return packed;
    std::vector<std::uint8_t> parted = unzipped({packed.begin(), packed.end()});
    REQUIRE(parted.size() == size);
    std::string bytes(size, '\0');
    for (std::size_t k = 1; k < size; ++k)
        parted[k] = static_cast<std::uint8_t>(parted[k] + parted[k - 1] - 128);
    for (std::size_t k = 0; k < size; ++k)
        bytes[k] = static_cast<char>(parted[k / 2 + (k % 2 == 0 ? 0 : (size + 1) / 2)]);
    return bytes;
}

Exr read_exr(const std::string& path, std::size_t width, std::size_t height) {
    Bytes file(content_of(path));
    CHECK(file.take<std::uint32_t>() == 20000630);
    CHECK(file.take<std::uint32_t>() == 2);
    Exr exr;
    for (std::string name = file.text(); !name.empty(); name = file.text()) {
        name += ":" + file.text();
        exr.attributes[name] = file.take(file.take<std::uint32_t>());
    }
    Bytes list(exr.attributes.at("channels:chlist"));
    for (std::string name = list.text(); !name.empty(); name = list.text()) {
        exr.types.emplace_back(name, list.take<std::int32_t>());
        CHECK(list.take<std::uint32_t>() == 0);
        CHECK(list.take<std::uint32_t>() == 1);
        CHECK(list.take<std::uint32_t>() == 1);
    }
    std::vector<std::uint64_t> offsets;
    for (std::size_t y = 0; y < height; y += 16)
        offsets.push_back(file.take<std::uint64_t>());
    for (std::size_t y = 0; y < height; y += 16) {
        CHECK(file.at == offsets[y / 16]);
        CHECK(file.take<std::uint32_t>() == y);
        const std::size_t rows = std::min<std::size_t>(16, height - y);
        std::size_t pixel_bytes = 0;
        for (const auto& [name, type] : exr.types)
            pixel_bytes += type == 1 ? 2 : 4;
        Bytes chunk(unpacked(file.take(file.take<std::uint32_t>()), rows * width * pixel_bytes));
        for (std::size_t row = 0; row < rows; ++row)
            for (const auto& [name, type] : exr.types)
                for (std::size_t x = 0; x < width; ++x)
                    exr.channels[name].push_back(type == 1 ? chunk.take<std::uint16_t>()
                                                           : chunk.take<std::uint32_t>());
        CHECK(chunk.at_end());
    }
    CHECK(file.at_end());
    return exr;
}

} // namespace

TEST_CASE("an .exr file has all channels to the last bit") {
    const auto width = GENERATE(1, 7, 40);
    const int height = 35; // two whole chunks and a part
    const std::size_t pixels = std::size_t(width) * height;
    Image image(width, height);
    std::vector<std::uint32_t> patches;
    for (std::size_t k = 0; k < pixels; ++k) {
        const auto x = static_cast<float>(k);
        image.pixels[k] = {x / 3, 1e-20f * x, -1e20f * x};
        patches.push_back(k % 5 == 0 ? 0xffffffffu : 2654435761u * std::uint32_t(k)); // hardly zips
    }
    std::vector<ExrChannel> channels{{"patch", ExrChannel::Kind::whole, patches}};
    add_exr_channels(channels, "", image);
    add_exr_channels(channels, "error", image);
    const TemporaryFolder folder;
    write_exr(folder.path("a.exr"), width, height, channels, {"hemilux 7", "hemilux solve a", 3});
    const Exr exr = read_exr(folder.path("a.exr"), std::size_t(width), std::size_t(height));
    // Sorted by name, which readers demand; 0 is a whole number, 2 a float.
    CHECK(exr.types == std::vector<std::pair<std::string, std::int32_t>>{{"B", 2},
                                                                         {"G", 2},
                                                                         {"R", 2},
                                                                         {"error.B", 2},
                                                                         {"error.G", 2},
                                                                         {"error.R", 2},
                                                                         {"patch", 0}});
    CHECK((exr.channels.at("patch") == patches));
    bool same = true;
    for (std::size_t k = 0; k < pixels; ++k)
        for (int axis = 0; axis < 3; ++axis)
            for (const char* const layer : {"", "error."})
                same = same && exr.channels.at(std::string(layer) + "RGB"[axis])[k] ==
                                   std::bit_cast<std::uint32_t>(image.pixels[k][axis]);
    CHECK(same);
    CHECK(exr.attributes.at("command:string") == "hemilux solve a");
    CHECK(exr.attributes.at("software:string") == "hemilux 7");
    CHECK(exr.attributes.at("seed:string") == "3");
    CHECK_THROWS_AS(write_exr(folder.path("no/a.exr"), width, height, channels), OutputError);
}

TEST_CASE("light of 16 bits is right to 0.05 %, and of 32 where it is too bright for these") {
    Image image(40, 17);
    for (std::size_t k = 0; k < image.pixels.size(); ++k)
        image.pixels[k] = glm::vec3(1, .01f, 60) * (1 + .37f * static_cast<float>(k));
    const TemporaryFolder folder;
    const auto written = [&] {
        std::vector<ExrChannel> channels;
        add_half_exr_channels(channels, image);
        write_exr(folder.path("a.exr"), 40, 17, channels);
        return read_exr(folder.path("a.exr"), 40, 17);
    };
    const Exr exr = written();
    for (const auto& [name, type] : exr.types)
        CHECK(type == 1);
    for (std::size_t k = 0; k < image.pixels.size(); k += 50)
        for (int axis = 0; axis < 3; ++axis) {
            // Five bits of exponent, ten of fraction.
            const std::uint32_t half = exr.channels.at(std::string(1, "RGB"[axis]))[k];
            const double value =
                std::ldexp(1 + (half & 1023) / 1024., static_cast<int>(half >> 10) - 15);
            CHECK(value == Approx(image.pixels[k][axis]).epsilon(5e-4));
        }
    image.pixels[3].g = 1e5f;
    for (const auto& [name, type] : written().types)
        CHECK(type == 2);
}
