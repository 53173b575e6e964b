#pragma once
// Figures and lists as people read them.

#include "geometry/vector.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace hemilux {

/// Formats like printf into a std::string.
[[nodiscard, gnu::format(printf, 1, 2)]] std::string formatted(const char* format, ...);
/// Returns a number rounded to so many decimals, without zeros at its end: 1.25, -3, 0.
[[nodiscard]] std::string rounded_text(double number, int decimals);
/// Returns a count as 999, 12.3 k, 4.56 M or 7.89 G.
[[nodiscard]] std::string short_count(double count);
/// Returns a whole number with its digits in groups of three, as 1 234 567.
[[nodiscard]] std::string grouped(std::uint64_t count);
/// Returns a duration as 1.2 ms, 0.42 s, 12.3 s, 3:05 or 1:02:03.
[[nodiscard]] std::string duration(double seconds);
/// Returns an amount of memory as 800 bytes, 12.3 kB or 4.56 MB.
[[nodiscard]] std::string byte_size(std::uint64_t bytes);
/// Returns a ratio as 2.31 %, or "unknown" for NaN.
[[nodiscard]] std::string percent(double share);
/// Returns a number with its noun: "1 patch", "2 patches".
[[nodiscard]] std::string counted(std::uint64_t count, const std::string& one,
                                  const std::string& many);
/// Returns the same with the number as by short_count(): "1 ray", "12.3 k rays".
[[nodiscard]] std::string short_counted(std::uint64_t count, const std::string& one,
                                        const std::string& many);
/// Returns a list such as "a, b, c and 5 more".
[[nodiscard]] std::string list_names(std::span<const std::string> names, std::size_t most = 8);

} // namespace hemilux
