#include "io/gltf/document/container.h"

#include "io/files/error.h"
#include "io/files/input_file.h"
#include "io/files/little_endian.h"
#include "io/gltf/document/json_value.h"

#include <cstdint>

namespace hemilux::gltf {
namespace {

constexpr std::string_view magic = "glTF";
constexpr std::size_t header = 12, chunk_header = 8;
constexpr std::uint32_t json_chunk = 0x4e4f534a, binary_chunk = 0x004e4942;

std::string at_byte(std::size_t at) { return "byte " + std::to_string(at) + ": "; }

/// Returns the chunk at this place of a binary file.
std::string_view chunk_at(std::string_view bytes, std::size_t at, const std::string& path) {
    const std::size_t left = bytes.size() - at - chunk_header;
    const std::uint32_t length = word_at(bytes, at);
    if (length > left)
        throw InputError(path, at_byte(at) + "expected a chunk of at most " + std::to_string(left) +
                                   " bytes, found " + std::to_string(length));
    return bytes.substr(at + chunk_header, length);
}

std::uint32_t word_at_or_0(std::string_view bytes, std::size_t at) {
    return at + 4 <= bytes.size() ? word_at(bytes, at) : 0;
}

void split_binary(Container& file, const std::string& path) {
    std::string_view bytes = file.content;
    if (bytes.size() < header + chunk_header)
        throw InputError(path, "expected a binary glTF file of at least 20 bytes, found " +
                                   std::to_string(bytes.size()));
    if (const std::uint32_t version = word_at(bytes, 4); version != 2)
        throw InputError(path, at_byte(4) + "expected version 2, found " + std::to_string(version));
    const std::uint32_t length = word_at(bytes, 8);
    if (length < header + chunk_header || length > bytes.size())
        throw InputError(path, at_byte(8) + "expected a length from 20 to " +
                                   std::to_string(bytes.size()) + ", the size of the file, found " +
                                   std::to_string(length));
    if (length < bytes.size())
        file.warning = at_byte(8) + "the file has " + std::to_string(bytes.size() - length) +
                       " bytes behind the length that it states; they are not read";
    bytes = bytes.substr(0, length);
    if (word_at(bytes, header + 4) != json_chunk)
        throw InputError(path, at_byte(header + 4) + "expected the chunk JSON");
    file.json = chunk_at(bytes, header, path);
    if (file.json.size() % 4 != 0 &&
        word_at_or_0(bytes, header + chunk_header + file.json.size() + 4) == binary_chunk)
        throw InputError(path, at_byte(header) +
                                   "expected a JSON chunk that is padded to a multiple of 4 bytes, "
                                   "found " +
                                   std::to_string(file.json.size()));
    // Chunks begin at multiples of four bytes; those of other kinds are passed over.
    for (std::size_t at = header + chunk_header + (file.json.size() + 3) / 4 * 4;
         at < bytes.size();) {
        if (bytes.size() - at < chunk_header)
            throw InputError(path, at_byte(at) + "expected a chunk of at least 8 bytes, found " +
                                       std::to_string(bytes.size() - at));
        const std::string_view chunk = chunk_at(bytes, at, path);
        if (word_at(bytes, at + 4) == binary_chunk && !file.binary)
            file.binary = chunk;
        at += chunk_header + (chunk.size() + 3) / 4 * 4;
    }
}

} // namespace

Container read_container(const std::string& path, const ReadGuard& guard) {
    const auto check = [&](std::string_view content) {
        if (guard)
            guard(static_cast<double>(content.size()));
    };
    Container file;
    file.content = read_input(path, InputKind::stream, check);
    if (std::string_view(file.content).starts_with(magic))
        split_binary(file, path);
    else
        file.json = file.content;
    if (file.json.starts_with("\xef\xbb\xbf"))
        file.json.remove_prefix(3);
    if (guard)
        guard(static_cast<double>(file.content.size()) +
              JsonDocument::bytes_per_character * static_cast<double>(file.json.size()));
    return file;
}

} // namespace hemilux::gltf
