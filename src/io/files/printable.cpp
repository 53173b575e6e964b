#include "io/files/printable.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace hemilux {
namespace {

constexpr std::string_view replacement = "\xef\xbf\xbd"; // U+FFFD

struct CodePoint {
    std::uint32_t value = 0;
    std::size_t bytes = 0; ///< 0: not valid UTF-8
};

/// Returns the first code point of a text that is not empty. A longer form than needed and a
/// surrogate are not valid (RFC 3629).
CodePoint first_of(std::string_view text) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    if (byte(0) < 0x80)
        return {byte(0), 1};
    const std::size_t bytes = byte(0) >= 0xf0 ? 4 : byte(0) >= 0xe0 ? 3 : 2;
    if (byte(0) < 0xc2 || byte(0) > 0xf4 || text.size() < bytes)
        return {};
    std::uint32_t value = byte(0) & (0x7fu >> bytes);
    for (std::size_t i = 1; i < bytes; ++i) {
        if ((byte(i) & 0xc0u) != 0x80)
            return {};
        value = value << 6 | (byte(i) & 0x3fu);
    }
    constexpr std::array<std::uint32_t, 5> least{0, 0, 0x80, 0x800, 0x10000};
    const bool is_surrogate = value >= 0xd800 && value < 0xe000;
    if (value < least.at(bytes) || value > 0x10ffff || is_surrogate)
        return {};
    return {value, bytes};
}

bool is_within(std::uint32_t c, std::uint32_t first, std::uint32_t last) {
    return c >= first && c <= last;
}

bool is_printable(std::uint32_t c) {
    if (c == '\n' || c == '\t')
        return true;
    const bool control = c < 0x20 || is_within(c, 0x7f, 0x9f);
    const bool line_end = is_within(c, 0x2028, 0x2029);
    const bool direction = is_within(c, 0x202a, 0x202e) || is_within(c, 0x2066, 0x2069) ||
                           is_within(c, 0x200e, 0x200f) || c == 0x61c;
    const bool no_character = (c & 0xfffe) == 0xfffe || is_within(c, 0xfdd0, 0xfdef);
    return !control && !line_end && !direction && !no_character;
}

/// Returns `at`, or the beginning of the character that it would cut.
std::size_t character_begin(std::string_view text, std::size_t at) {
    while (at > 0 && (static_cast<unsigned char>(text[at]) & 0xc0u) == 0x80)
        --at;
    return at;
}

} // namespace

std::string printable(std::string_view text) {
    std::string result;
    result.reserve(text.size());
    while (!text.empty()) {
        const CodePoint first = first_of(text);
        const std::size_t bytes = std::max<std::size_t>(first.bytes, 1);
        result +=
            first.bytes > 0 && is_printable(first.value) ? text.substr(0, bytes) : replacement;
        text.remove_prefix(bytes);
    }
    return result;
}

std::string single_line(std::string_view text) {
    std::string result;
    for (const char c : text)
        if (static_cast<unsigned char>(c) < ' ' || c == '\x7f')
            result += replacement;
        else
            result += c;
    return result;
}

std::string printable_message(std::string_view text) {
    constexpr std::size_t longest = 1000, of_end = 300;
    constexpr std::string_view left_out = " ... ";
    const std::string clean = printable(text);
    std::string result;
    for (std::string_view rest = clean;;) {
        const std::string_view line = rest.substr(0, rest.find('\n'));
        if (line.size() <= longest) {
            result += line;
        } else {
            result += line.substr(0, character_begin(line, longest - of_end - left_out.size()));
            result += left_out;
            result += line.substr(character_begin(line, line.size() - of_end));
        }
        if (line.size() == rest.size())
            return result;
        result += '\n';
        rest.remove_prefix(line.size() + 1);
    }
}

} // namespace hemilux
