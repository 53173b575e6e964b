#include "radiosity/state.h"

#include <bit>

namespace hemilux {
namespace {

constexpr std::size_t word = sizeof(std::uint64_t);

} // namespace

void StateWriter::add(std::uint64_t value) {
    for (std::size_t i = 0; i < word; ++i)
        bytes_.push_back(static_cast<char>(value >> (8 * i) & 0xff));
}

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
    const std::string_view bytes = take(word);
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < word; ++i)
        value |= std::uint64_t{static_cast<unsigned char>(bytes[i])} << (8 * i);
    return value;
}

double StateReader::number() { return std::bit_cast<double>(whole()); }

std::string StateReader::text() { return std::string(take(count(1))); }

std::size_t StateReader::count(std::size_t bytes_each) {
    const std::uint64_t size = whole();
    if (size > left_.size() / bytes_each)
        throw StateError("it ends too soon");
    return size;
}

void StateReader::get(Vec3& value) {
    for (int c = 0; c < 3; ++c)
        value[c] = number();
}

void StateReader::expect_end() const {
    if (!left_.empty())
        throw StateError("something follows its end");
}

} // namespace hemilux
