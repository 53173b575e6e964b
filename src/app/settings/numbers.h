#pragma once
// The numbers on the command line: all of the text must be one number within its range. NaN and
// infinities are never accepted.

#include "geometry/vector.h"
#include "radiosity/answers/images/image.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hemilux {

/// A range of doubles and how a message names it.
struct NumberRange {
    double low, high;
    bool low_included = true, high_included = true;

    [[nodiscard]] bool contains(double x) const {
        return (low_included ? x >= low : x > low) && (high_included ? x <= high : x < high);
    }
    /// Returns "above 0", "from 0 to 5", "at least 0 and below 1".
    [[nodiscard]] std::string text() const;
};

inline constexpr double no_limit = 1.7976931348623157e308; ///< the largest double
inline constexpr NumberRange positive{.low = 0, .high = no_limit, .low_included = false};
inline constexpr NumberRange non_negative{.low = 0, .high = no_limit};

/// Returns the shortest text that gives back the same double.
[[nodiscard]] std::string shortest_text(double x);
[[nodiscard]] std::optional<double> parse_number(std::string_view text);
/// Reads numbers between separators; empty where one of them is no number.
[[nodiscard]] std::optional<std::vector<double>> parse_numbers(std::string_view text,
                                                               char separator);
/// Reads a whole number of decimal digits, or one with an exponent as 1e8; empty for any other
/// text.
[[nodiscard]] std::optional<std::uint64_t> parse_whole(std::string_view text);
/// Reads "r,g,b", or one number for all three; empty if a channel is missing or out of the range.
[[nodiscard]] std::optional<Vec3> parse_colour(std::string_view text, const NumberRange& range);

/// Reads a share: "2.5%" or ".025"; any finite number.
[[nodiscard]] std::optional<double> parse_share(std::string_view text);
/// Reads a time in seconds: "90", "90s", "1.5m" or "1h"; any finite number.
[[nodiscard]] std::optional<double> parse_seconds(std::string_view text);

/// An exposure: a factor, or how often the automatic one is doubled.
struct Exposure {
    std::optional<double> factor = {};
    double stops = 0;
};
/// Reads a factor above 0, or stops from -100 to 100 such as "+1.5ev".
[[nodiscard]] std::optional<Exposure> parse_exposure(std::string_view text);

/// Reads a size such as "800x600", each side from 1 to 16384.
[[nodiscard]] std::optional<PixelSize> parse_size(std::string_view text);

} // namespace hemilux
