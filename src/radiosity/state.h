#pragma once
// A solver's state as bytes, for checkpoints: whole numbers of 32 and 64 bits and doubles by their
// bits, in little-endian order whatever the machine.

#include "geometry/vector.h"

#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

namespace hemilux {

/// Bytes that are not what the reader expects.
struct StateError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

class StateWriter {
  public:
    void add(std::uint64_t value);
    void add(std::uint32_t value);
    void add(double value);
    void add(const Vec3& value);
    void add(std::string_view text);
    template <class T>
    void add(std::span<const T> values) {
        add(std::uint64_t{values.size()});
        for (const T& value : values)
            add(value);
    }

    [[nodiscard]] const std::string& bytes() const& { return bytes_; }
    [[nodiscard]] std::string bytes() && { return std::move(bytes_); }

  private:
    std::string bytes_;
};

/// Reads in the order of writing. Every function throws StateError at the end of the bytes.
class StateReader {
  public:
    explicit StateReader(std::string_view bytes) : left_(bytes) {}

    [[nodiscard]] std::uint64_t whole();
    [[nodiscard]] double number();
    /// At most the bytes that are left are kept.
    [[nodiscard]] std::string text();
    /// A size that was written before its items, each of which takes so many bytes or more.
    [[nodiscard]] std::size_t count(std::size_t bytes_each);

    void get(std::uint64_t& value) { value = whole(); }
    void get(std::uint32_t& value);
    void get(double& value) { value = number(); }
    void get(Vec3& value);
    /// Exactly as many values as there is room for; else StateError.
    template <class T>
    void get(std::span<T> values) {
        if (whole() != values.size())
            throw StateError("the number of values is not that of the patches");
        for (T& value : values)
            get(value);
    }
    /// Throws StateError unless all has been read.
    void expect_end() const;

  private:
    std::string_view take(std::size_t bytes);
    std::string_view left_;
};

} // namespace hemilux
