#pragma once
// The origin of a file, for those who find it later.

#include <cstdint>
#include <string>

namespace hemilux {

/// A record that is written into files that have a place for it. It holds what the content depends
/// on and nothing else, so that the same result has the same bytes.
struct Provenance {
    std::string program; ///< program with its version
    std::string command; ///< the command line
    std::uint64_t seed = 0;
};

} // namespace hemilux
