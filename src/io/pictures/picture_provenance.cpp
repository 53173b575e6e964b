#include "io/pictures/picture_provenance.h"

#include "io/files/provenance.h"

#include <algorithm>
#include <fstream>
#include <string_view>

namespace hemilux {
namespace {

/// Computes the CRC-32 of ISO 3309, as PNG has it, bit by bit, as the texts are short.
std::uint32_t crc32(std::string_view bytes) {
    std::uint32_t crc = ~0u;
    for (const char c : bytes) {
        crc ^= static_cast<unsigned char>(c);
        for (int bit = 0; bit < 8; ++bit)
            crc = crc >> 1 ^ ((crc & 1u) != 0 ? 0xedb88320u : 0u);
    }
    return ~crc;
}

std::string big_endian(std::uint32_t value) {
    std::string bytes;
    for (int shift = 24; shift >= 0; shift -= 8)
        bytes += static_cast<char>(static_cast<unsigned char>(value >> shift));
    return bytes;
}

/// Returns the text as one line of ASCII, with '?' for other letters.
std::string plain_line(std::string text) {
    std::ranges::replace_if(
        text, [](char c) { return c < ' ' || c > '~'; }, '?');
    return text;
}

std::string text_chunk(std::string_view keyword, const std::string& text) {
    std::string content("tEXt");
    content += keyword;
    content += '\0';
    content += plain_line(text);
    return big_endian(static_cast<std::uint32_t>(content.size() - 4)) + content +
           big_endian(crc32(content));
}

} // namespace

void add_to_png(std::string& file, const Provenance& from) {
    constexpr std::size_t signature = 8, header_chunk = 25;
    if (!from.program.empty())
        file.insert(signature + header_chunk, text_chunk("Software", from.program) +
                                                  text_chunk("Command", from.command) +
                                                  text_chunk("Seed", std::to_string(from.seed)));
}

std::string as_written(const std::string& command) { return plain_line(command); }

std::string command_of_png(const std::string& path) {
    constexpr std::size_t longest = 1 << 16; // of the header and the texts after it
    std::ifstream file(path, std::ios::binary);
    std::string start(longest, '\0');
    file.read(start.data(), std::streamsize(longest));
    start.resize(std::size_t(file.gcount()));
    constexpr std::string_view signature("\x89PNG\r\n\x1a\n"), chunk("tEXtCommand\0", 12);
    const std::size_t at = start.find(chunk);
    if (!start.starts_with(signature) || at == std::string::npos || at < 4)
        return {};
    std::size_t length = 0;
    for (std::size_t k = at - 4; k < at; ++k)
        length = length << 8 | static_cast<unsigned char>(start[k]);
    constexpr std::size_t keyword = 8;
    return length < keyword ? std::string() : start.substr(at + chunk.size(), length - keyword);
}

void add_to_hdr(std::string& file, const Provenance& from) {
    if (!from.program.empty())
        file.insert(file.find('\n') + 1, "SOFTWARE=" + plain_line(from.program) + "\n" +
                                             plain_line(from.command) +
                                             "\nSEED=" + std::to_string(from.seed) + "\n");
}

} // namespace hemilux
