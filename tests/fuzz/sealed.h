#pragma once
// Any bytes with what makes them a whole checkpoint file.

#include "io/results/checkpoint.h"
#include "io/results/checksum.h"
#include "radiosity/saving/state.h"

#include <string>
#include <string_view>

namespace hemilux::fuzz {

/// With a first line, a length and a checksum that are right.
inline std::string sealed(std::string_view content) {
    StateWriter length, sum;
    length.add(std::uint64_t{content.size()});
    std::string bytes = checkpoint_first_line() + length.bytes() + std::string(content);
    Checksum checksum;
    checksum.add(bytes);
    sum.add(checksum.value());
    return bytes + sum.bytes();
}

} // namespace hemilux::fuzz
