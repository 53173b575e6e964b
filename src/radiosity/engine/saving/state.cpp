#include "radiosity/engine/saving/state.h"

#include <array>
#include <bit>

namespace hemilux {
namespace {

/// Appends a whole number, the least byte first.
template <class Whole>
void append_whole(Whole value, std::string& to) {
    std::array<char, sizeof(Whole)> bytes;
    for (std::size_t i = 0; i < bytes.size(); ++i)
        bytes[i] = static_cast<char>(value >> (8 * i) & 0xff);
    to.append(bytes.data(), bytes.size());
}

template <class Whole>
Whole from_bytes(std::string_view bytes) {
    Whole value = 0;
    for (std::size_t i = 0; i < bytes.size(); ++i)
        value |= Whole{static_cast<unsigned char>(bytes[i])} << (8 * i);
    return value;
}

} // namespace

void StateWriter::add(std::uint64_t value) { append_whole(value, bytes_); }

void StateWriter::add(std::uint32_t value) { append_whole(value, bytes_); }

void StateWriter::add(double value) { add(std::bit_cast<std::uint64_t>(value)); }

void StateWriter::add(const Vec3& value) {
    for (int c = 0; c < 3; ++c)
        add(value[c]);
}

void StateWriter::add(std::string_view text) {
    add(std::uint64_t{text.size()});
    bytes_ += text;
}

std::string_view StateReader::take(std::size_t bytes) {
    if (bytes > left_.size())
        throw StateError("it ends too soon");
    const std::string_view taken = left_.substr(0, bytes);
    left_.remove_prefix(bytes);
    return taken;
}

std::uint64_t StateReader::whole() {
    return from_bytes<std::uint64_t>(take(sizeof(std::uint64_t)));
}

void StateReader::get(std::uint32_t& value) {
    value = from_bytes<std::uint32_t>(take(sizeof(std::uint32_t)));
}

double StateReader::number() { return std::bit_cast<double>(whole()); }

double StateReader::number(const Bounds& bounds) {
    const double value = number();
    if (!(value >= bounds.least && value <= bounds.most))
        throw StateError("a number in it is not finite, or out of its range");
    return value;
}

std::uint64_t StateReader::whole_up_to(std::uint64_t most) {
    const std::uint64_t value = whole();
    if (value > most)
        throw StateError("a whole number in it is too large");
    return value;
}

std::string StateReader::text() { return std::string(take(count(1))); }

std::size_t StateReader::count(std::size_t bytes_each) {
    const std::uint64_t size = whole();
    if (size > left_.size() / bytes_each)
        throw StateError("it ends too soon");
    return size;
}

void StateReader::get(Vec3& value, const Bounds& bounds) {
    for (int c = 0; c < 3; ++c)
        value[c] = number(bounds);
}

void StateReader::expect_end() const {
    if (!left_.empty())
        throw StateError("something follows its end");
}

} // namespace hemilux
