#include "io/pictures/exr_reader.h"

#include "io/files/error.h"
#include "io/files/input_file.h"
#include "io/files/little_endian.h"
#include "io/textures/texture_files.h"

#include <glm/gtc/packing.hpp>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <optional>
#include <string_view>

namespace hemilux {
namespace {

constexpr int max_side = 1 << 20;
constexpr double max_numbers = 4e9; ///< of all channels

/// Takes parts from the front of a file's bytes. Throws InputError where they end.
class Bytes {
  public:
    Bytes(const std::string& path, std::string_view left) : path_(path), left_(left) {}

    [[noreturn]] void refuse(const std::string& what) const { throw InputError(path_, what); }
    /// Returns other bytes of the same file.
    [[nodiscard]] Bytes of(std::string_view part) const { return {path_, part}; }
    std::string_view take(std::size_t size) {
        if (size > left_.size())
            refuse("ends too soon; expected the rest of an OpenEXR picture");
        const std::string_view taken = left_.substr(0, size);
        left_.remove_prefix(size);
        return taken;
    }
    std::uint32_t word() { return word_at(take(4), 0); }
    int number() { return std::bit_cast<int>(word()); }
    /// Takes a text up to the byte 0 that ends it.
    std::string text() {
        const std::size_t end = left_.find('\0');
        if (end == std::string_view::npos)
            refuse("ends within a name; expected the rest of an OpenEXR picture");
        std::string taken(take(end));
        take(1);
        return taken;
    }

  private:
    const std::string& path_;
    std::string_view left_;
};

void read_channels(Bytes list, std::vector<ExrChannel>& channels) {
    for (std::string name = list.text(); !name.empty(); name = list.text()) {
        const std::uint32_t code = list.word();
        if (code > 2)
            list.refuse("channel " + name + " is of an unknown kind");
        list.word(); // how it was compressed
        if (list.word() != 1 || list.word() != 1)
            list.refuse("channel " + name + " is subsampled, which hemilux does not read");
        channels.push_back({name,
                            code == 0   ? ExrChannel::Kind::whole
                            : code == 1 ? ExrChannel::Kind::half
                                        : ExrChannel::Kind::number,
                            {}});
    }
}

/// Reads the header; the bytes of a chunk's offset follow it.
ExrFile read_header(Bytes& bytes) {
    constexpr std::uint32_t magic = 20000630, version = 2, long_names = 0x400;
    constexpr char zip = 3;
    if (bytes.word() != magic)
        bytes.refuse("expected an OpenEXR picture");
    const std::uint32_t found_version = bytes.word();
    if ((found_version & ~long_names) != version)
        bytes.refuse("has tiles or several parts; expected an OpenEXR picture of scan lines, as "
                     "hemilux writes it");
    ExrFile file;
    for (std::string name = bytes.text(); !name.empty(); name = bytes.text()) {
        const std::string type = bytes.text();
        const std::string_view value = bytes.take(bytes.word());
        if (name == "channels") {
            read_channels(bytes.of(value), file.channels);
        } else if (name == "compression" && value != std::string_view(&zip, 1)) {
            bytes.refuse("expected ZIP compression, as hemilux writes it");
        } else if (name == "lineOrder" && value != std::string_view("\0", 1)) {
            bytes.refuse("expected rows from above, as hemilux writes them");
        } else if (name == "dataWindow") {
            Bytes box = bytes.of(value);
            const int left = box.number(), top = box.number(), right = box.number(),
                      bottom = box.number();
            if (left != 0 || top != 0 || right < 0 || bottom < 0 || right >= max_side ||
                bottom >= max_side)
                bytes.refuse("expected a picture from 0, 0 on");
            file.width = right + 1;
            file.height = bottom + 1;
        }
    }
    if (file.width == 0 || file.channels.empty())
        bytes.refuse("has no pixels or no channels");
    return file;
}

/// Undoes what zlib followed: bytes at even places come first, each as its difference from the one
/// before.
void part_back(std::string& bytes) {
    for (std::size_t k = 1; k < bytes.size(); ++k)
        bytes[k] = static_cast<char>(static_cast<unsigned char>(bytes[k]) +
                                     static_cast<unsigned char>(bytes[k - 1]) - 128);
    const std::string parted = bytes;
    const std::size_t half = (bytes.size() + 1) / 2;
    for (std::size_t k = 0; k < bytes.size(); ++k)
        bytes[k] = parted[k % 2 == 0 ? k / 2 : half + k / 2];
}

void read_rows(const std::string& rows, int first, int end, ExrFile& file) {
    const auto columns = static_cast<std::size_t>(file.width);
    const char* at = rows.data();
    for (std::size_t y = std::size_t(first); y < std::size_t(end); ++y)
        for (ExrChannel& channel : file.channels)
            for (std::size_t x = 0; x < columns; ++x, at += channel.bytes())
                channel.bits[y * columns + x] =
                    channel.bytes() == 2 ? bits_at<std::uint16_t>(at) : bits_at<std::uint32_t>(at);
}

} // namespace

ExrFile read_exr(const std::string& path) {
    const std::string content = read_input(path, InputKind::regular);
    Bytes bytes(path, content);
    ExrFile file = read_header(bytes);
    const double numbers = double(file.width) * double(file.height) * double(file.channels.size());
    if (numbers > max_numbers)
        bytes.refuse("is too large");
    ask_for_input(path, 2 * sizeof(std::uint32_t) * numbers + double(content.size()));
    std::size_t bytes_per_row = 0;
    for (ExrChannel& channel : file.channels) {
        channel.bits.resize(std::size_t(file.width) * std::size_t(file.height));
        bytes_per_row += channel.bytes() * std::size_t(file.width);
    }
    const int chunks = (file.height + exr_rows_per_chunk - 1) / exr_rows_per_chunk;
    bytes.take(sizeof(std::uint64_t) * std::size_t(chunks));
    for (int chunk = 0; chunk < chunks; ++chunk) {
        const int first = chunk * exr_rows_per_chunk,
                  end = std::min(first + exr_rows_per_chunk, file.height);
        if (bytes.number() != first)
            bytes.refuse("expected its rows from above");
        const std::size_t size = bytes_per_row * std::size_t(end - first);
        const std::string_view packed = bytes.take(bytes.word());
        if (packed.size() == size) { // it was not shortened
            read_rows(std::string(packed), first, end, file);
            continue;
        }
        std::optional<std::string> rows = zlib_decompressed(packed, size);
        if (!rows)
            bytes.refuse("rows " + std::to_string(first) + " to " + std::to_string(end - 1) +
                         " are broken");
        part_back(*rows);
        read_rows(*rows, first, end, file);
    }
    return file;
}

Image image_of(const ExrFile& file, const std::string& layer) {
    Image image(file.width, file.height);
    for (const ExrChannel& channel : file.channels)
        for (int axis = 0; axis < 3; ++axis) {
            if (channel.name != (layer.empty() ? "" : layer + ".") + "RGB"[axis])
                continue;
            for (std::size_t k = 0; k < image.pixels.size(); ++k) {
                const std::uint32_t bits = channel.bits[k];
                image.pixels[k][axis] = channel.kind == ExrChannel::Kind::whole ? float(bits)
                                        : channel.kind == ExrChannel::Kind::half
                                            ? glm::unpackHalf1x16(std::uint16_t(bits))
                                            : std::bit_cast<float>(bits);
            }
        }
    return image;
}

} // namespace hemilux
