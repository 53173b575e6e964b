#include "app/settings/numbers.h"

#include "io/files/text_words.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <utility>

namespace hemilux {

namespace {

constexpr std::uint64_t largest_side = 16384;

template <class T>
std::optional<T> parse(std::string_view text) {
    T value{};
    const char* const end = text.data() + text.size();
    const auto [stopped, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc() || stopped != end)
        return std::nullopt;
    return value;
}

} // namespace

std::string shortest_text(double x) {
    std::array<char, 32> buffer;
    const auto end = std::to_chars(buffer.begin(), buffer.end(), x).ptr;
    return {buffer.begin(), end};
}

std::string NumberRange::text() const {
    std::string above = (low_included ? "at least " : "above ") + shortest_text(low);
    if (high == no_limit)
        return above;
    if (low_included && high_included)
        return "from " + shortest_text(low) + " to " + shortest_text(high);
    return above + (high_included ? " and at most " : " and below ") + shortest_text(high);
}

std::optional<double> parse_number(std::string_view text) {
    const std::optional<double> value = parse<double>(text);
    return value && std::isfinite(*value) ? value : std::nullopt;
}

std::optional<std::uint64_t> parse_whole(std::string_view text) {
    constexpr double max_exact = 1ull << 53; // beyond, a double may stand for another number
    if (const auto digits = parse<std::uint64_t>(text))
        return digits;
    const std::optional<double> value = parse_number(text);
    if (text.find('e') == std::string_view::npos || text.starts_with('-') || !value ||
        *value > max_exact || *value != std::floor(*value))
        return std::nullopt;
    return static_cast<std::uint64_t>(*value);
}

std::optional<std::vector<double>> parse_numbers(std::string_view text, char separator) {
    std::vector<double> numbers;
    for (const std::string_view part : parts_of(text, separator)) {
        const std::optional<double> number = parse_number(part);
        if (!number)
            return std::nullopt;
        numbers.push_back(*number);
    }
    return numbers;
}

std::optional<Vec3> parse_colour(std::string_view text, const NumberRange& range) {
    const auto numbers = parse_numbers(text, ',');
    if (!numbers || !std::ranges::all_of(*numbers, [&](double x) { return range.contains(x); }))
        return std::nullopt;
    const std::vector<double>& x = *numbers;
    if (x.size() == 1)
        return Vec3(x[0]);
    return x.size() == 3 ? std::optional(Vec3(x[0], x[1], x[2])) : std::nullopt;
}

std::optional<double> parse_share(std::string_view text) {
    const bool in_hundredths = text.ends_with('%');
    if (in_hundredths)
        text.remove_suffix(1);
    const std::optional<double> value = parse_number(text);
    return value && in_hundredths ? *value / 100 : value;
}

std::optional<double> parse_seconds(std::string_view text) {
    static constexpr auto units =
        std::to_array<std::pair<char, double>>({{'s', 1}, {'m', 60}, {'h', 3600}});
    double unit = 1;
    for (const auto& [letter, seconds] : units)
        if (text.ends_with(letter)) {
            unit = seconds;
            text.remove_suffix(1);
            break;
        }
    const std::optional<double> value = parse_number(text);
    return value && std::isfinite(unit * *value) ? std::optional(unit * *value) : std::nullopt;
}

std::optional<Exposure> parse_exposure(std::string_view text) {
    constexpr NumberRange stops{.low = -100, .high = 100};
    const bool in_stops = text.ends_with("ev") || text.ends_with("EV");
    if (in_stops)
        text.remove_suffix(2);
    if (in_stops && text.starts_with('+') && !text.starts_with("+-"))
        text.remove_prefix(1);
    const std::optional<double> value = parse_number(text);
    if (!value || !(in_stops ? stops : positive).contains(*value))
        return std::nullopt;
    return in_stops ? Exposure{.stops = *value} : Exposure{.factor = *value};
}

std::optional<PixelSize> parse_size(std::string_view text) {
    const std::size_t cross = text.find('x');
    if (cross == std::string_view::npos)
        return std::nullopt;
    const auto width = parse_whole(text.substr(0, cross));
    const auto height = parse_whole(text.substr(cross + 1));
    const auto fits = [](std::uint64_t side) { return side >= 1 && side <= largest_side; };
    if (!width || !height || !fits(*width) || !fits(*height))
        return std::nullopt;
    return PixelSize{static_cast<int>(*width), static_cast<int>(*height)};
}

} // namespace hemilux
