#include "io/pictures/exr.h"

#include "io/files/atomic_file.h"
#include "io/files/little_endian.h"
#include "io/files/provenance.h"
#include "io/pictures/picture_files.h"

#include <glm/gtc/packing.hpp>

#include <algorithm>
#include <bit>

namespace hemilux {
namespace {

std::string whole(int value) {
    std::string bytes;
    append_number(bytes, static_cast<std::uint32_t>(value));
    return bytes;
}

std::string number(float value) {
    std::string bytes;
    append_number(bytes, value);
    return bytes;
}

std::string attribute(const std::string& name, const std::string& type, const std::string& value) {
    return name + '\0' + type + '\0' + whole(static_cast<int>(value.size())) + value;
}

std::string header(int width, int height, const std::vector<ExrChannel>& channels,
                   const Provenance& from) {
    constexpr int magic = 20000630, version = 2;
    const auto code_of = [](ExrChannel::Kind kind) { // of the format
        return kind == ExrChannel::Kind::whole ? 0 : kind == ExrChannel::Kind::half ? 1 : 2;
    };
    std::string list;
    for (const ExrChannel& channel : channels)
        list += channel.name + '\0' + whole(code_of(channel.kind)) + whole(0) + whole(1) +
                whole(1); // not perceptually linear; no subsampling
    const std::string box = whole(0) + whole(0) + whole(width - 1) + whole(height - 1);
    std::string text =
        whole(magic) + whole(version) + attribute("channels", "chlist", list + '\0') +
        attribute("compression", "compression", "\3") + attribute("dataWindow", "box2i", box) +
        attribute("displayWindow", "box2i", box) +
        attribute("lineOrder", "lineOrder", std::string(1, '\0')) +
        attribute("pixelAspectRatio", "float", number(1)) +
        attribute("screenWindowCenter", "v2f", number(0) + number(0)) +
        attribute("screenWindowWidth", "float", number(1));
    if (!from.program.empty())
        text += attribute("software", "string", from.program) +
                attribute("command", "string", from.command) +
                attribute("seed", "string", std::to_string(from.seed));
    return text + '\0';
}

/// Returns the bytes as the format compresses them: those at even places, then the others, each as
/// its difference from the one before. Bytes that this does not shorten are returned as they are,
/// and so are all in a hurry.
std::string compressed(const std::string& bytes) {
    if (is_in_a_hurry())
        return bytes;
    std::vector<unsigned char> parted;
    for (const std::size_t first : {0u, 1u})
        for (std::size_t k = first; k < bytes.size(); k += 2)
            parted.push_back(static_cast<unsigned char>(bytes[k]));
    for (std::size_t k = parted.size() - 1; k > 0; --k)
        parted[k] = static_cast<unsigned char>(parted[k] - parted[k - 1] + 128);
    std::string packed = zlib_compressed(std::move(parted));
    return packed.size() < bytes.size() ? packed : bytes;
}

} // namespace

void add_exr_channels(std::vector<ExrChannel>& channels, const std::string& layer,
                      const Image& image) {
    for (int axis = 0; axis < 3; ++axis) {
        ExrChannel& channel = channels.emplace_back();
        channel.name = (layer.empty() ? "" : layer + ".") + "RGB"[axis];
        for (const glm::vec3& pixel : image.pixels)
            channel.bits.push_back(std::bit_cast<std::uint32_t>(pixel[axis]));
    }
}

void add_half_exr_channels(std::vector<ExrChannel>& channels, const Image& image) {
    constexpr float largest = 65'504;
    const bool fit = std::ranges::all_of(image.pixels, [&](const glm::vec3& pixel) {
        return std::max({pixel.r, pixel.g, pixel.b}) <= largest; // false for NaN
    });
    const std::size_t first = channels.size();
    add_exr_channels(channels, "", image);
    for (std::size_t c = first; fit && c < channels.size(); ++c) {
        channels[c].kind = ExrChannel::Kind::half;
        for (std::uint32_t& bits : channels[c].bits)
            bits = glm::packHalf1x16(std::bit_cast<float>(bits));
    }
}

void write_exr(const std::string& path, int width, int height, std::vector<ExrChannel> channels,
               const Provenance& from) {
    std::ranges::sort(channels, {}, &ExrChannel::name);
    const std::string head = header(width, height, channels, from);
    const auto columns = static_cast<std::size_t>(width);
    const int chunk_count = (height + exr_rows_per_chunk - 1) / exr_rows_per_chunk;
    std::string offsets, chunks;
    const std::size_t begin = head.size() + sizeof(std::uint64_t) * std::size_t(chunk_count);
    for (int first = 0; first < height; first += exr_rows_per_chunk) {
        const int end = std::min(first + exr_rows_per_chunk, height);
        std::string rows;
        rows.reserve(std::size_t(end - first) * columns * channels.size() * sizeof(float));
        for (std::size_t y = std::size_t(first); y < std::size_t(end); ++y)
            for (const ExrChannel& channel : channels)
                for (std::size_t x = 0; x < columns; ++x) {
                    const std::uint32_t bits = channel.bits[y * columns + x];
                    if (channel.bytes() == 2)
                        append_number(rows, static_cast<std::uint16_t>(bits));
                    else
                        append_number(rows, bits);
                }
        const std::string packed = compressed(rows);
        append_number(offsets, std::uint64_t{begin + chunks.size()});
        chunks += whole(first) + whole(static_cast<int>(packed.size())) + packed;
    }
    AtomicFile file(path);
    file.write(head);
    file.write(offsets);
    file.write(chunks);
    file.commit();
}

} // namespace hemilux
