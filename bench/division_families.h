#pragma once
// Scenes on which the whole error of a division is compared with the true one: few large faces,
// furniture that stands on them, and one difficulty each.

#include "radiosity/paper/scene/scene.h"

#include <functional>
#include <string>
#include <vector>

namespace hemilux::bench {

struct DivisionFamily {
    std::string name;
    bool two_sided;
    std::function<Scene()> make;
};

[[nodiscard]] const std::vector<DivisionFamily>& division_families();

} // namespace hemilux::bench
