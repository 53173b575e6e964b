#pragma once
// Numbers as bytes of a file, lowest byte first, whatever the machine's order is.

#include <glm/glm.hpp>

#include <bit>
#include <concepts>
#include <cstdint>
#include <string>
#include <string_view>

namespace hemilux {

template <std::unsigned_integral Whole>
void append_number(std::string& bytes, Whole value) {
    for (std::size_t i = 0; i < sizeof value; ++i)
        bytes += static_cast<char>(static_cast<unsigned char>(value >> (8 * i)));
}
inline void append_number(std::string& bytes, double value) {
    append_number(bytes, std::bit_cast<std::uint64_t>(value));
}
inline void append_number(std::string& bytes, float value) {
    append_number(bytes, std::bit_cast<std::uint32_t>(value));
}
/// Appends the numbers of a vector, one after the other.
template <class Number>
void append_numbers(std::string& bytes, const glm::vec<3, Number>& vector) {
    for (int axis = 0; axis < 3; ++axis)
        append_number(bytes, vector[axis]);
}

/// Returns the number whose bytes begin here.
template <std::unsigned_integral Bits>
[[nodiscard]] Bits bits_at(const char* bytes) {
    Bits value = 0;
    for (std::size_t i = 0; i < sizeof value; ++i)
        value = static_cast<Bits>(value | static_cast<Bits>(static_cast<unsigned char>(bytes[i]))
                                              << (8 * i));
    return value;
}
/// Returns the four bytes from this place on as a number.
[[nodiscard]] inline std::uint32_t word_at(std::string_view bytes, std::size_t at) {
    return bits_at<std::uint32_t>(bytes.data() + at);
}

} // namespace hemilux
