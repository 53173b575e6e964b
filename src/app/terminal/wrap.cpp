#include "app/terminal/wrap.h"

#include "io/files/printable.h"

#include <algorithm>
#include <cctype>
#include <sys/ioctl.h>
#include <unistd.h>
#include <vector>

namespace hemilux {

namespace {

constexpr std::size_t max_columns = 80;

std::size_t columns(std::string_view text) {
    return static_cast<std::size_t>(std::ranges::count_if(
        text, [](char c) { return (static_cast<unsigned char>(c) & 0xc0u) != 0x80; }));
}

bool is_alphanumeric(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; }

/// Returns where the place that a message begins with ends: "hemilux: PLACE: ...", where PLACE is a
/// word or a path.
std::size_t end_of_place(std::string_view line) {
    std::size_t begin = 0;
    for (const std::string_view label : {"hemilux: ", "warning: ", "note: "})
        if (line.starts_with(label))
            begin = label.size();
    const std::string_view rest = line.substr(begin);
    const std::string_view place = rest.substr(0, rest.find(": "));
    const bool is_place = place.size() < rest.size() &&
                          (place.find(' ') == place.npos || place.find('/') != place.npos);
    return begin > 0 && is_place ? begin + place.size() : 0;
}

/// Returns where the quotation ends that begins at `at`; `at` itself where none does.
std::size_t end_of_quotation(std::string_view line, std::size_t at) {
    const bool opens =
        (line[at] == '\'' || line[at] == '"') && (at == 0 || !is_alphanumeric(line[at - 1]));
    const std::size_t end = opens ? line.find(line[at], at + 1) : line.npos;
    return end == line.npos ? at : end;
}

/// Returns whether a line may be broken between what stands before a space and after it.
bool parts(std::string_view before, std::string_view after) {
    if (before.empty() || before.back() == ' ' || after.empty() || after.front() == ' ')
        return false;
    const std::string_view word = before.substr(before.rfind(' ') + 1);
    const std::size_t first = std::min(word.find_first_not_of("('"), word.size() - 1);
    const bool wants_value = word[first] == '-' && is_alphanumeric(word.back());
    const bool is_prefix = word == "k" || word == "M" || word == "G" || word == "T"; // of a unit
    const bool is_number = std::isdigit(static_cast<unsigned char>(word.back())) != 0;
    return !wants_value && !is_prefix && !is_number;
}

/// Returns the spaces at which a line may be broken, in order.
std::vector<std::size_t> breaks_of(std::string_view line) {
    std::vector<std::size_t> breaks;
    for (std::size_t i = end_of_place(line); i < line.size(); ++i) {
        i = end_of_quotation(line, i);
        if (line[i] == ' ' && parts(line.substr(0, i), line.substr(i + 1)))
            breaks.push_back(i);
    }
    return breaks;
}

void append_wrapped(std::string& result, std::string_view line, std::size_t width,
                    std::size_t indent) {
    std::size_t begin = 0, room = width;
    const std::vector<std::size_t> breaks = breaks_of(line);
    for (std::size_t next = 0; next < breaks.size() && columns(line.substr(begin)) > room;) {
        std::size_t at = breaks[next++];
        for (; next < breaks.size() && columns(line.substr(begin, breaks[next] - begin)) <= room;
             ++next)
            at = breaks[next];
        result += line.substr(begin, at - begin);
        result += '\n' + std::string(indent, ' ');
        begin = at + 1;
        room = width - std::min(indent, width);
    }
    result += line.substr(begin);
}

} // namespace

std::string wrapped(std::string_view text, std::size_t width, std::size_t indent) {
    std::string result;
    for (;;) {
        const std::string_view line = text.substr(0, text.find('\n'));
        append_wrapped(result, line, width, indent);
        if (line.size() == text.size())
            return result;
        result += '\n';
        text.remove_prefix(line.size() + 1);
    }
}

std::size_t terminal_columns(int descriptor) {
    winsize size{};
    if (isatty(descriptor) == 0)
        return 0;
    const bool known = ioctl(descriptor, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
    return known ? size.ws_col : max_columns;
}

std::string message_for(int descriptor, std::string_view text, std::size_t indent) {
    const std::size_t width = std::min(terminal_columns(descriptor), max_columns);
    const std::string message = printable_message(text);
    return width > 0 ? wrapped(message, width, indent) : message;
}

} // namespace hemilux
