#include "app/command_line/unknown_option.h"

#include "app/settings/names.h"

#include <algorithm>
#include <array>

namespace hemilux {
namespace {

struct RemovedOption {
    std::string_view name, instead;
};

constexpr std::array removed_options{RemovedOption{
    "--spill", "the program has this option no more; where memory is too small, a swap file "
               "of the system takes its place (docs/use/how-to.md, Scenes larger than memory)"}};

} // namespace

std::string unknown_option(std::string_view word, std::span<const std::string> known) {
    const auto removed = std::ranges::find_if(removed_options, [word](const RemovedOption& option) {
        return option.name == word || option.name.substr(2) == word;
    });
    return removed == removed_options.end()
               ? unknown_name("option", word, known)
               : std::string(removed->name) + ": " + std::string(removed->instead);
}

} // namespace hemilux
