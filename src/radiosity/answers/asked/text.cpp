#include "radiosity/answers/asked/text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdarg>
#include <cstdio>

namespace hemilux {

std::string formatted(const char* format, ...) {
    std::array<char, 512> buffer{};
    va_list arguments;
    va_start(arguments, format);
    std::vsnprintf(buffer.data(), buffer.size(), format, arguments);
    va_end(arguments);
    return buffer.data();
}

std::string rounded_text(double number, int decimals) {
    std::string text = formatted("%.*f", decimals, number);
    if (decimals > 0) {
        text.erase(text.find_last_not_of('0') + 1);
        if (text.ends_with('.'))
            text.pop_back();
    }
    return text == "-0" ? "0" : text;
}

std::string short_count(double count) {
    static constexpr std::array<const char*, 5> units{"", " k", " M", " G", " T"};
    std::size_t unit = 0;
    for (; count >= 999.5 && unit + 1 < units.size(); ++unit)
        count /= 1000;
    const int decimals = unit == 0 || count >= 99.95 ? 0 : count >= 9.995 ? 1 : 2;
    return formatted("%.*f%s", decimals, count, units[unit]);
}

std::string grouped(std::uint64_t count) {
    std::string digits = std::to_string(count);
    for (std::size_t i = digits.size(); i > 3;)
        digits.insert(i -= 3, 1, ' ');
    return digits;
}

std::string duration(double seconds) {
    if (!(seconds < 100 * 3600.0))
        return "over 100 h";
    if (seconds < 0.1)
        return formatted("%.3g ms", 1000 * seconds);
    if (seconds < 9.995)
        return formatted("%.2f s", seconds);
    if (seconds < 59.95)
        return formatted("%.1f s", seconds);
    const int whole = static_cast<int>(std::lround(seconds));
    const int hours = whole / 3600, minutes = whole / 60 % 60;
    return hours ? formatted("%d:%02d:%02d", hours, minutes, whole % 60)
                 : formatted("%d:%02d", minutes, whole % 60);
}

std::string byte_size(std::uint64_t bytes) {
    if (bytes < 1000)
        return counted(bytes, "byte", "bytes");
    const std::string text = short_count(static_cast<double>(bytes));
    return text + "B";
}

std::string percent(double share) {
    return std::isfinite(share) ? formatted("%.3g %%", 100 * share) : "unknown";
}

std::string counted(std::uint64_t count, const std::string& one, const std::string& many) {
    return grouped(count) + " " + (count == 1 ? one : many);
}

std::string short_counted(std::uint64_t count, const std::string& one, const std::string& many) {
    return short_count(static_cast<double>(count)) + " " + (count == 1 ? one : many);
}

std::string list_names(std::span<const std::string> names, std::size_t most) {
    std::string text;
    for (std::size_t i = 0; i < std::min(names.size(), most); ++i)
        text += (i ? ", " : "") + names[i];
    if (names.size() > most)
        text += " and " + std::to_string(names.size() - most) + " more";
    return text;
}

} // namespace hemilux
