#pragma once
// The picture in a file, without what the file says of how it was made.

#include "app/program.h"
#include "support/catch.h"

#include <string>

namespace test {

/// What stands from the pixels of a PNG on, or from the size of an HDR picture.
inline std::string picture_of(const Workplace& place, const std::string& name) {
    const std::string file = place.read(name);
    const std::size_t at = file.find(name.ends_with(".png") ? "IDAT" : "FORMAT=");
    REQUIRE(at != std::string::npos);
    return file.substr(at);
}

} // namespace test
