#pragma once
// FNV-1a with 64 bits (Fowler, Noll, Vo): shows any change of a single byte, and others but by a
// chance of 2^-64. No protection against somebody who means harm.

#include <cstdint>
#include <string_view>

namespace hemilux {

class Checksum {
  public:
    void add(std::string_view bytes) {
        for (const char c : bytes)
            value_ = (value_ ^ static_cast<unsigned char>(c)) * prime;
    }
    [[nodiscard]] std::uint64_t value() const { return value_; }

  private:
    static constexpr std::uint64_t prime = 0x100000001b3, offset = 0xcbf29ce484222325;
    std::uint64_t value_ = offset;
};

} // namespace hemilux
