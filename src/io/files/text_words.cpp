#include "io/files/text_words.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <system_error>

namespace hemilux {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Returns whether a well-formed number out of the range of doubles is too small, not too large.
bool is_below_range(std::string_view word) {
    const std::size_t e = std::min(word.find_first_of("eE"), word.size());
    std::int64_t exponent = 0;
    if (e < word.size()) {
        const char* begin = word.data() + e + (word[e + 1] == '+' ? 2 : 1);
        if (std::from_chars(begin, word.data() + word.size(), exponent).ec != std::errc())
            return word[e + 1] == '-';
    }
    const std::string_view digits = word.substr(0, e);
    const auto point = static_cast<std::int64_t>(std::min(digits.find('.'), digits.size()));
    const auto lead = static_cast<std::int64_t>(digits.find_first_of("123456789"));
    return exponent + point - lead < 0;
}

std::string hint_about(std::string_view word) {
    if (word.find(',') != std::string_view::npos)
        return " (decimals are written with a point)";
    if (word.find_first_of("dD") != std::string_view::npos && is_digit(word.front()))
        return " (exponents are written with e)";
    double value = 0;
    const std::string_view digits = word.substr(word.starts_with('+') ? 1 : 0);
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    const bool beyond = error != std::errc() || !(std::abs(value) <= largest_number);
    if (end == digits.data() + digits.size() && error != std::errc::invalid_argument && beyond)
        return " (numbers must be finite and not beyond 1e100)";
    return "";
}

} // namespace

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && is_blank(text.front()))
        text.remove_prefix(1);
    while (!text.empty() && is_blank(text.back()))
        text.remove_suffix(1);
    return text;
}

std::vector<std::string_view> parts_of(std::string_view text, char separator) {
    std::vector<std::string_view> parts;
    for (std::size_t begin = 0; begin <= text.size(); begin += parts.back().size() + 1)
        parts.push_back(text.substr(begin, text.find(separator, begin) - begin));
    return parts;
}

std::string_view take_word(std::string_view& text) {
    std::size_t begin = 0;
    while (begin < text.size() && is_blank(text[begin]))
        ++begin;
    std::size_t end = begin;
    while (end < text.size() && !is_blank(text[end]) && text[end] != '#')
        ++end;
    const std::string_view word = text.substr(begin, end - begin);
    text.remove_prefix(end);
    return word;
}

std::string small_letters(std::string_view text) {
    std::string small(text);
    for (char& c : small)
        if (c >= 'A' && c <= 'Z')
            c = static_cast<char>(c - 'A' + 'a');
    return small;
}

bool differ_in_case(std::string_view a, std::string_view b) {
    return a != b && small_letters(a) == small_letters(b);
}

std::string_view name_in(std::string_view text) {
    for (std::size_t i = 0; i < text.size(); ++i)
        if (text[i] == '#' && (i == 0 || is_blank(text[i - 1])) &&
            !(i + 1 < text.size() && is_digit(text[i + 1])))
            return trimmed(text.substr(0, i));
    return trimmed(text);
}

std::optional<double> parse_decimal(std::string_view word) {
    const std::size_t first = word.starts_with('+') || word.starts_with('-') ? 1 : 0;
    if (first >= word.size() || !(is_digit(word[first]) || word[first] == '.'))
        return std::nullopt; // from_chars would take nan and inf
    if (word.front() == '+')
        word.remove_prefix(1);
    double value = 0;
    const char* const end = word.data() + word.size();
    const auto [stop, error] = std::from_chars(word.data(), end, value);
    if (stop != end)
        return std::nullopt;
    if (error == std::errc::result_out_of_range)
        return is_below_range(word) ? std::optional(0.0) : std::nullopt;
    if (error != std::errc() || !(std::abs(value) <= largest_number))
        return std::nullopt;
    return value;
}

std::string shortened(std::string_view text, std::size_t longest) {
    return std::string(text.substr(0, longest)) + (text.size() > longest ? "..." : "");
}

std::string found_instead(std::string_view word) {
    if (word.empty())
        return "found the end of the line";
    constexpr std::size_t longest = 40;
    std::string text = shortened(word, longest);
    for (char& c : text)
        if (static_cast<unsigned char>(c) < ' ' || c == '\x7f')
            c = '?';
    return "found \"" + text + '"';
}

std::string found_instead_of_number(std::string_view word) {
    return found_instead(word) + (word.empty() ? "" : hint_about(word));
}

} // namespace hemilux
