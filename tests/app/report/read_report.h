#pragma once
// What pages of --report carry.

#include "support/catch.h"

#include <bit>
#include <cstdint>
#include <string>
#include <vector>

namespace test {

/// The text of the script element of the page that has the id; empty where there is none.
inline std::string element_of(const std::string& page, const std::string& id) {
    const std::string mark = "id=\"" + id + "\">";
    const std::size_t at = page.find("<script type=\"application/json\" " + mark) != page.npos
                               ? page.find("<script type=\"application/json\" " + mark)
                               : page.find("<script type=\"application/base64\" " + mark);
    if (at == page.npos)
        return "";
    const std::size_t begin = page.find(mark, at) + mark.size();
    return page.substr(begin, page.find("</script>", begin) - begin);
}

/// The bytes of a text in base64, by the table of RFC 4648.
inline std::string from_base64(const std::string& text) {
    const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string bytes;
    unsigned word = 0, bits = 0;
    for (const char c : text) {
        if (c == '=')
            break;
        const std::size_t digit = digits.find(c);
        REQUIRE(digit != digits.npos);
        word = word << 6 | static_cast<unsigned>(digit);
        bits += 6;
        if (bits >= 8) {
            bits -= 8;
            bytes += static_cast<char>(word >> bits & 0xff);
        }
    }
    return bytes;
}

inline std::vector<std::uint32_t> words_of(const std::string& page, const std::string& id) {
    const std::string bytes = from_base64(element_of(page, id));
    REQUIRE(bytes.size() % 4 == 0);
    std::vector<std::uint32_t> words(bytes.size() / 4);
    for (std::size_t i = 0; i < bytes.size(); ++i)
        words[i / 4] |= std::uint32_t{static_cast<unsigned char>(bytes[i])} << (8 * (i % 4));
    return words;
}

inline std::vector<float> floats_of(const std::string& page, const std::string& id) {
    std::vector<float> numbers;
    for (const std::uint32_t word : words_of(page, id))
        numbers.push_back(std::bit_cast<float>(word));
    return numbers;
}

} // namespace test
