#pragma once
// Writes and reads a solver's state as bytes, for checkpoints. Whole numbers have 32 and 64 bits,
// and doubles are stored by their bits, in little-endian order whatever the machine.

#include "geometry/vector.h"

#include <cstdint>
#include <limits>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

namespace hemilux {

/// The error thrown for bytes that are not what the reader expects.
struct StateError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// The range that a number of a state must be in. NaN is in none.
struct Bounds {
    double least, most;
};
namespace bounds {
inline constexpr double largest = std::numeric_limits<double>::max();
inline constexpr Bounds finite{-largest, largest}, non_negative{0, largest};
} // namespace bounds

class StateWriter {
  public:
    void add(std::uint64_t value);
    void add(std::uint32_t value);
    void add(double value);
    void add(const Vec3& value);
    void add(std::string_view text);
    /// Appends what another writer has made, as it is.
    void append(std::string_view bytes) { bytes_ += bytes; }
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
    /// Reads a number within the bounds; else throws StateError.
    [[nodiscard]] double number(const Bounds& bounds);
    /// Reads a whole number of at most `most`; else throws StateError.
    [[nodiscard]] std::uint64_t whole_up_to(std::uint64_t most);
    [[nodiscard]] bool flag() { return whole_up_to(1) != 0; }
    /// Reads a text. Its length is checked before memory is taken.
    [[nodiscard]] std::string text();
    /// Reads a size that was written before its items. Throws StateError unless there are
    /// `bytes_each` bytes left for each.
    [[nodiscard]] std::size_t count(std::size_t bytes_each);

    void get(std::uint64_t& value) { value = whole(); }
    void get(std::uint32_t& value);
    void get(double& value) { value = number(); }
    void get(double& value, const Bounds& bounds) { value = number(bounds); }
    void get(Vec3& value, const Bounds& bounds);
    /// Reads exactly as many values as the span has; else throws StateError.
    template <class T>
    void get(std::span<T> values) {
        if (whole() != values.size())
            throw StateError("the number of values is not that of the patches");
        for (T& value : values)
            get(value);
    }
    /// Does the same for numbers that are all within the bounds.
    template <class T>
    void get(std::span<T> values, const Bounds& bounds) {
        if (whole() != values.size())
            throw StateError("the number of values is not that of the patches");
        for (T& value : values)
            get(value, bounds);
    }
    /// Throws StateError unless all has been read.
    void expect_end() const;

  private:
    std::string_view take(std::size_t bytes);
    std::string_view left_;
};

} // namespace hemilux
