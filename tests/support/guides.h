#pragma once
// The guides of --guide. A build without the shelf of research has none: what needs them is left
// out there.

#include "radiosity/engine/shooting/additions.h"

#include <algorithm>
#include <string_view>
#include <vector>

namespace hemilux::test {

[[nodiscard]] inline bool has_research() { return !additions().guides.empty(); }

/// The guide of this name; nullptr, which is the density, where there is none.
[[nodiscard]] inline const Guide* guide_named(std::string_view name) {
    const auto guides = additions().guides;
    const auto found = std::ranges::find(guides, name, &Guide::name);
    return found == guides.end() ? nullptr : *found;
}

/// The density, and all others.
[[nodiscard]] inline std::vector<const Guide*> all_guides() {
    std::vector<const Guide*> guides{nullptr};
    guides.insert(guides.end(), additions().guides.begin(), additions().guides.end());
    return guides;
}

} // namespace hemilux::test
